"""Pictures of fleets at sea, as in the paper's Figs. 5 and 9 to 13.

An AUV has the colour that it has on all maps. Planners have the other colours of the same
palette and marks of their own, so that nothing is told by colour alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from fiveroute.experiments.coordination_cases import Case, Round, Sailed
from fiveroute.experiments.pictures import Panel, colour_of, draw_map, map_legend
from fiveroute.problem import TeamOrienteering
from fiveroute.sea.events import Event, Kind

__all__ = ["auction_rounds", "coordination_case", "scenario_chart", "timeline"]

_BLACK, _GREY, _LIGHT = "#000000", "#999999", "#dddddd"
_PLANNERS = (("o", _BLACK), ("s", "#56B4E9"), ("^", "#E69F00"), ("D", _GREY))
_WON = "#D55E00"
_HOUR = 3600.0
_LABEL = 260.0  # seconds from one label to the next, so that they do not overlap


def coordination_case(case: Case) -> Figure:
    """The plan, a typical run of it without and with coordination, and what the runs gain.

    Figs. 9 and 10 of the paper, and the distribution that they are taken from.
    """
    figure = Figure(figsize=(10.0, 10.0), layout="constrained")
    *maps, gains = figure.subplots(2, 2).ravel()
    plan, run = case.plan, case.typical
    shown = {
        "plan": Sailed(case.planned, plan.routes, frozenset(), frozenset()),
        "sailed without coordination": Sailed.of(case.alone[run], plan),
        "sailed with coordination": Sailed.of(case.together[run], plan),
    }
    for axis, (name, sailed) in zip(maps, shown.items(), strict=True):
        title = f"{name}: $\\theta$ = {sailed.completion:.3f}"
        panel = Panel(title, sailed.routes, lost=sailed.lost, gained=sailed.gained)
        draw_map(axis, case.instance, panel)
    _draw_gains(gains, case.gains, run)
    figure.suptitle(f"Scenario {case.scenario}, M = {len(plan.routes)}")
    map_legend(figure, len(plan.routes), marks=True)
    return figure


def _draw_gains(axis: Axes, gains: NDArray[np.float64], run: int) -> None:
    """How often coordination gains how much, and the run that is shown."""
    points = 100.0 * gains
    edges = np.arange(np.floor(2.0 * points.min()), np.ceil(2.0 * points.max()) + 2.0) / 2.0
    counts, _, _ = axis.hist(points, bins=edges.tolist(), color=_LIGHT, edgecolor="white")
    axis.axvline(0.0, color=_GREY, linewidth=0.8)
    axis.axvline(points.mean(), color=_BLACK, linestyle="--", label=f"mean {points.mean():+.1f}")
    axis.plot(points[run], 0.0, "v", color=_BLACK, markersize=9, clip_on=False, label="run shown")
    axis.set(
        title=f"gain of {len(points)} runs by coordination",
        xlabel="points of completion",
        ylabel="runs",
        ylim=(0.0, 1.2 * np.max(counts)),  # the legend stands above
        box_aspect=1.0,
    )
    axis.yaxis.set_major_locator(MaxNLocator(integer=True))
    axis.spines[["top", "right"]].set_visible(False)
    axis.legend(loc="upper center", ncols=2, framealpha=1.0, edgecolor="white")


def timeline(problem: TeamOrienteering, events: Sequence[Event], title: str) -> Figure:
    """One run as it went, AUV by AUV, like Fig. 11: legs, nodes, and what was said.

    Parameters
    ----------
    problem
        The problem.
    events
        The log of the run.
    title
        Words above it.
    """
    fleet = problem.fleet_size
    figure = Figure(figsize=(13.0, 1.35 * fleet + 1.6), layout="constrained")
    axis = figure.subplots()
    for auv in range(fleet):
        _draw_lane(axis, fleet - 1 - auv, auv, problem, [e for e in events if e.auv == auv])
    latest = max([float(problem.budgets.max()), *(e.t for e in events if e.kind == "arrive")])
    axis.set(
        title=title,
        xlabel="hours since departure",
        xlim=(-0.03 * latest / _HOUR, 1.03 * latest / _HOUR),
        ylim=(-0.6, fleet - 0.3),
        yticks=range(fleet),
        yticklabels=[f"AUV {fleet - row}" for row in range(fleet)],
    )
    axis.spines[["top", "right", "left"]].set_visible(False)
    axis.tick_params(axis="y", length=0)
    axis.grid(axis="x", alpha=0.25)
    figure.legend(handles=_timeline_legend(), loc="outside lower center", ncols=8, frameon=False)
    return figure


def _draw_lane(
    axis: Axes, row: int, auv: int, problem: TeamOrienteering, events: Sequence[Event]
) -> None:
    """One AUV: a bar a leg, ended by the node's dot; marks above, talk below."""
    colour, begun, labelled, height = colour_of(auv), 0.0, -_LABEL, 0.0
    for event in events:
        if event.kind not in ("collect", "arrive", "fail"):
            continue
        axis.barh(
            row, (event.t - begun) / _HOUR, 0.16, begun / _HOUR, color=colour, alpha=0.35, lw=0
        )
        begun = event.t
        if event.kind == "collect" and event.node is not None:
            area = 20.0 + 70.0 * problem.profit[event.node] / max(problem.profit.max(), 1e-12)
            axis.scatter(event.t / _HOUR, row, s=area, color=colour, zorder=3)
            height = 0.14 if event.t - labelled > _LABEL else 0.25 if height < 0.2 else 0.14
            labelled, place = event.t, (event.t / _HOUR, row + height)
            axis.annotate(str(event.node), place, ha="center", fontsize=7, color="#666666")
    for kind, mark, height in _MARKS:
        times = [event.t / _HOUR for event in events if event.kind == kind]
        size = 10.0 if kind == "arrive" else 5.5
        axis.plot(times, [row + height] * len(times), mark, color=_BLACK, markersize=size, zorder=4)
    sent = [event.t / _HOUR for event in events if event.kind == "send"]
    axis.eventplot([sent], lineoffsets=row - 0.31, linelengths=0.1, colors=_GREY, linewidths=0.6)
    end = float(problem.budgets[auv]) / _HOUR
    axis.plot([end, end], [row - 0.3, row + 0.35], "--", color=_BLACK, linewidth=1.0)


