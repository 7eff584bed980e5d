"""The rebirth operator: any sequence of nodes becomes a feasible and full route.

The greedy strategy behind "S-GGARP" (Zhang, Liu, Zhang, Zheng, Dong 2022,
doi 10.1631/FITEE.2200026) maps individuals of the genetic algorithm that break the time
limit (6) back into the feasible space, and then uses up what time is left:

1. shed: while the route is too long, drop the node of least phi = rho / saved time (25);
2. grow: while a node fits, insert the idle node of greatest psi = rho / added time at its
   cheapest position (26), (27);
3. exchange: where an idle node that collects more fits in the place of a visited one, it
   takes it.

In between the route is shortened, which frees time for more nodes. Ratios are computed
with the guiding legs, and a route is judged by `in_time`, that is, by its samples where
there are any. A node that saves no time is never shed, one that takes no time is
inserted first: both occur where times violate the triangle inequality.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.route_kernels import (
    Case,
    cheapest_place,
    duration,
    in_time,
    shorten,
)
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, uniform
from fiveroute.stops import Stops, insert_stop, remove_stops

__all__ = ["cheapest_places", "rebirth"]


@kernel
def rebirth(case: Case, stops: Stops, length: int, noise: float, state: RandomState) -> int:
    """Make a route feasible and full, in place; returns its new length.

    Parameters
    ----------
    case
        The problem.
    stops, length
        The route; nodes at most once, otherwise arbitrary.
    noise
        Largest share by which chance lowers a node's data in phi and psi; 0 is greedy.
    state
        Random numbers.
    """
    if not in_time(case, stops, length):
        shorten(case.legs, stops, length)
    length = _shed(case, stops, length, noise, state)
    length = _grow(case, stops, length, noise, state)
    for _ in range(4):
        _shorten_in_time(case, stops, length)
        before = length
        length = _grow(case, stops, length, 0.0, state)
        if not _exchange(case, stops, length) and length == before:
            break
    return length


@kernel
def _shorten_in_time(case: Case, stops: Stops, length: int) -> None:
    """Shorten a route, unless samples judge the shorter one to be late."""
    if case.needed == 0:
        shorten(case.legs, stops, length)
        return
    old = stops.copy()
    shorten(case.legs, stops, length)
    if not in_time(case, stops, length) and in_time(case, old, length):
        stops[:] = old


@kernel
def _shed(case: Case, stops: Stops, length: int, noise: float, state: RandomState) -> int:
    legs = case.legs
    while length > 2 and not in_time(case, stops, length):
        worst = 0
        least = np.inf
        for at in range(1, length - 1):
            before, node, after = stops[at - 1], stops[at], stops[at + 1]
            saved = legs[before, node] + legs[node, after] - legs[before, after]
            if saved <= 0.0:
                continue
            phi = case.profit[node] * (1.0 - noise * uniform(state)) / saved
            if phi < least:
                least = phi
                worst = at
        if worst == 0:
            break
        length = remove_stops(stops, length, worst, 1)
    return length


@kernel
def cheapest_places(
    legs: NDArray[np.float64], stops: Stops, length: int, extra: NDArray[np.float64], place: Stops
) -> None:
    """Fill the added time and the position of the cheapest insertion of every idle node.

    Parameters
    ----------
    extra
        Filled with added times in seconds, shape (k + 2,); infinite at visited nodes.
    place
        Filled with the position before which to insert, shape (k + 2,); 0 at visited nodes.
    """
    extra[:] = np.inf
    place[:] = -1
    for at in range(length):
        place[stops[at]] = 0
    for node in range(len(place)):
        if place[node] < 0:
            extra[node], place[node] = cheapest_place(legs, stops, length, node)


@kernel
def _grow(case: Case, stops: Stops, length: int, noise: float, state: RandomState) -> int:
    size = len(case.profit)
    extra, place, gain = np.empty(size), np.empty(size, np.int64), np.empty(size)
    cheapest_places(case.legs, stops, length, extra, place)
    for node in range(size):
        gain[node] = case.profit[node] * (1.0 - noise * uniform(state))
    slack = case.allowed - duration(case.legs, stops, length)
    while True:
        node = _greatest_psi(gain, extra, slack)
        if node == 0:
            return length
        at = place[node]
        length = insert_stop(stops, length, at, node)
        if case.needed > 0 and not in_time(case, stops, length):
            length = remove_stops(stops, length, at, 1)
            gain[node] = -1.0
            continue
        slack -= extra[node]
        _update_places(case.legs, stops, length, at, extra, place)


@kernel
def _greatest_psi(gain: NDArray[np.float64], extra: NDArray[np.float64], slack: float) -> int:
    """The idle node of greatest psi that fits, 0 without one; a gain of -1 rules a node out.

    A node that costs no time comes before all that do, the greatest saving first.
    """
    best = 0
    most = 0.0
    saving = 0.0
    for node in range(1, len(gain) - 1):
        if extra[node] > slack or gain[node] < 0.0:
            continue
        if extra[node] <= 0.0:
            if -extra[node] > saving or (gain[node] > 0.0 and most < np.inf):
                best, most, saving = node, np.inf, -extra[node]
        elif gain[node] > most * extra[node]:
            best, most = node, gain[node] / extra[node]
    return best


@kernel
def _update_places(
    legs: NDArray[np.float64],
    stops: Stops,
    length: int,
    at: int,
    extra: NDArray[np.float64],
    place: Stops,
) -> None:
    """Correct `cheapest_places` after an insertion at position `at`."""
    before, inserted, after = stops[at - 1], stops[at], stops[at + 1]
    extra[inserted] = np.inf
    place[inserted] = 0
    for node in range(len(place)):
        if place[node] == 0:
            continue
        if place[node] == at:  # its gap is gone
            extra[node], place[node] = cheapest_place(legs, stops, length, node)
            continue
        if place[node] > at:
            place[node] += 1
        ahead = legs[before, node] + legs[node, inserted] - legs[before, inserted]
        behind = legs[inserted, node] + legs[node, after] - legs[inserted, after]
        if ahead < extra[node]:
            extra[node], place[node] = ahead, at
        if behind < extra[node]:
            extra[node], place[node] = behind, at + 1


@kernel
def _exchange(case: Case, stops: Stops, length: int) -> bool:
    """Let an idle node take the place of a visited one that collects less."""
    size = len(case.profit)
    extra, place = np.empty(size), np.empty(size, np.int64)
    cheapest_places(case.legs, stops, length, extra, place)
    slack = case.allowed - duration(case.legs, stops, length)
    old = stops.copy()
    for at in range(1, length - 1):
        node, to = _substitute(case, stops, at, slack, extra, place)
        if node == 0:
            continue
        remove_stops(stops, length, at, 1)
        insert_stop(stops, length - 1, to if to <= at else to - 1, node)
        if case.needed == 0 or in_time(case, stops, length):
            return True
        stops[:] = old
    return False


@kernel
def _substitute(
    case: Case,
    stops: Stops,
    at: int,
    slack: float,
    extra: NDArray[np.float64],
    place: Stops,
) -> tuple[int, int]:
    """The idle node that collects most in exchange for that at `at`, and its position."""
    legs = case.legs
    before, visited, after = stops[at - 1], stops[at], stops[at + 1]
    closed = legs[before, after]
    room = slack + legs[before, visited] + legs[visited, after] - closed
    best = to = 0
    for node in range(1, len(place) - 1):
        if place[node] == 0 or case.profit[node] <= case.profit[visited if best == 0 else best]:
            continue
        if legs[before, node] + legs[node, after] - closed <= room:
            best, to = node, at
        elif extra[node] <= room and place[node] != at and place[node] != at + 1:
            best, to = node, place[node]
    return best, to
