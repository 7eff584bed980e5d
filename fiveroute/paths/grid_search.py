"""Earliest arrivals on a lattice of points: Dijkstra's algorithm with a wide stencil.

From every lattice point lead straight legs to all points that a coprime move within a few
cells reaches: 96 directions within six cells, where eight neighbours would bend every
path to multiples of 45 degrees. A leg takes what it takes in the current at the time it is
begun. Who leaves later does not arrive earlier, since the speed through the water is positive;
so labels may be set once and for all in the order of arrival (Dreyfus 1969).

The start is joined to all lattice points around it and to every goal, and a goal to all
lattice points around it; neither need lie on the lattice.

A leg is integrated only where it may improve on what is known: its mean current is at most that
at its begin and half the change that the current's gradient allows, and the time for it at least
its length at the mean speed over ground. For a single goal the search is in the order of
arrival plus the distance left at the fastest speed over ground (Hart, Nilsson and Raphael 1968).

References
----------
S. E. Dreyfus, "An appraisal of some shortest-path algorithms", Operations Research 17 (1969),
doi 10.1287/opre.17.3.395.
P. E. Hart, N. J. Nilsson and B. Raphael, "A formal basis for the heuristic determination of
minimum cost paths", IEEE Transactions on Systems Science and Cybernetics 4 (1968),
doi 10.1109/TSSC.1968.300136.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance, leg_clearance
from fiveroute.ocean.current_grid import CurrentGrid, velocity
from fiveroute.paths.legs import leg_time

__all__ = ["Labels", "Lattice", "Sea", "no_labels", "search", "stencil", "surroundings"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_LAND_SLOPE = math.sqrt(2.0)  # steepest growth of a bilinear interpolation of distances


class Lattice(NamedTuple):
    """Points of a regular grid, numbered row by row from the south-west.

    Parameters
    ----------
    west, south
        The first point in metres.
    step
        Spacing in metres.
    rows, columns
        Number of points to the north and to the east.
    """

    west: float
    south: float
    step: float
    rows: int
    columns: int


class Sea(NamedTuple):
    """What the search asks of the ocean and the vehicle.

    Parameters
    ----------
    grid, barriers
        The current, and where not to be.
    lattice
        Points of the paths.
    speed
        Speed through the water in metres per second.
    fastest
        Bound on the speed of the water in metres per second.
    gradient
        Bound on its change with the distance in 1/s; infinite where it varies in time.
    """

    grid: CurrentGrid
    barriers: Barriers
    lattice: Lattice
    speed: float
    fastest: float
    gradient: float


class Labels(NamedTuple):
    """What the search knows of every point: the lattice's, then the start, then the goals.

    Parameters
    ----------
    time
        Earliest arrival found, in seconds.
    key
        What the queue is ordered by, in seconds.
    parent
        The point that it was reached from, -1 if none.
    heap
        The queue, a binary heap of points.
    place
        Where in the heap a point stands, -1 if it does not.
    size
        Length of the queue, shape (1,).
    """

    time: Floats
    key: Floats
    parent: Integers
    heap: Integers
    place: Integers
    size: Integers


class _Origin(NamedTuple):
    """Where legs begin: a point, its position, time, clearance, and current."""

    point: int
    x: float
    y: float
    time: float
    room: float
    u: float
    v: float


def no_labels(points: int) -> Labels:
    """Labels of points that are all unreached."""
    return Labels(
        np.full(points, math.inf),
        np.full(points, math.inf),
        np.full(points, -1, dtype=np.int64),
        np.zeros(points, dtype=np.int64),
        np.full(points, -1, dtype=np.int64),
        np.zeros(1, dtype=np.int64),
    )


def stencil(radius: int) -> Integers:
    """Moves (up, across) in cells, one for each direction within a square, shape (k, 2)."""
    reach = range(-radius, radius + 1)
    moves = [(up, across) for up in reach for across in reach if math.gcd(up, across) == 1]
    return np.array(moves, dtype=np.int64)


def surroundings(radius: int) -> Integers:
    """Moves (up, across) from a cell's south-western point to all within reach, shape (k, 2)."""
    reach = range(-radius, radius + 2)
    return np.array([(up, across) for up in reach for across in reach], dtype=np.int64)


