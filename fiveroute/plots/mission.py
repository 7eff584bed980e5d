"""A fleet on the map: routes as planned, and what has been sailed of them by a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fiveroute.colours import COLOURS
from fiveroute.plots.gap import gap_text
from fiveroute.plots.sea import plot_sea, unit_of
from fiveroute.view.event_log import RunLog
from fiveroute.view.scene import Scene
from fiveroute.view.timed_legs import Leg, sailed_legs, track_of
from fiveroute.words import printable

__all__ = ["draw_fleet", "plot_mission", "plot_plan", "run_legs"]

Floats = NDArray[np.float64]
Legs = tuple[tuple[Leg, ...], ...]

_DASHES = ("-", "--", ":", "-.")
_GREY = "#75828d"
_NONE = np.zeros((0, 3))


def plot_plan(scene: Scene, ax: Axes | None = None, *, currents: bool = True) -> Axes:
    """A plan on its sea: routes, nodes by their data, start (triangle) and destination (star).

    Parameters
    ----------
    scene
        The plan, see `fiveroute.view.scene.scene_of`.
    ax
        Where to draw.
    currents
        Whether to draw the current.
    """
    ax = plot_sea(scene, ax, currents=currents)
    draw_fleet(ax, scene, scene.legs)
    plan = scene.plan
    gap = gap_text(plan.objective, plan.bound)
    ax.set_title(f"{printable(scene.title)}: {_share(scene, plan.objective)}{gap}")
    return ax


def plot_mission(
    scene: Scene,
    run: RunLog | None = None,
    t: float = math.inf,
    ax: Axes | None = None,
    *,
    currents: bool = True,
) -> Axes:
    """What a fleet has sailed and collected by a time; filled nodes are collected.

    Parameters
    ----------
    scene
        The plan.
    run
        A simulated run of it; None takes the plan itself.
    t
        Seconds since the fleet departed.
    ax
        Where to draw.
    currents
        Whether to draw the current.
    """
    ax = plot_sea(scene, ax, t=0.0 if math.isinf(t) else t, currents=currents)
    draw_fleet(ax, scene, run_legs(scene, run), t, None if run is None else run.tracks)
    name = "plan" if run is None else f"run {run.run}"
    ax.set_title(f"{printable(scene.title)}, {name}: {ax.get_title()}")
    return ax


def run_legs(scene: Scene, run: RunLog | None) -> Legs:
    """The legs of a run, or those of the plan where there is none."""
    if run is None:
        return scene.legs
    return sailed_legs(scene.instance, len(scene.routes.routes), run.events)


def draw_fleet(
    ax: Axes,
    scene: Scene,
    legs: Legs,
    t: float = math.inf,
    tracks: Sequence[Floats] | None = None,
) -> None:
    """Draw tracks, nodes and AUVs at a time in seconds; the title tells what is collected.

    Where no tracks are known, or an AUV has none, its legs are followed.
    """
    unit, size = unit_of(scene), len(scene.instance.nodes)
    owner, collected = np.full(size, -1), np.zeros(size, dtype=np.bool_)
    for auv, route in enumerate(scene.routes.routes):
        owner[[node - 1 for node in route]] = auv
    for auv, own in enumerate(legs):
        colour, dash = COLOURS[auv % len(COLOURS)], _DASHES[auv // len(COLOURS) % len(_DASHES)]
        track = _NONE if tracks is None else tracks[auv]
        if not len(track):
            track = track_of(auv, own, scene.shapes, scene.instance.points)
        x, y = _until(track, t).T / unit
        ax.plot(x, y, color="white", linewidth=3.4, zorder=3)
        ax.plot(x, y, dash, color=colour, linewidth=1.8, zorder=4, label=f"AUV {auv + 1}")
        if tracks is None or not len(tracks[auv]):
            _draw_guessed(ax, scene, auv, [leg for leg in own if leg.left < t], t)
        if math.isfinite(t):
            rim: dict[str, Any] = {"markeredgecolor": "white", "markeredgewidth": 1.4}
            ax.plot(x[-1:], y[-1:], "o", color=colour, markersize=10, zorder=7, **rim)
        for leg in own:
            if leg.head <= size and leg.done <= t and not collected[leg.head - 1]:
                owner[leg.head - 1], collected[leg.head - 1] = auv, True
    _draw_nodes(ax, scene, owner, collected)
    data = np.array([node.data for node in scene.instance.nodes])
    hours = "" if math.isinf(t) else f" in {t / 3600.0:.2f} h"
    ax.set_title(f"{_share(scene, float(data[collected].sum()))}{hours}")


def _draw_guessed(ax: Axes, scene: Scene, auv: int, legs: Sequence[Leg], t: float) -> None:
    """Gaps in the straight lines that stand for ways nobody has told."""
    points = scene.instance.points / unit_of(scene)
    for leg in legs:
        if scene.shapes.paths and scene.shapes.place(auv, leg) is None:
            share = min((t - leg.left) / max(leg.reached - leg.left, 1e-9), 1.0)
            tail, head = points[[leg.tail, leg.head]]
            ends = np.array([tail, tail + share * (head - tail)])
            ax.plot(*ends.T, color="white", linewidth=2.2, dashes=(2.0, 3.0), zorder=4.5)


def _draw_nodes(ax: Axes, scene: Scene, owner: NDArray[Any], filled: NDArray[np.bool_]) -> None:
    """Circles whose area grows with the data, in the colour of their AUV."""
    points = scene.instance.points / unit_of(scene)
    data = np.array([node.data for node in scene.instance.nodes])
    edges = np.array([_GREY if auv < 0 else COLOURS[auv % len(COLOURS)] for auv in owner])
    area = 8.0 + 70.0 * data / max(float(data.max(initial=0.0)), 1e-12)
    for is_filled in (False, True):
        some = filled == is_filled
        faces = edges[some] if is_filled else "white"
        rims = "white" if is_filled else edges[some]
        x, y = points[1:-1][some].T
        ax.scatter(x, y, s=area[some], c=faces, edgecolors=rims, linewidths=1.2, zorder=5)
    for mark, place, marker_size in (("^", points[0], 11), ("*", points[-1], 15)):
        ax.plot(
            *place, mark, color="black", markeredgecolor="white", markersize=marker_size, zorder=6
        )


def _until(track: Floats, t: float) -> Floats:
    """Positions up to a time and at it, shape (k, 2)."""
    x, y, times = track.T
    if t >= times[-1]:
        return track[:, :2]
    now = [(np.interp(t, times, x), np.interp(t, times, y))]
    return np.concatenate([track[times <= t, :2], now])


def _share(scene: Scene, collected: float) -> str:
    total = sum(node.data for node in scene.instance.nodes)
    return f"{collected:.4g} of {total:.4g} collected"
