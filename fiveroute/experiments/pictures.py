"""The plotting room: with `fiveroute.experiments.sea_pictures` the only place with matplotlib.

Every function draws one figure and returns it. Colours are those of
Okabe and Ito (2008), which colour-blind readers can tell apart.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon

from fiveroute.colours import COLOURS
from fiveroute.instance import Instance
from fiveroute.paths.waters import Waters
from fiveroute.routes import Route
from fiveroute.tiers.pathing import PlannedPath
from fiveroute.words import printable

__all__ = [
    "Panel",
    "colour_of",
    "completion_boxes",
    "draw_map",
    "gap_profile",
    "map_legend",
    "path_map",
    "route_panels",
]

_IDLE = "#999999"
_LAND = "#8c6d46"
_ARROWS = 25  # across a picture


@dataclass(frozen=True, slots=True)
class Panel:
    """One map: routes over the nodes, each in its own colour.

    Parameters
    ----------
    title
        Words above it.
    routes
        Routes from start to destination.
    open_ends
        Whether the legs to start and destination are left out: a segment of the giant
        route, not a route yet.
    lost
        Nodes crossed out: planned, but collected by nobody.
    gained
        Nodes ringed: collected by an AUV that was not to visit them.
    """

    title: str
    routes: tuple[Route, ...]
    open_ends: bool = False
    lost: frozenset[int] = frozenset()
    gained: frozenset[int] = frozenset()


def colour_of(auv: int) -> str:
    """The colour of an AUV, the same in all pictures."""
    return COLOURS[auv % len(COLOURS)]


def path_map(waters: Waters, planned: PlannedPath, title: str) -> Figure:
    """The current's speed and arrows, barriers, a path and its reference.

    Distances are in kilometres; the current is that at the first time of its grid.
    """
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    axis = figure.subplots()
    _draw_current(figure, axis, waters)
    _draw_barriers(axis, waters)
    track, reference = planned.path.waypoints / 1000.0, planned.reference_track / 1000.0
    axis.plot(*reference.T, "--", color="white", linewidth=1.5, label="reference", zorder=3)
    axis.plot(*track.T, color=COLOURS[1], linewidth=2.0, label="path", zorder=4)
    if len(track):
        axis.plot(*track[0], "^", color="black", markersize=9, zorder=5)
        axis.plot(*track[-1], "*", color="black", markersize=12, zorder=5)
    gap = "" if planned.gap is None else f", gap {100 * planned.gap:.2f} %"
    axis.set(title=printable(f"{title}{gap}"), xlabel="x in km", ylabel="y in km")
    axis.set_aspect("equal")
    axis.title.set_parse_math(False)  # names may hold dollars
    legend = axis.legend(loc="upper right")
    legend.get_frame().set_facecolor("#bbbbbb")
    return figure


def _draw_current(figure: Figure, axis: Axes, waters: Waters) -> None:
    grid = waters.grid
    u, v = np.moveaxis(grid.uv[0], -1, 0)
    x = (grid.west + grid.step * np.arange(u.shape[1])) / 1000.0
    y = (grid.south + grid.step * np.arange(u.shape[0])) / 1000.0
    image = axis.pcolormesh(x, y, np.hypot(u, v), cmap="viridis", shading="gouraud", zorder=0)
    figure.colorbar(image, ax=axis, label="speed of the current in m/s", shrink=0.8)
    rows, columns = (slice(None, None, max(size // _ARROWS, 1)) for size in u.shape)
    arrows = u[rows, columns], v[rows, columns]
    axis.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    if np.any(arrows):  # in still water there is no scale for them
        axis.quiver(x[columns], y[rows], *arrows, color="white", alpha=0.6, width=2e-3, zorder=1)


def _draw_barriers(axis: Axes, waters: Waters) -> None:
    barriers = waters.barriers
    for x, y, radius in barriers.circles / 1000.0:
        axis.add_patch(Circle((x, y), radius, color=_LAND, zorder=2))
    for first, last in itertools.pairwise(barriers.first):
        axis.add_patch(Polygon(barriers.corners[first:last] / 1000.0, color=_LAND, zorder=2))
    if barriers.land.size:
        rows, columns = barriers.land.shape
        x = (barriers.land_west + barriers.land_step * np.arange(columns)) / 1000.0
        y = (barriers.land_south + barriers.land_step * np.arange(rows)) / 1000.0
        deepest = min(float(barriers.land.min()), -1.0)
        axis.contourf(x, y, barriers.land, levels=[deepest, 0.0], colors=[_LAND], zorder=2)


def route_panels(instance: Instance, panels: Sequence[Panel]) -> Figure:
    """Maps side by side, like the paper's Figs. 3 and 6.

    Nodes are circles whose area grows with their data, filled where visited; the start is
    a triangle, the destination a star. Distances are in kilometres.
    """
    figure = Figure(figsize=(4.6 * len(panels), 5.0), layout="constrained")
    axes = figure.subplots(1, len(panels), squeeze=False)[0]
    for axis, panel in zip(axes, panels, strict=True):
        draw_map(axis, instance, panel)
    marks = any(panel.lost or panel.gained for panel in panels)
    map_legend(figure, max(len(panel.routes) for panel in panels), marks=marks)
    return figure


def map_legend(figure: Figure, fleet_size: int, *, marks: bool = False) -> None:
    """Say below a figure whose routes its maps show, and what their marks mean."""
    handles = [
        Line2D([], [], color=colour_of(auv), marker="o", markersize=5, label=f"AUV {auv + 1}")
        for auv in range(fleet_size)
    ]
    if marks:
        for mark, label in (("x", "planned, but lost"), ("o", "picked up")):
            handle = Line2D([], [], color="black", linestyle="", marker=mark, label=label)
            handle.set(markersize=7 if mark == "x" else 10, markerfacecolor="none")
            handles.append(handle)
    figure.legend(handles=handles, loc="outside lower center", ncols=10, frameon=False)


def draw_map(axis: Axes, instance: Instance, panel: Panel) -> None:
    """Draw one map, distances in kilometres."""
    points = instance.points / 1000.0
    data = np.array([node.data for node in instance.nodes])
    area = 12.0 + 60.0 * data / max(float(data.max(initial=0.0)), 1e-12)
    colours = np.full(len(data), _IDLE, dtype=object)
    for auv, route in enumerate(panel.routes):
        colour = colour_of(auv)
        stops = [*route] if panel.open_ends else [0, *route, len(points) - 1]
        axis.plot(*points[stops].T, color=colour, linewidth=1.3, zorder=1)
        colours[[node - 1 for node in route]] = colour
    idle = colours == _IDLE
    x, y = points[1:-1].T
    axis.scatter(x[~idle], y[~idle], s=area[~idle], c=list(colours[~idle]), zorder=2)
    axis.scatter(x[idle], y[idle], s=area[idle], facecolors="none", edgecolors=_IDLE, zorder=2)
    for nodes, mark, size in ((panel.lost, "x", 7.0), (panel.gained, "o", 13.0)):
        if nodes:
            (line,) = axis.plot(*points[sorted(nodes)].T, mark, color="black", markersize=size)
            line.set(markerfacecolor="none", markeredgewidth=1.6, zorder=4)
    axis.plot(*points[0], "^", color="black", markersize=10, zorder=3)
    axis.plot(*points[-1], "*", color="black", markersize=13, zorder=3)
    axis.set(title=panel.title, aspect="equal", xlabel="x, km", ylabel="y, km")


def completion_boxes(
    title: str, samples: Mapping[str, Sequence[float]], published: Mapping[str, float]
) -> Figure:
    """Box chart of completion rates, like the paper's Figs. 7 and 8.

    Box: quartiles; line: median; short mark: mean; whiskers: the farthest values within
    1.5 quartile distances; circles: outliers; diamond: the mean that the paper publishes.
    """
    figure = Figure(figsize=(1.3 * len(samples) + 2.0, 4.2), layout="constrained")
    axis = figure.subplots()
    axis.boxplot(
        list(samples.values()),
        tick_labels=list(samples),
        widths=0.5,
        showmeans=True,
        meanprops={"marker": "_", "markeredgecolor": COLOURS[1], "markersize": 14},
        medianprops={"color": COLOURS[0]},
        flierprops={"marker": "o", "markersize": 4},
    )
    for place, name in enumerate(samples, start=1):
        if name in published:
            axis.plot(place + 0.36, published[name], "D", color=COLOURS[2], markersize=5)
    axis.plot([], [], "_", color=COLOURS[1], markersize=14, label="mean")
    if published:
        axis.plot([], [], "D", color=COLOURS[2], markersize=5, label="mean in the paper")
    axis.legend(loc="lower right", fontsize="small")
    axis.set(title=title, ylabel="expected completion rate")
    axis.grid(axis="y", alpha=0.3)
    return figure


def gap_profile(
    shortfalls: Mapping[str, Sequence[float]], proof_times: Sequence[float | None]
) -> Figure:
    """Performance profile: the share of instances that each solver brings within a shortfall.

    Where the exact method proved something, a second chart has the share solved over time.

    References
    ----------
    E. D. Dolan and J. J. Moré, "Benchmarking optimization software with performance profiles",
    Mathematical Programming 91 (2002), doi 10.1007/s101070100263.
    """
    solved = sorted(seconds for seconds in proof_times if seconds is not None)
    figure = Figure(figsize=(10.0 if solved else 5.5, 4.2), layout="constrained")
    axes = figure.subplots(1, 2 if solved else 1, squeeze=False)[0]
    for colour, (name, values) in zip(itertools.cycle(COLOURS), shortfalls.items()):
        below = [100.0 * value for value in sorted(values)]
        _draw_shares(axes[0], below, len(below), 100.0, color=colour, label=name)
    axes[0].set_xscale("symlog", linthresh=0.01)
    axes[0].set(xlim=(-0.002, 100.0), ylim=(0.0, 1.02), title="Performance profile")
    axes[0].set(xlabel="below the best known value by at most, %", ylabel="share of instances")
    if shortfalls:
        axes[0].legend(loc="best", fontsize="small")
    if solved:
        _draw_shares(axes[1], solved, len(proof_times), 2.0 * solved[-1], color=COLOURS[0])
        axes[1].set(xscale="log", xlabel="s", ylabel="share of instances", ylim=(0.0, 1.02))
        axes[1].set(title="Proved optimal within")
    for axis in axes:
        axis.grid(alpha=0.3)
    return figure


def _draw_shares(axis: Axes, values: Sequence[float], total: int, end: float, **style: Any) -> None:
    """The stairs of a distribution: a share of `total` at each value, drawn on to an end."""
    shares = np.minimum(np.arange(len(values) + 2), len(values)) / total
    axis.step([min(values, default=0.0), *values, end], shares, where="post", **style)
