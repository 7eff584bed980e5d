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
Integers = NDArray[np.int64]

_SMALLEST_MOVE = 0.004  # sideways, of the longest leg in the end
_SWEEPS = 100  # at most, with one distance


def straighten(
    grid: CurrentGrid, barriers: Barriers, track: Floats, t: float, speed: float, longest: float
) -> Floats:
    """A path that arrives no later, of legs that are hardly longer than `longest` metres.

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
        Length of a leg in metres that is not halved any more.
    """
    parent, point = _shortcut(grid, barriers, track, t, speed), len(track) - 1
    kept = [point]
    while point > 0:
        point = int(parent[point])
        kept.append(point)
    track = track[kept[::-1]]
    while True:
        lengths = np.hypot(*np.diff(track, axis=0).T)
        _relax(grid, barriers, track, t, speed, lengths.max() / 2.0, _SMALLEST_MOVE * longest)
        long = np.flatnonzero(lengths > longest)
        if not long.size:
            return track
        track = np.insert(track, long + 1, (track[long] + track[long + 1]) / 2.0, axis=0)


@kernel
def _shortcut(
    grid: CurrentGrid, barriers: Barriers, track: Floats, t: float, speed: float
) -> Integers:
    """Where each point is earliest reached from, by straight legs from point to any later one."""
    arrival, parent = np.full(len(track), math.inf), np.zeros(len(track), dtype=np.int64)
    arrival[0] = t
    for i in range(len(track)):
        x0, y0 = track[i]
        for j in range(i + 1, len(track)):
            x1, y1 = track[j]
            time = arrival[i] + leg_time(grid, x0, y0, x1, y1, arrival[i], speed)
            if time < arrival[j] and leg_clearance(barriers, x0, y0, x1, y1) >= 0.0:
                arrival[j], parent[j] = time, i
    return parent


@kernel
def _relax(
    grid: CurrentGrid,
    barriers: Barriers,
    track: Floats,
    t: float,
    speed: float,
    distance: float,
    smallest: float,
) -> None:
    """Move the inner points sideways by a distance and less, in place, while it helps."""
    while distance > smallest:
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
        x0, y0 = track[k - 1]
        x, y = track[k]
        x2, y2 = track[k + 1]
        share = distance / max(math.hypot(x2 - x0, y2 - y0), distance)
        first = leg_time(grid, x0, y0, x, y, t, speed)
        best = first + leg_time(grid, x, y, x2, y2, t + first, speed)
        for side in (-share, share):
            x1, y1 = x - side * (y2 - y0), y + side * (x2 - x0)
            time = leg_time(grid, x0, y0, x1, y1, t, speed)
            later = time + leg_time(grid, x1, y1, x2, y2, t + time, speed)
            if later < best and _keeps_clear(barriers, x0, y0, x1, y1, x2, y2):
                best, first, moved = later, time, True
                track[k] = x1, y1
        t += first
    return moved


@kernel
def _keeps_clear(
    barriers: Barriers, x0: float, y0: float, x1: float, y1: float, x2: float, y2: float
) -> bool:
    before = leg_clearance(barriers, x0, y0, x1, y1)
    return before >= 0.0 and leg_clearance(barriers, x1, y1, x2, y2) >= 0.0
