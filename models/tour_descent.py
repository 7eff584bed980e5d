"""A good route through all nodes, found quickly: local search with fixed ends.

It serves the exact method as its first upper bound and is no rival to the genetic
algorithm. A route is improved by reversing a stretch of it (2-opt) and by moving up to
three nodes in a row elsewhere, either way round (Or-opt), until neither helps. Prefix sums
of the times along the route and against it price every move in constant time, asymmetric
or not. Then two neighbouring stretches are swapped at random, and the descent runs again;
a change for the worse is taken back.

References
----------
I. Or, "Traveling salesman-type combinatorial problems and their relation to the logistics
of regional blood banking", PhD thesis, Northwestern University, 1976.
O. Martin, S. W. Otto and E. W. Felten, "Large-step Markov chains for the traveling
salesman problem", Complex Systems 5(3), 1991 (the double-bridge kick).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.limits import Clock
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

__all__ = ["good_route"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_KICKS = 1000
"""Random changes tried, up to the size below."""

_KICKED_TO = 300
"""Number of nodes above which the descent is not repeated."""

_SLICE = 30_000_000
"""Moves priced between two looks at the clock."""


def good_route(
    problem: TeamOrienteering, clock: Clock, warm_start: Route | None = None, kicks: int = _KICKS
) -> Route:
    """Route through all nodes, at least as short as the warm start.

    Without a warm start it begins by going to the nearest node each time.
    """
    first = nearest_neighbours(problem.travel) if warm_start is None else np.array(warm_start)
    stops = np.array([0, *first, problem.destination], dtype=np.int64)
    if problem.n < 2:
        return tuple(stops[1:-1].tolist())
    rows = max(_SLICE // (7 * problem.n), 1)
    row, quiet = 1, 0
    while quiet < problem.n and not clock.expired:
        row, quiet = descend(problem.travel, stops, row, quiet, rows)
    if quiet >= problem.n and 8 <= problem.n <= _KICKED_TO:
        state = np.array([problem.n], dtype=np.uint64)
        slices = -(-kicks * 20 * problem.n**2 // _SLICE)
        for _ in range(slices):
            if clock.expired:
                break
            kick(problem.travel, stops, -(-kicks // slices), state)
    return tuple(stops[1:-1].tolist())


@kernel
def nearest_neighbours(travel: Floats) -> Integers:
    """All nodes in an order that goes to the nearest one each time, shape (n,)."""
    n = len(travel) - 2
    order = np.arange(1, n + 1)
    node = 0
    for k in range(n):
        nearest = k
        for place in range(k + 1, n):
            if travel[node, order[place]] < travel[node, order[nearest]]:
                nearest = place
        node = order[nearest]
        order[nearest] = order[k]
        order[k] = node
    return order


@kernel
def _sums(travel: Floats, stops: Integers, sums: Floats) -> None:
    """Times from the first stop to each along the route, and against it, shape (2, n + 2)."""
    for k in range(1, len(stops)):
        sums[0, k] = sums[0, k - 1] + travel[stops[k - 1], stops[k]]
        sums[1, k] = sums[1, k - 1] + travel[stops[k], stops[k - 1]]


@kernel
def _reverse(stops: Integers, i: int, j: int) -> None:
    while i < j:
        stops[i], stops[j] = stops[j], stops[i]
        i += 1
        j -= 1


@kernel
def _reversal(travel: Floats, stops: Integers, sums: Floats, i: int) -> bool:
    """Reverse the stretch from i that gains most."""
    best, least = 0, -1e-9 * sums[0, -1]
    before = stops[i - 1]
    for j in range(i + 1, len(stops) - 1):
        change = (
            travel[before, stops[j]]
            + travel[stops[i], stops[j + 1]]
            - travel[before, stops[i]]
            - travel[stops[j], stops[j + 1]]
            + (sums[1, j] - sums[1, i])
            - (sums[0, j] - sums[0, i])
        )
        if change < least:
            best, least = j, change
    if best:
        _reverse(stops, i, best)
    return best > 0


@kernel
def _move(travel: Floats, stops: Integers, sums: Floats, i: int) -> bool:
    """Move the one to three nodes from i on to where that gains most."""
    gap, length, turned, least = -1, 0, False, -1e-9 * sums[0, -1]
    for j in range(i, min(i + 3, len(stops) - 1)):
        head, tail = stops[i], stops[j]
        turn = (sums[1, j] - sums[1, i]) - (sums[0, j] - sums[0, i])
        freed = (
            travel[stops[i - 1], head]
            + travel[tail, stops[j + 1]]
            - travel[stops[i - 1], stops[j + 1]]
        )
        for k in range(len(stops) - 1):
            if i - 1 <= k <= j:
                continue
            before, after = stops[k], stops[k + 1]
            base = -travel[before, after] - freed
            straight = base + travel[before, head] + travel[tail, after]
            if straight < least:
                gap, length, turned, least = k, j - i + 1, False, straight
            reverse = base + travel[before, tail] + travel[head, after] + turn
            if reverse < least:
                gap, length, turned, least = k, j - i + 1, True, reverse
    if gap < 0:
        return False
    j = i + length - 1
    if turned:
        _reverse(stops, i, j)
    low, middle, high = (i, j, gap) if gap > j else (gap + 1, i - 1, j)
    _reverse(stops, low, middle)  # swapping neighbours = reversing each, then both
    _reverse(stops, middle + 1, high)
    _reverse(stops, low, high)
    return True


@kernel
def descend(travel: Floats, stops: Integers, row: int, quiet: int, rows: int) -> tuple[int, int]:
    """Improve the route in place, starting at position `row`, for so many positions.

    Returns the next position, and for how many positions running nothing has been gained:
    n of them make a local optimum.
    """
    n = len(stops) - 2
    sums = np.zeros((2, n + 2))
    _sums(travel, stops, sums)
    for _ in range(rows):
        if quiet >= n:
            break
        quiet += 1
        if _reversal(travel, stops, sums, row) or _move(travel, stops, sums, row):
            _sums(travel, stops, sums)
            quiet = 0
        else:
            row = row % n + 1
    return row, quiet


@kernel
def _random(state: NDArray[np.uint64], below: int) -> int:
    """Next number of a splitmix64 sequence, from 0 to below - 1."""
    state[0] += np.uint64(0x9E3779B97F4A7C15)
    z = state[0]
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return int((z ^ (z >> np.uint64(31))) % np.uint64(below))


@kernel
def kick(travel: Floats, stops: Integers, times: int, state: NDArray[np.uint64]) -> None:
    """Swap two random neighbouring stretches and descend, so many times; keep what is better."""
    n = len(stops) - 2
    longest = min(n // 2, 30)
    sums = np.zeros((2, n + 2))
    _sums(travel, stops, sums)
    least = sums[0, -1]
    for _ in range(times):
        trial = stops.copy()
        one, two = 1 + _random(state, longest), 1 + _random(state, longest)
        low = 1 + _random(state, n - one - two + 1)
        _reverse(trial, low, low + one - 1)
        _reverse(trial, low + one, low + one + two - 1)
        _reverse(trial, low, low + one + two - 1)
        descend(travel, trial, max(low - 1, 1), 0, 1000 * n)
        _sums(travel, trial, sums)
        if sums[0, -1] < least:
            least = sums[0, -1]
            stops[:] = trial
