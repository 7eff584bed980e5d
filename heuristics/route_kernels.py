"""One AUV's orienteering problem as kernels see it, and the shortening of a route.

A route is an array of stops with both ends: stops[0] is the start (vertex 0),
stops[length - 1] the destination (the last vertex), the rest of the array is unused.
Service times are folded into the legs that lead to their nodes, legs[i, j] = t_ij + t_j,
so the duration of a route is a sum of legs. Legs may be asymmetric, so reversals are
evaluated in the direction in which they would be sailed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.stops import Stops

__all__ = [
    "Case",
    "cheapest_place",
    "collected",
    "duration",
    "in_time",
    "shorten",
]


class Case(NamedTuple):
    """A single-AUV problem over k candidate nodes, vertices 1 to k.

    Parameters
    ----------
    legs
        Leg times in seconds that guide the search, service included, shape (k + 2, k + 2).
    profit
        Data of every vertex, shape (k + 2,), zero at both ends.
    allowed
        Longest duration in seconds.
    samples
        Sampled legs, shape (k + 2, k + 2, K); K = 0 for planned times.
    needed
        Number of samples in which a route must be in time; 0 judges it by `legs`.
    """

    legs: NDArray[np.float64]
    profit: NDArray[np.float64]
    allowed: float
    samples: NDArray[np.float64]
    needed: int


@kernel
def duration(legs: NDArray[np.float64], stops: Stops, length: int) -> float:
    """Duration of a route in seconds."""
    total = 0.0
    for at in range(1, length):
        total += legs[stops[at - 1], stops[at]]
    return total


@kernel
def collected(profit: NDArray[np.float64], stops: Stops, length: int) -> float:
    """Data collected on a route, objective (19)."""
    total = 0.0
    for at in range(1, length - 1):
        total += profit[stops[at]]
    return total


@kernel
def in_time(case: Case, stops: Stops, length: int) -> bool:
    """Whether a route keeps to the limit, (6), in as many samples as are needed."""
    if case.needed == 0:
        return duration(case.legs, stops, length) <= case.allowed
    totals = np.zeros(case.samples.shape[2])
    for at in range(1, length):
        totals += case.samples[stops[at - 1], stops[at]]
    return bool(np.sum(totals <= case.allowed) >= case.needed)


@kernel
def cheapest_place(
    legs: NDArray[np.float64], stops: Stops, length: int, node: int
) -> tuple[float, int]:
    """Least added time in seconds of inserting a node, and the position to insert it at."""
    least = np.inf
    place = 0
    for at in range(1, length):
        before, after = stops[at - 1], stops[at]
        extra = legs[before, node] + legs[node, after] - legs[before, after]
        if extra < least:
            least = extra
            place = at
    return least, place


@kernel
def shorten(legs: NDArray[np.float64], stops: Stops, length: int) -> None:
    """Reorder the route in place until neither 2-opt nor or-opt shortens it."""
    while _two_opt(legs, stops, length) or _or_opt(legs, stops, length):
        pass


@kernel
def _reverse(stops: Stops, first: int, last: int) -> None:
    while first < last:
        stops[first], stops[last] = stops[last], stops[first]
        first += 1
        last -= 1


@kernel
def _two_opt(legs: NDArray[np.float64], stops: Stops, length: int) -> bool:
    """One pass of reversals stops[i..j]; the inner legs are summed both ways as j grows."""
    improved = False
    for i in range(1, length - 2):
        forward = backward = 0.0
        j = i + 1
        while j < length - 1:
            forward += legs[stops[j - 1], stops[j]]
            backward += legs[stops[j], stops[j - 1]]
            before, after = stops[i - 1], stops[j + 1]
            old = legs[before, stops[i]] + forward + legs[stops[j], after]
            new = legs[before, stops[j]] + backward + legs[stops[i], after]
            if new < old - 1e-9 * old:
                _reverse(stops, i, j)
                improved = True
                forward = backward = 0.0
                j = i
            j += 1
    return improved


@kernel
def _or_opt(legs: NDArray[np.float64], stops: Stops, length: int) -> bool:
    """One pass of moving chains of one to three stops to their cheapest place."""
    improved = False
    for size in range(1, 4):
        for i in range(1, length - size):
            j = i + size - 1
            to = _cheapest_gap(legs, stops, length, i, j)
            if to == i:
                continue
            improved = True
            _reverse(stops, i, j)
            if to < i:  # three reversals move the chain and keep its sense
                _reverse(stops, to, i - 1)
                _reverse(stops, to, j)
            else:
                _reverse(stops, j + 1, to - 1)
                _reverse(stops, i, to - 1)
    return improved


@kernel
def _cheapest_gap(legs: NDArray[np.float64], stops: Stops, length: int, i: int, j: int) -> int:
    """Position before which the chain stops[i..j] is cheapest; i where it should stay."""
    first, last = stops[i], stops[j]
    before, after = stops[i - 1], stops[j + 1]
    saved = legs[before, first] + legs[last, after] - legs[before, after]
    least = saved - 1e-9 * (legs[before, first] + legs[last, after] + legs[before, after])
    to = i
    for at in range(1, length):
        if i <= at <= j + 1:
            continue
        before, after = stops[at - 1], stops[at]
        extra = legs[before, first] + legs[last, after] - legs[before, after]
        if extra < least:
            least = extra
            to = at
    return to
