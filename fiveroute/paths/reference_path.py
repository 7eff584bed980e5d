"""Reference paths: time-dependent Dijkstra with a wide stencil, straightened.

The reference that a planner's path is held to when there are obstacles, land or a current that
varies in time. It knows nothing of turning circles, so that it may be a little faster than any
path that an AUV can follow.

One run of the search serves all legs out of a point (`grid_paths`): all pairs of n points take n
runs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.current_grid import Region
from fiveroute.paths.current_bounds import fastest_bound, gradient_bound
from fiveroute.paths.grid_search import (
    Labels,
    Lattice,
    Sea,
    no_labels,
    search,
    stencil,
    surroundings,
)
from fiveroute.paths.legs import track_time
from fiveroute.paths.straighten import straighten
from fiveroute.paths.waters import Waters

__all__ = ["GridPath", "grid_path", "grid_paths"]

Floats = NDArray[np.float64]

_CELLS = 120  # along the longer side of the region, unless told
_MARGIN = 0.5  # of the longer side of the box around start and goals, where there is no region
_LONGEST_LEG = 1.0  # of a straightened path, in steps


@dataclass(frozen=True, slots=True, eq=False)
class GridPath:
    """A path and its duration.

    Parameters
    ----------
    track
        Points from the start to the goal in metres, shape (k, 2); none if unreachable.
    duration
        In seconds; infinite if unreachable.
    """

    track: Floats
    duration: float


def grid_path(
    waters: Waters,
    start: ArrayLike,
    goal: ArrayLike,
    *,
    begin: float = 0.0,
    step: float | None = None,
    radius: int = 6,
    straight: bool = True,
) -> GridPath:
    """The earliest path from a point to another.

    Parameters
    ----------
    waters
        The ocean and the vehicle. Paths keep within the rectangle of its barriers; where that
        is infinite, within half as much again as the points span.
    start, goal
        Positions in metres, shape (2,).
    begin
        When the path begins, in seconds.
    step
        Spacing of the lattice in metres; None takes 120 cells along the region.
    radius
        Reach of the stencil in cells.
    straight
        Whether to straighten the path, which takes about 10 ms.
    """
    return grid_paths(
        waters, start, np.atleast_2d(goal), begin=begin, step=step, radius=radius, straight=straight
    )[0]


def grid_paths(
    waters: Waters,
    start: ArrayLike,
    goals: ArrayLike,
    *,
    begin: float = 0.0,
    step: float | None = None,
    radius: int = 6,
    straight: bool = True,
) -> list[GridPath]:
    """The earliest paths from a point to each of others, by one run of the search.

    Parameters
    ----------
    goals
        Positions in metres, shape (g, 2). For the others see `grid_path`.
    """
    if radius < 1:
        raise InputError("a stencil reaches at least one cell", field="radius", value=radius)
    first = np.array(start, dtype=np.float64)
    last = np.array(goals, dtype=np.float64).reshape(-1, 2)
    if not (np.isfinite(first).all() and np.isfinite(last).all()):
        raise InputError("start and goals need finite positions")
    lattice = _lattice(_region(waters, np.vstack([first, last])), step)
    sea = _sea(waters, lattice)
    labels = no_labels(lattice.rows * lattice.columns + 1 + len(last))
    search(sea, stencil(radius), surroundings(radius), first, last, begin, labels)
    tracks = [_track(labels, lattice, first, last, k) for k in range(len(last))]
    paths = [_path(waters, track, begin) for track in tracks]
    if straight:
        longest = _LONGEST_LEG * lattice.step
        paths = [_straightened(waters, path, begin, longest) for path in paths]
    return paths


def _path(waters: Waters, track: Floats, begin: float) -> GridPath:
    duration = track_time(waters.grid, track, begin, waters.speed) if len(track) else math.inf
    return GridPath(track, duration)


def _straightened(waters: Waters, path: GridPath, begin: float, longest: float) -> GridPath:
    """The path that straightening makes of another, if that is earlier."""
    if not len(path.track):
        return path
    track = straighten(waters.grid, waters.barriers, path.track, begin, waters.speed, longest)
    return min(path, _path(waters, track, begin), key=lambda each: each.duration)


def _region(waters: Waters, points: Floats) -> Region:
    """The barriers' rectangle, or where a side is infinite a margin around the points."""
    margin = max(_MARGIN * float(np.ptp(points, axis=0).max()), waters.grid.step)
    box = Region.around(points, margin)
    known = (
        waters.barriers.west,
        waters.barriers.south,
        waters.barriers.east,
        waters.barriers.north,
    )
    return Region(*(a if math.isfinite(a) else b for a, b in zip(known, box, strict=True)))


def _lattice(region: Region, step: float | None) -> Lattice:
    """Points over a region; they end at or inside its eastern and northern sides."""
    width, height = region.east - region.west, region.north - region.south
    spacing = max(width, height) / _CELLS if step is None else step
    if not spacing > 0.0:
        raise InputError("the lattice needs a positive spacing", field="step", value=step)
    rows, columns = (int(side / spacing + 1e-9) + 1 for side in (height, width))
    return Lattice(region.west, region.south, spacing, rows, columns)


def _sea(waters: Waters, lattice: Lattice) -> Sea:
    grid = waters.grid
    gradient = gradient_bound(grid) if grid.is_steady else math.inf
    return Sea(grid, waters.barriers, lattice, waters.speed, fastest_bound(grid), gradient)


def _track(labels: Labels, lattice: Lattice, start: Floats, goals: Floats, goal: int) -> Floats:
    """Points from the start to a goal; none if it was not reached."""
    first = lattice.rows * lattice.columns
    if not math.isfinite(labels.time[first + 1 + goal]):
        return np.zeros((0, 2))
    track, point = [goals[goal]], labels.parent[first + 1 + goal]
    while point != first:
        row, column = divmod(point, lattice.columns)
        x, y = lattice.west + column * lattice.step, lattice.south + row * lattice.step
        track.append(np.array([x, y]))
        point = labels.parent[point]
    return np.array([*track, start][::-1])