_MARKS: tuple[tuple[Kind, str, float], ...] = (
    ("discard", "x", 0.39),
    ("pick_up", "+", 0.49),
    ("manoeuvre", "d", -0.17),
    ("arrive", "*", 0.0),
    ("fail", "X", 0.0),
)
"""Events with a mark, and how high above the lane it stands."""


def _timeline_legend() -> list[Line2D]:
    def entry(mark: str, label: str, colour: str = _BLACK, size: int = 7) -> Line2D:
        return Line2D([], [], marker=mark, color=colour, linestyle="", markersize=size, label=label)

    return [
        entry("o", "node collected, area by data", _GREY),
        entry("x", "discarded"),
        entry("+", "picked up"),
        entry("d", "manoeuvre", size=5),
        entry("*", "home", size=10),
        entry("|", "message sent", _GREY),
        Line2D([], [], color=_BLACK, linestyle="--", linewidth=1.0, label="$T_{max}$"),
    ]


def auction_rounds(rounds: Sequence[Round], title: str) -> Figure:
    """What idle nodes are worth to the AUVs, round by round, like Fig. 5; winning bids are boxed.

    Rows are AUVs, columns the idle nodes that anybody has time for; a dash is no time. Values
    spread over orders of magnitude, so that colours follow their logarithms.
    """
    wanted = [np.flatnonzero(r.psi.max(axis=0) > 0.0) for r in rounds]
    width = 2.0 + sum(0.75 * len(columns) + 0.9 for columns in wanted)
    height = 1.9 + 0.62 * max((len(r.auvs) for r in rounds), default=1)
    figure = Figure(figsize=(max(width, 6.0), height), layout="constrained")
    if rounds:
        axes = figure.subplots(1, len(rounds), squeeze=False, width_ratios=[*map(len, wanted)])[0]
        values = _HOUR * np.concatenate([r.psi.ravel() for r in rounds])
        scale = LogNorm(values[values > 0.0].min(), values.max())
        for k, (axis, r, columns) in enumerate(zip(axes, rounds, wanted, strict=True), start=1):
            _draw_round(axis, r, columns, scale)
            axis.set_title(f"round {k}")
        bar = figure.colorbar(axes[0].images[0], ax=axes, pad=0.02)
        bar.set_label(r"$\psi$ in data per hour")
        for each in (bar.ax.yaxis.set_major_formatter, bar.ax.yaxis.set_minor_formatter):
            each("{x:g}")
    figure.suptitle(title)
    return figure