@kernel
def search(
    sea: Sea,
    moves: Integers,
    around: Integers,
    start: Floats,
    goals: Floats,
    begin: float,
    labels: Labels,
) -> None:
    """Fill fresh labels until all goals have their last, or none can be reached any more.

    Parameters
    ----------
    sea
        The ocean and the lattice.
    moves, around
        The stencil, and the surroundings of the start, shape (k, 2).
    start, goals
        Positions in metres, shape (2,) and (g, 2).
    begin
        When all paths begin, in seconds.
    labels
        Of the lattice's points, the start and the goals; filled.
    """
    start_point = sea.lattice.rows * sea.lattice.columns
    reach, missing = moves.max() * sea.lattice.step, len(goals)
    _improve(labels, start_point, -1, begin, begin)
    while labels.size[0] > 0 and missing > 0:
        point = _pop(labels)
        if point > start_point:
            missing -= 1
            continue
        first = point == start_point
        origin = _origin(sea, point, start, labels.time[point])
        _spread(sea, origin, around if first else moves, goals, labels)
        for k in range(len(goals)):
            x, y = goals[k]
            if first or max(abs(x - origin.x), abs(y - origin.y)) <= reach:
                _sail(sea, origin, start_point + 1 + k, x, y, goals, labels)


@kernel
def _origin(sea: Sea, point: int, start: Floats, time: float) -> _Origin:
    lattice = sea.lattice
    x, y = start
    if point < lattice.rows * lattice.columns:
        x = lattice.west + (point % lattice.columns) * lattice.step
        y = lattice.south + (point // lattice.columns) * lattice.step
    u, v = velocity(sea.grid, x, y, time)
    return _Origin(point, x, y, time, clearance(sea.barriers, x, y) / _LAND_SLOPE, u, v)


@kernel
def _spread(sea: Sea, origin: _Origin, moves: Integers, goals: Floats, labels: Labels) -> None:
    """Sail from a point by all moves, counted from its cell's south-western point."""
    lattice = sea.lattice
    row = math.floor((origin.y - lattice.south) / lattice.step + 1e-9)
    column = math.floor((origin.x - lattice.west) / lattice.step + 1e-9)
    for up, across in moves:
        i, j = row + up, column + across
        if 0 <= i < lattice.rows and 0 <= j < lattice.columns:
            x, y = lattice.west + j * lattice.step, lattice.south + i * lattice.step
            _sail(sea, origin, i * lattice.columns + j, x, y, goals, labels)


@kernel
def _sail(
    sea: Sea, origin: _Origin, point: int, x: float, y: float, goals: Floats, labels: Labels
) -> None:
    """Sail a straight leg to a point, if it gets there sooner and keeps clear."""
    east, north = x - origin.x, y - origin.y
    length = math.hypot(east, north)
    if origin.time + _least_time(sea, origin, east, north, length) >= labels.time[point]:
        return
    time = origin.time + leg_time(sea.grid, origin.x, origin.y, x, y, origin.time, sea.speed)
    if time >= labels.time[point]:
        return
    if length > origin.room and leg_clearance(sea.barriers, origin.x, origin.y, x, y) < 0.0:
        return
    left = math.hypot(goals[0, 0] - x, goals[0, 1] - y) if len(goals) == 1 else 0.0
    _improve(labels, point, origin.point, time, time + left / (sea.speed + sea.fastest))


@kernel
def _least_time(sea: Sea, origin: _Origin, east: float, north: float, length: float) -> float:
    """Lower bound on the time of a leg: its length at no less than its mean speed."""
    if length == 0.0:
        return 0.0
    along = (origin.u * east + origin.v * north) / length + 0.5 * sea.gradient * length
    return length / (sea.speed + min(along, sea.fastest))


@kernel
def _improve(labels: Labels, point: int, parent: int, time: float, key: float) -> None:
    """Give a point an earlier label, and its place in the queue."""
    labels.time[point], labels.key[point], labels.parent[point] = time, key, parent
    place = labels.place[point]
    if place < 0:
        place = labels.size[0]
        labels.size[0] += 1
    while place > 0 and labels.key[labels.heap[(place - 1) // 2]] > key:
        _put(labels, labels.heap[(place - 1) // 2], place)
        place = (place - 1) // 2
    _put(labels, point, place)


@kernel
def _pop(labels: Labels) -> int:
    """Take the first point from the queue."""
    first: int = labels.heap[0]
    labels.place[first] = -1
    labels.size[0] -= 1
    size, place = labels.size[0], 0
    if size == 0:
        return first
    last = labels.heap[size]
    while 2 * place + 1 < size:
        child = 2 * place + 1
        if child + 1 < size and labels.key[labels.heap[child + 1]] < labels.key[labels.heap[child]]:
            child += 1
        if labels.key[labels.heap[child]] >= labels.key[last]:
            break
        _put(labels, labels.heap[child], place)
        place = child
    _put(labels, last, place)
    return first


@kernel
def _put(labels: Labels, point: int, place: int) -> None:
    labels.heap[place], labels.place[point] = point, place
