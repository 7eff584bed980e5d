"""The picture of a sweep: completion against what was varied, with its bound or its spread."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, PercentFormatter

from fiveroute.colours import BLUE, GREEN, VERMILION
from fiveroute.decide.sweep import Sweep

__all__ = ["sweep_figure"]

_GREY = "#999999"
_SPREADS = (
    ("p5", "p95", "5 to 95 % of runs"),
    ("held_out_p5", "held_out_p95", "5 to 95 % of them"),
)
_LINES = (
    ("completion_rate", "plan", BLUE),
    ("held_out_mean", "mean of held-out members", BLUE),
    ("held_out_cvar", "their CVaR, the mean of the worst", VERMILION),
)
_LABELS = {
    "fleet_size": "AUVs",
    "hours": "departure, hours into the forecast",
    "speed": "speed through the water in m/s",
    "reserve": "reserve, standard deviations of the remaining time",
}


def sweep_figure(sweep: Sweep) -> Figure:
    """Draw a sweep.

    Rates are shares of all data. The bound is a dashed line, late returns have an axis of their
    own, and what the sweep points out is marked by a dotted line. Values that are words stand
    apart, without lines between them.
    """
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    axis = figure.subplots()
    words = any(isinstance(row[sweep.quantity], str) for row in sweep.rows)
    values = [row[sweep.quantity] for row in sweep.rows]
    places = [float(k) if words else float(value or 0) for k, value in enumerate(values)]
    for name, label, colour in _LINES:
        if name in sweep.rows[0]:
            label = "mean of runs" if "runs" in sweep.rows[0] else label
            style = "o" if words else "o-"
            axis.plot(places, _column(sweep, name), style, color=colour, label=label)
    if "bound_rate" in sweep.rows[0]:
        axis.plot(places, _column(sweep, "bound_rate"), "--", color=_GREY, label="proven bound")
    for low, high, label in _SPREADS:
        if low in sweep.rows[0]:
            spread = _column(sweep, low), _column(sweep, high)
            if words:
                pale = (BLUE, 0.3)
                axis.vlines(places, *spread, color=pale, linewidth=6, label=label, zorder=1)
            else:
                axis.fill_between(places, *spread, color=BLUE, alpha=0.15, label=label)
    if words:
        axis.set_xticks(places, [str(value) for value in values], rotation=20, ha="right")
    _draw_late(axis, sweep, places)
    _draw_mark(axis, sweep, dict(zip(values, places, strict=True)))
    if all(isinstance(value, int) for value in values):
        axis.xaxis.set_major_locator(MaxNLocator(integer=True))
    axis.yaxis.set_major_formatter(PercentFormatter(1.0))
    axis.set(
        title=sweep.instance,
        xlabel=_LABELS.get(sweep.quantity, sweep.quantity.replace("_", " ")),
        ylabel="share of all data collected",
    )
    axis.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=2 if words else 4, fontsize="small")
    return figure


def _draw_late(axis: Axes, sweep: Sweep, places: list[float]) -> None:
    if "late_share" not in sweep.rows[0]:
        return
    other = axis.twinx()
    late = [100.0 * share for share in _column(sweep, "late_share")]
    other.plot(places, late, "s--", color=VERMILION, label="late returns")
    other.set_ylabel("late returns in %")
    other.set_ylim(bottom=0.0)


def _draw_mark(axis: Axes, sweep: Sweep, places: dict[object, float]) -> None:
    if sweep.marked is None:
        return
    at = places.get(sweep.marked)
    if at is None and isinstance(sweep.marked, (int, float)):
        at = float(sweep.marked)
    if at is not None:
        axis.axvline(at, color=GREEN, linestyle=":", label=sweep.because)


def _column(sweep: Sweep, name: str) -> list[float]:
    found = [row[name] for row in sweep.rows]
    return [float(value) if isinstance(value, (int, float)) else math.nan for value in found]