def _draw_round(axis: Axes, r: Round, columns: NDArray[np.intp], scale: LogNorm) -> None:
    psi = _HOUR * r.psi[:, columns]
    axis.imshow(np.where(psi > 0.0, psi, np.nan), cmap="cividis", norm=scale, aspect="auto")
    axis.set_facecolor("#eeeeee")
    for (m, j), value in np.ndenumerate(psi):
        text = f"{value:.2f}" if value > 0.0 else "–"
        is_dark = value > 0.0 and scale(value) < 0.55
        colour = "white" if is_dark else _BLACK
        axis.annotate(text, (j, m), ha="center", va="center", color=colour, fontsize=9)
        if r.won[m] == columns[j]:
            box = Rectangle((j - 0.46, m - 0.46), 0.92, 0.92, fill=False)
            box.set(edgecolor=_WON, linewidth=3.0)
            axis.add_patch(box)
    axis.set(
        xticks=range(len(columns)),
        xticklabels=[str(r.nodes[j]) for j in columns],
        yticks=range(len(r.auvs)),
        yticklabels=[f"AUV {m + 1}" for m in r.auvs],
        xlabel="idle node",
    )
    axis.tick_params(length=0)


def scenario_chart(
    means: Mapping[str, Sequence[float]],
    errors: Mapping[str, Sequence[float]],
    fleets: Sequence[int],
    fixed: int,
) -> Figure:
    """Completion by scenario, and below it the number of AUVs, like Figs. 12 and 13.

    Parameters
    ----------
    means
        By planner: mean completion on every scenario.
    errors
        By planner: half the width of its 95 % interval.
    fleets
        AUVs of the five-tiered planner on every scenario.
    fixed
        AUVs of the others.
    """
    figure = Figure(figsize=(10.5, 6.0), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    places = np.arange(1, len(fleets) + 1)
    step = 0.5 / max(len(means) - 1, 1)
    for k, (name, values) in enumerate(means.items()):
        mark, colour = _PLANNERS[k % len(_PLANNERS)]
        above.errorbar(
            places + step * k - 0.25,
            values,
            errors[name],
            fmt=mark,
            color=colour,
            markersize=6,
            elinewidth=1.0,
            label=name,
        )
    best = np.argmax(list(means.values()), axis=0)
    for place, k in zip(places, best.tolist(), strict=True):
        above.axvspan(place - 0.45, place + 0.45, color=_PLANNERS[k][1], alpha=0.1, lw=0)
    above.set_title("Completion by scenario, shaded in the colour of the best", loc="left")
    above.set(ylabel="mean completion rate")
    above.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(means), frameon=False)
    above.grid(axis="y", alpha=0.3)
    _draw_fleets(below, places, fleets, fixed)
    words = below.get_legend_handles_labels()
    figure.legend(*words, loc="outside lower center", ncols=3, frameon=False)
    return figure


def _draw_fleets(axis: Axes, places: NDArray[np.int64], fleets: Sequence[int], fixed: int) -> None:
    few = np.array(fleets) < fixed
    counts = f"({few.sum()} of {len(few)})", f"({(~few).sum()} of {len(few)})"
    axis.bar(
        places[few],
        np.array(fleets)[few],
        0.6,
        color=_BLACK,
        label=f"five-tier, fewer than {fixed} AUVs {counts[0]}",
    )
    axis.bar(
        places[~few],
        np.array(fleets)[~few],
        0.6,
        color="#bbbbbb",
        label=f"five-tier, {fixed} AUVs or more {counts[1]}",
    )
    axis.axhline(fixed, color=_BLACK, linestyle="--", linewidth=1.0, label=f"others, M = {fixed}")
    axis.set(xlabel="scenario", ylabel="AUVs", xticks=places, yticks=range(0, max(fleets) + 1))
    axis.set_ylim(0, max(*fleets, fixed) + 0.4)
    axis.set_xlim(0.4, len(fleets) + 0.6)
