"""A path along a lattice made as good as its corridor allows.

A lattice path turns where the lattice wants it to. Two steps free it, both with legs that are
integrated and checked like any others:

1. shortcut: the earliest way from the first point to the last by straight legs between any two
   of the points, found in one pass, since points are in order;
2. relaxation: every inner point in turn moves to either side by a shrinking distance as long
   as that brings the next point's arrival forward, which, as who arrives earlier leaves
   earlier, brings forward that of the last. Then legs are halved and relaxed again, so that long
   waves are smoothed while points are few.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, leg_clearance
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.paths.legs import leg_time

__all__ = ["straighten"]

Floats = NDArray[np.float64]

_SMALLEST_MOVE = 0.004  # of the longest leg, sideways
_SWEEPS = 100  # at most, with one distance


@kernel
def straighten(
    grid: CurrentGrid, barriers: Barriers, track: Floats, t: float, speed: float, longest: float
) -> Floats:
    """A path that arrives no later, of legs that are at most `longest` metres long.

    Parameters
    ----------
    grid, barriers
        The current, and where not to be.
    track
        Points of a collision-free path, shape (k, 2); not changed.
    t
        When it begins, in seconds.
    speed
        Speed through the water in metres per second.
    longest
        Length of a leg in metres.
    """
    track = _shortcut(grid, barriers, track, t, speed)
    _relax(grid, barriers, track, t, speed, longest)
    while _longest_leg(track) > longest:
        track = _halved(track, longest)
        _relax(grid, barriers, track, t, speed, longest)
    return track


@kernel
def _shortcut(
    grid: CurrentGrid, barriers: Barriers, track: Floats, t: float, speed: float
) -> Floats:
    """The earliest way by straight legs from point to any later point."""
    last = len(track) - 1
    arrival, parent = np.full(last + 1, math.inf), np.zeros(last + 1, dtype=np.int64)
    arrival[0] = t
    for i in range(last):
        x0, y0 = track[i]
        for j in range(i + 1, last + 1):
            x1, y1 = track[j]
            time = arrival[i] + leg_time(grid, x0, y0, x1, y1, arrival[i], speed)
            if time <= arrival[j] and (
                j == i + 1 or leg_clearance(barriers, x0, y0, x1, y1) >= 0.0
            ):
                arrival[j], parent[j] = time, i
    kept, point = [last], last
    while point > 0:
        point = parent[point]
        kept.append(point)
    return track[np.array(kept[::-1])]


@kernel
def _relax(
    grid: CurrentGrid, barriers: Barriers, track: Floats, t: float, speed: float, furthest: float
) -> None:
    """Move the inner points sideways, in place, while it helps."""
    distance = furthest
    while distance > _SMALLEST_MOVE * furthest:
        for _ in range(_SWEEPS):
            if not _sweep(grid, barriers, track, t, speed, distance):
                break
        distance /= 2.0


@kernel
def _sweep(
    grid: CurrentGrid, barriers: Barriers, track: Floats, t: float, speed: float, distance: float
) -> bool:
    """Try to move every inner point by a distance, in place; whether any moved."""
    moved = False
    for k in range(1, len(track) - 1):
        before, here, after = track[k - 1], track[k].copy(), track[k + 1]
        east, north = after[0] - before[0], after[1] - before[1]
        share = distance / max(math.hypot(east, north), distance)
        best = _detour(grid, before, here, after, t, speed)
        for side in (-share, share):
            there = np.array([here[0] - side * north, here[1] + side * east])
            time = _detour(grid, before, there, after, t, speed)
            if time < best and _keeps_clear(barriers, before, there, after):
                best, moved = time, True
                track[k] = there
        t += leg_time(grid, before[0], before[1], track[k, 0], track[k, 1], t, speed)
    return moved


@kernel
def _detour(
    grid: CurrentGrid, before: Floats, via: Floats, after: Floats, t: float, speed: float
) -> float:
    """Time of two legs begun at time t."""
    time = leg_time(grid, before[0], before[1], via[0], via[1], t, speed)
    return time + leg_time(grid, via[0], via[1], after[0], after[1], t + time, speed)


@kernel
def _keeps_clear(barriers: Barriers, before: Floats, via: Floats, after: Floats) -> bool:
    return (
        leg_clearance(barriers, before[0], before[1], via[0], via[1]) >= 0.0
        and leg_clearance(barriers, via[0], via[1], after[0], after[1]) >= 0.0
    )


@kernel
def _longest_leg(track: Floats) -> float:
    longest = 0.0
    for k in range(len(track) - 1):
        longest = max(
            longest, math.hypot(track[k + 1, 0] - track[k, 0], track[k + 1, 1] - track[k, 1])
        )
    return longest


@kernel
def _halved(track: Floats, longest: float) -> Floats:
    """The same path, with a point in the middle of every leg that is too long."""
    points = np.empty((2 * len(track) - 1, 2))
    count = 0
    for k in range(len(track) - 1):
        points[count] = track[k]
        count += 1
        if math.hypot(track[k + 1, 0] - track[k, 0], track[k + 1, 1] - track[k, 1]) > longest:
            points[count] = (track[k] + track[k + 1]) / 2.0
            count += 1
    points[count] = track[-1]
    return points[: count + 1]
