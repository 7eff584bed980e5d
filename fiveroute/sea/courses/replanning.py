"""Replanning: the operator T of tier 2 once more, on board and under way.

Discarding and picking up move one node at a time. Here an AUV looks for the best course over
the nodes of its remaining route and the idle nodes that it may take: strings of nodes are taken out
at random, and the course is filled up again by psi (27), blurred by chance, as long as its time in
hand stays non-negative. What collects more is kept, and of equal data what leaves more time. A
course that does not fit at first is shortened by (25) before.

Reference: J. Christiaens and G. Vanden Berghe, "Slack induction by string removals for vehicle
routing problems", Transportation Science 54(2), 2020, doi 10.1287/trsc.2019.0914.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below, uniform
from fiveroute.sea.courses.course import Course, time_in_hand
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.stops import Ints, Stops, insert_stop, remove_stops

__all__ = ["TRIALS", "cheapest_place", "replan"]

TRIALS = 100
"""Attempts to improve a course at a node; more do not help."""

_BLUR = 0.6  # largest share by which chance lowers psi
_LONGEST = 4  # nodes taken out at once, at most


def replan(
    view: Outlook, course: Course, idle: Collection[int], trials: int, seed: int
) -> tuple[Course, tuple[int, ...]]:
    """Improve a course over its own and idle nodes.

    Parameters
    ----------
    view
        What the AUVs expect.
    course
        What the AUV has before it.
    idle
        Nodes that it may visit besides.
    trials
        Number of attempts to improve.
    seed
        Seed of the random numbers.

    Returns
    -------
    course
        The new course; it fits unless not even the way home does.
    left_over
        Nodes of the old course and idle ones that are not on it, in ascending order.
    """
    fitting, dropped = discard(view, course)
    pool = np.array(sorted({*course.route, *idle}), dtype=np.int64)
    if not len(pool):
        return fitting, dropped
    stops = np.zeros(len(pool) + 3, np.int64)
    length = len(fitting.route) + 2
    stops[:length] = course.anchor, *fitting.route, view.destination
    state = np.array([seed], dtype=np.uint64)
    length = _improve(view, stops, length, course.left, course.spread, pool, trials, state)
    route = tuple(stops[1 : length - 1].tolist())
    return replace(course, route=route), tuple(sorted(set(pool.tolist()) - set(route)))


@kernel
def _improve(
    view: Outlook,
    stops: Stops,
    length: int,
    left: float,
    spread: float,
    pool: Ints,
    trials: int,
    state: RandomState,
) -> int:
    """Improve stops in place; returns the new length."""
    end = stops[length - 1]
    best, trial, is_on = stops.copy(), stops.copy(), np.zeros(end + 1, np.bool_)
    most, spare = _data(view, best, length), time_in_hand(view, best, length, left, spread)
    for k in range(trials):
        trial[:length] = best[:length]
        size = length
        if k > 0 and length > 2:
            size = _take_out(trial, length, state)
        is_on[:] = False
        for at in range(1, size - 1):
            is_on[trial[at]] = True
        size = _fill_up(view, trial, size, left, spread, pool, is_on, _BLUR if k else 0.0, state)
        data, hand = _data(view, trial, size), time_in_hand(view, trial, size, left, spread)
        better = data > most + 1e-9 or (data > most - 1e-9 and hand > spare + 1e-9)
        if better and hand >= 0.0:
            best[:size] = trial[:size]
            length, most, spare = size, data, hand
    stops[:length] = best[:length]
    return length


@kernel
def _data(view: Outlook, stops: Stops, length: int) -> float:
    """Data collected on a course."""
    data = 0.0
    for at in range(1, length):
        data += view.profit[stops[at]]
    return data


@kernel
def _take_out(stops: Stops, length: int, state: RandomState) -> int:
    """Take a random string of nodes out; returns the new length."""
    count = 1 + below(state, min(_LONGEST, length - 2))
    first = 1 + below(state, length - 1 - count)
    return remove_stops(stops, length, first, count)


@kernel
def _fill_up(
    view: Outlook,
    stops: Stops,
    length: int,
    left: float,
    spread: float,
    pool: Ints,
    is_on: NDArray[np.bool_],
    blur: float,
    state: RandomState,
) -> int:
    """Insert nodes in decreasing order of blurred psi while there is time; returns the length."""
    faint = np.empty(len(pool))
    for k in range(len(pool)):
        faint[k] = 1.0 - blur * uniform(state)
        if is_on[pool[k]]:
            faint[k] = 0.0
    while True:
        best, chosen, place = 0.0, -1, 0
        for k in range(len(pool)):
            if faint[k] <= 0.0:
                continue
            extra, at = cheapest_place(view, stops, length, pool[k])
            ratio = faint[k] * view.profit[pool[k]] / max(extra, 1.0)
            if ratio > best:
                best, chosen, place = ratio, k, at
        if chosen < 0:
            return length
        faint[chosen] = 0.0
        insert_stop(stops, length, place, pool[chosen])
        if time_in_hand(view, stops, length + 1, left, spread) >= 0.0:
            length += 1
        else:
            remove_stops(stops, length + 1, place, 1)


@kernel
def cheapest_place(view: Outlook, stops: Stops, length: int, node: int) -> tuple[float, int]:
    """Least added time of inserting a node, and the position to insert it at."""
    least, place = np.inf, 1
    for at in range(1, length):
        extra = _detour(view, stops[at - 1], node, stops[at])
        if extra < least:
            least, place = extra, at
    return least, place


@kernel
def _detour(view: Outlook, before: int, node: int, after: int) -> float:
    """Time in seconds that a node adds between two stops."""
    return float(view.legs[before, node] + view.legs[node, after] - view.legs[before, after])
