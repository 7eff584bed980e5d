"""Replanning for the whole fleet: the best courses from where the AUVs are, over all nodes left.

A team orienteering problem in which every AUV starts at an anchor and a time of its own, and must
keep its time in hand (`fiveroute.sea.courses.course`) non-negative, reserve included. Up to `EXACT`
nodes it is solved exactly (`fiveroute.sea.courses.exact_replanning`); beyond, by ruin and recreate:
strings of nodes are taken out of some courses where they pass a random node, and all idle nodes are
put back in a random order, each where it costs least of all places that leave the AUV its time.
Worse fleets are accepted now and then, the less the later (simulated annealing). An AUV that is
late already sails home, whatever remains of its course.

Reference: J. Christiaens and G. Vanden Berghe, "Slack induction by string removals for vehicle
routing problems", Transportation Science 54(2), 2020, doi 10.1287/trsc.2019.0914.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below, uniform
from fiveroute.routes import Route
from fiveroute.sea.courses.course import Course, time_in_hand
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.exact_replanning import EXACT, best_courses
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.stops import Ints, Stops, insert_stop, remove_stops

__all__ = ["TRIALS", "replan_fleet"]

TRIALS = 100
"""Attempts to improve the fleet for every node that is left."""

_LONGEST = 6  # nodes taken out of one course at once, at most
_BLINK = 0.02  # probability that a place is overlooked
_WARM, _COLD = 0.05, 0.001  # temperatures, as shares of the mean data of a node


def replan_fleet(
    view: Outlook, courses: Sequence[Course], idle: Collection[int], seed: int, trials: int = TRIALS
) -> tuple[Route, ...]:
    """The routes that collect most, and of these the ones that leave most time.

    Parameters
    ----------
    view
        What the AUVs expect.
    courses
        What every AUV has before it.
    idle
        Nodes that nobody has before it.
    seed
        Seed of the random numbers.
    trials
        Attempts of the search for every node that is left.
    """
    fitting = [discard(view, course)[0] for course in courses]
    pool = np.array(sorted({*idle}.union(*(course.route for course in courses))), dtype=np.int64)
    if not courses or not len(pool):
        return tuple(course.route for course in fitting)
    if len(pool) <= EXACT:
        return best_courses(view, courses, pool)
    fleet = np.zeros((len(courses), len(pool) + 3), np.int64)
    lengths = np.array([len(course.route) + 2 for course in fitting])
    for stops, length, course in zip(fleet, lengths, fitting, strict=True):
        stops[:length] = course.anchor, *course.route, view.destination
    left = np.array([course.left for course in courses])
    spread = np.array([course.spread for course in courses])
    state = np.array([seed], dtype=np.uint64)
    _improve(view, fleet, lengths, left, spread, pool, trials * len(pool), state)
    return tuple(
        tuple(stops[1 : length - 1].tolist()) for stops, length in zip(fleet, lengths, strict=True)
    )


@kernel
def _improve(
    view: Outlook,
    best: Ints,
    best_lengths: Ints,
    left: NDArray[np.float64],
    spread: NDArray[np.float64],
    pool: Ints,
    trials: int,
    state: RandomState,
) -> None:
    """Improve a fleet in place; its arrays come one by one, as a tuple of them takes 7 % longer."""
    now, lengths = best.copy(), best_lengths.copy()
    trial, trial_lengths = best.copy(), best_lengths.copy()
    most, spare = _worth(view, best, best_lengths, left, spread)
    data = most
    warm = _WARM * view.profit[pool].mean()
    cooling = (_COLD / _WARM) ** (1.0 / trials)
    for _ in range(trials):
        trial[:], trial_lengths[:] = now, lengths
        _ruin(view, trial, trial_lengths, pool, state)
        _recreate(view, trial, trial_lengths, left, spread, pool, state)
        found, hand = _worth(view, trial, trial_lengths, left, spread)
        if found > most + 1e-9 or (found > most - 1e-9 and hand > spare + 1e-6):
            best[:], best_lengths[:], most, spare = trial, trial_lengths, found, hand
        if found > data + warm * math.log(1.0 - uniform(state)):
            now[:], lengths[:], data = trial, trial_lengths, found
        warm *= cooling


@kernel
def _worth(
    view: Outlook,
    fleet: Ints,
    lengths: Ints,
    left: NDArray[np.float64],
    spread: NDArray[np.float64],
) -> tuple[float, float]:
    """Data collected by a fleet, and its time in hand, all AUVs together."""
    data, hand = 0.0, 0.0
    for m in range(len(fleet)):
        for at in range(1, lengths[m] - 1):
            data += view.profit[fleet[m, at]]
        hand += time_in_hand(view, fleet[m], lengths[m], left[m], spread[m])
    return data, hand


@kernel
def _ruin(view: Outlook, fleet: Ints, lengths: Ints, pool: Ints, state: RandomState) -> None:
    """Take a string of nodes out of one or more courses, each where it passes a random node."""
    centre = pool[below(state, len(pool))]
    for _ in range(1 + below(state, len(fleet))):
        m = below(state, len(fleet))
        inner = lengths[m] - 2
        if inner == 0:
            continue
        count = 1 + below(state, min(_LONGEST, inner))
        nearest, least = 1, np.inf
        for at in range(1, inner + 1):
            distance = view.legs[fleet[m, at], centre]
            if distance < least:
                nearest, least = at, distance
        first = min(max(nearest - below(state, count), 1), inner + 1 - count)
        lengths[m] = remove_stops(fleet[m], lengths[m], first, count)


@kernel
def _recreate(
    view: Outlook,
    fleet: Ints,
    lengths: Ints,
    left: NDArray[np.float64],
    spread: NDArray[np.float64],
    pool: Ints,
    state: RandomState,
) -> None:
    """Put idle nodes in, the rich or simply any first, each where it costs least."""
    is_on = np.zeros(len(view.profit), np.bool_)
    for m in range(len(fleet)):
        for at in range(1, lengths[m] - 1):
            is_on[fleet[m, at]] = True
    by_data = uniform(state)
    urgency = np.empty(len(pool))
    for k in range(len(pool)):
        urgency[k] = -by_data * view.profit[pool[k]] + (1.0 - by_data) * uniform(state)
    for k in np.argsort(urgency):
        if not is_on[pool[k]]:
            _insert(view, fleet, lengths, left, spread, pool[k], state)


@kernel
def _insert(
    view: Outlook,
    fleet: Ints,
    lengths: Ints,
    left: NDArray[np.float64],
    spread: NDArray[np.float64],
    node: int,
    state: RandomState,
) -> None:
    """Insert a node where it adds least time to an AUV that has it; nowhere, if none has."""
    chosen, place, least = -1, 0, np.inf
    for m in range(len(fleet)):
        stops, length = fleet[m], lengths[m]
        at, extra = _cheapest(view, stops, length, node, state)
        if extra >= least:
            continue
        insert_stop(stops, length, at, node)
        if time_in_hand(view, stops, length + 1, left[m], spread[m]) >= 0.0:
            chosen, place, least = m, at, extra
        remove_stops(stops, length + 1, at, 1)
    if chosen >= 0:
        lengths[chosen] = insert_stop(fleet[chosen], lengths[chosen], place, node)


@kernel
def _cheapest(
    view: Outlook, stops: Stops, length: int, node: int, state: RandomState
) -> tuple[int, float]:
    """As `replanning.cheapest_place`, place first, but that places are overlooked now and then."""
    place, least = 1, np.inf
    for at in range(1, length):
        before, after = stops[at - 1], stops[at]
        extra = view.legs[before, node] + view.legs[node, after] - view.legs[before, after]
        if extra < least and uniform(state) >= _BLINK:
            place, least = at, extra
    return place, least
