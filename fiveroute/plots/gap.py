"""How far plans are from optimal."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fiveroute.colours import BLUE
from fiveroute.result import optimality_gap

__all__ = ["gap_text", "plot_gap"]


def plot_gap(results: Mapping[str, tuple[float, float | None]], ax: Axes | None = None) -> Axes:
    """Bars of collected data, and a mark at what no plan can exceed.

    Parameters
    ----------
    results
        Objective and bound, None where there is none, by name.
    ax
        Where to draw.
    """
    if ax is None:
        ax = Figure(figsize=(7.0, 1.2 + 0.5 * len(results)), layout="constrained").subplots()
    for place, (objective, bound) in enumerate(results.values()):
        ax.barh(place, objective, color=BLUE, height=0.6)
        if bound is not None:
            ax.barh(place, bound - objective, left=objective, color="#dde8f1", height=0.6)
            ax.plot([bound, bound], [place - 0.36, place + 0.36], color="black", linewidth=2.0)
        text = f"{objective:.4g}{gap_text(objective, bound)} "
        ax.text(objective, place, text, ha="right", va="center", color="white")
    ax.set_yticks(range(len(results)), list(results), parse_math=False)
    ax.invert_yaxis()
    ax.set(xlabel="data collected; the black mark is a proven upper bound", xlim=(0.0, None))
    return ax


def gap_text(objective: float, bound: float | None) -> str:
    """The gap in words, to follow an objective."""
    gap = optimality_gap(objective, bound)
    return "" if gap is None else f", gap {gap:.1%}"
