"""Recourse: what a course is worth to an AUV that may still leave nodes out under way.

A reserve asks whether a course, sailed as planned, ends in time. But an AUV decides anew at every
node, when it knows its luck so far: most of what it holds back for legs far ahead it will not need,
and a node that it can do without is an option, worth having on the way. Let a course lead over
nodes 1, 2, ..., any of which may be left out. With the time tau left at node i, the AUV can expect

    V_i(tau) = max{ -c P(f(t_ih) > tau),  max over j > i of rho_j + E V_j(tau - f(t_ij) - t_j) },

h being the destination and V_i = -c where tau < 0. It sails to the j for which the maximum is
taken. This is dynamic programming with c as the Lagrange multiplier of the chance constraint that
the AUV be in time (orienteering in stochastic time: A. Campbell, M. Gendreau, B. Thomas, Annals of
Operations Research 186, 2011, doi 10.1007/s10479-011-0895-2).

The price c of a late return follows from the reserve of z standard deviations. The last bet of an
AUV, for a node of mean data rho, is worth while if it is lost with probability rho / c at most; c
is such that this is 1 - Phi(1.35 z), or 1 - Phi(2.1 z) where a vehicle sails. The reserve itself
stays a promise as well: what the AUV has before it, sailed as planned, always ends in time with
probability Phi(z) (`fiveroute.sea.courses.course`), but without the longest leg's extra share,
which the price replaces.

V is kept at equal steps of time and linear between them. Legs under way are taken as normal, at
nine equidistant points; the leg home, which nothing can correct, with the whole law (12).
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.replanning import TRIALS, cheapest_place, replan
from fiveroute.stops import Ints, Stops, insert_stop, remove_stops

__all__ = [
    "SKIPS",
    "expected_route",
    "gain_of",
    "gains",
    "look_ahead",
    "next_stop",
    "reconsider",
    "toll_home",
    "with_recourse",
]

SKIPS = 4
"""Nodes after a vertex among which an AUV chooses the next; home is always a choice."""

_SPACING, _REACH = 0.75, 4  # of the points of a normal number, and how many on each side

_POINTS = _SPACING * np.arange(-_REACH, _REACH + 1)
_WEIGHTS = np.exp(-0.5 * _POINTS**2) / np.exp(-0.5 * _POINTS**2).sum()


def with_recourse(view: Outlook) -> Outlook:
    """What AUVs expect that look ahead: the price of being late is enough for the last leg."""
    return view._replace(longest=0.0)


def reconsider(
    view: Outlook, course: Course, idle: Collection[int]
) -> tuple[Course, tuple[int, ...]]:
    """What an AUV at a node makes of its course and of idle nodes, as options.

    Every idle node is put where it costs least, if the course is worth more with it. What the AUV
    will visit if all legs take what is expected is the new course, shortened by (25) should it
    not keep the reserve. Where nothing is uncertain there is nothing to look ahead to, and who does
    not look ahead takes the best course by what is expected of it.

    Returns
    -------
    course
        The new course; it fits unless not even the way home does.
    left_over
        Nodes of the old course and idle ones that are not on it, in ascending order.
    """
    if view.longest > 0.0 or not view.variance.any():
        return replan(view, course, idle, TRIALS, 0)
    pool = {*course.route, *idle}
    stops = np.zeros(len(pool) + 2, np.int64)
    length = len(course.route) + 2
    stops[:length] = course.anchor, *course.route, view.destination
    options = np.array(sorted(set(idle) - set(course.route)), dtype=np.int64)
    route = _reconsider(view, stops, length, course.left, options)
    fitting = _shorten(view, replace(course, route=tuple(route.tolist())))
    if in_hand(view, fitting) < 0.0:
        fitting = discard(view, course)[0]
    return fitting, tuple(sorted(pool.difference(fitting.route)))


def _shorten(view: Outlook, course: Course) -> Course:
    """Discard (25) what does not keep the reserve, the first node last of all."""
    if course.route:
        i, (j, *rest) = course.anchor, course.route
        leg, spread = float(view.legs[i, j]), float(view.variance[i, j])
        beyond = Course(j, course.time + leg, spread, course.budget, tuple(rest))
        course = replace(course, route=(j, *discard(view, beyond)[0].route))
    return discard(view, course)[0]


@kernel
def _reconsider(view: Outlook, stops: Stops, length: int, left: float, options: Ints) -> Ints:
    """The expected route over a course and options that it takes in, in stops with room."""
    values = np.empty((len(stops), view.late.shape[1]))
    look_ahead(view, stops, length, values)
    worth = next_stop(view, stops, length, 0, left, values)[1]
    for node in options:
        _, place = cheapest_place(view, stops, length, node)
        insert_stop(stops, length, place, node)
        look_ahead(view, stops, length + 1, values)
        then = next_stop(view, stops, length + 1, 0, left, values)[1]
        if then > worth + 1e-9:
            length, worth = length + 1, then
        else:
            remove_stops(stops, length + 1, place, 1)
    return expected_route(view, stops, length, left, values)


@kernel
def look_ahead(view: Outlook, stops: Stops, length: int, values: NDArray[np.float64]) -> None:
    """Fill in V for every node of a course; values have a row for every stop."""
    gain = np.empty(values.shape[1])
    for at in range(length - 2, 0, -1):
        here = values[at]
        for g in range(len(gain)):
            here[g] = -view.price * view.late[stops[at], g]
        for to in range(at + 1, min(at + 1 + SKIPS, length - 1)):
            gains(view, stops[at], stops[to], values[to], gain)
            for g in range(len(gain)):
                here[g] = max(here[g], gain[g])


@kernel
def gains(
    view: Outlook,
    i: int,
    j: int,
    after: NDArray[np.float64],
    gain: NDArray[np.float64],
) -> None:
    """Fill in what it is worth to sail from i to j, where V is `after`, for every time left.

    A leg that takes longer than all times left is as late as one that takes just longer.
    """
    deviation = math.sqrt(view.variance[i, j])
    steps = np.maximum(view.legs[i, j] + deviation * _POINTS, 0.0) / view.step
    steps = np.minimum(steps, float(len(gain)))
    first = int(steps[0])
    share = np.zeros(int(steps[-1]) - first + 2)
    for k in range(len(_POINTS)):
        whole = int(steps[k])
        share[whole - first] += _WEIGHTS[k] * (1.0 - (steps[k] - whole))
        share[whole - first + 1] += _WEIGHTS[k] * (steps[k] - whole)
    gain[:] = view.profit[j]
    for k in range(len(share)):
        begin = min(first + k, len(gain))
        for g in range(begin):
            gain[g] -= share[k] * view.price
        for g in range(begin, len(gain)):
            gain[g] += share[k] * after[g - begin]


@kernel
def _between(values: NDArray[np.float64], steps: float, price: float) -> float:
    """V between two steps of time; values end where no AUV has more time."""
    if steps < 0.0:
        return -price
    whole = min(int(steps), len(values) - 2)
    return float(values[whole] + (steps - whole) * (values[whole + 1] - values[whole]))


@kernel
def next_stop(
    view: Outlook,
    stops: Stops,
    length: int,
    at: int,
    left: float,
    values: NDArray[np.float64],
) -> tuple[int, float]:
    """Position of the stop after stops[at] with `left` seconds left, and V there."""
    best, worth = length - 1, -toll_home(view, stops[at], left)
    for to in range(at + 1, min(at + 1 + SKIPS, length - 1)):
        gain = gain_of(view, stops[at], stops[to], left, values[to])
        if gain > worth:
            best, worth = to, gain
    return best, worth


@kernel
def toll_home(view: Outlook, i: int, left: float) -> float:
    """What it costs to set out for home from i with `left` seconds left: the risk to be late."""
    if left < 0.0:
        return view.price
    return view.price * _between(view.late[i], left / view.step, 1.0)


@kernel
def gain_of(view: Outlook, i: int, j: int, left: float, after: NDArray[np.float64]) -> float:
    """What it is worth to sail from i to j with `left` seconds left."""
    deviation, gain = math.sqrt(view.variance[i, j]), view.profit[j]
    for k in range(len(_POINTS)):
        then = left - max(view.legs[i, j] + deviation * _POINTS[k], 0.0)
        gain += _WEIGHTS[k] * _between(after, then / view.step, view.price)
    return float(gain)


@kernel
def expected_route(
    view: Outlook,
    stops: Stops,
    length: int,
    left: float,
    values: NDArray[np.float64],
) -> Ints:
    """The nodes that the AUV will visit if every leg takes what is expected of it."""
    look_ahead(view, stops, length, values)
    route, count, at = np.empty(length, np.int64), 0, 0
    while True:
        to, _ = next_stop(view, stops, length, at, left, values)
        if to == length - 1:
            return route[:count].copy()
        left -= view.legs[stops[at], stops[to]]
        route[count] = stops[to]
        count, at = count + 1, to
