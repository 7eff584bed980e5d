"""What an AUV has before it, and whether it will be in time.

A course begins at an anchor, the vertex where the AUV may next change its mind: the node where
it is, or the one under way to which it is. From there it leads over the nodes of the remaining
route to the destination. The AUV knows the law of the legs (12), not its luck, so it expects
their means, and keeps a reserve for what may go wrong. Its time in hand is the least of

    T_max - t - t_hat - z sd(all that remains),
    T_max - t - t_hat - z' sd(last two legs),
    T_max - t - t_hat_1 - z' sd(next leg, leg home),

where t is the time at the anchor, t_hat the expected time of the whole remaining route, and
t_hat_1 that of its first node and the direct way home. The first line is (24) with a reserve of z
standard deviations. The other two look after what cannot be corrected: whoever has set out for a
node must sail that leg and then the way home. There the chance to be late is not shared out
over many decisions, and z' = HARD z. With z = 0 it is (24) as the paper has it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.plan import Route
from fiveroute.problem import TeamOrienteering
from fiveroute.tiers.actuation import LegLaw, expected_legs

__all__ = ["HARD", "Course", "Outlook", "Stops", "in_hand", "outlook", "time_in_hand"]

HARD = 1.3
"""How much greater the reserve is for the legs that cannot be corrected any more."""

Stops = NDArray[np.int64]


class Outlook(NamedTuple):
    """What every AUV expects of the sea, as kernels take it.

    Parameters
    ----------
    legs
        Expected leg times in seconds, service at the head included, shape (n + 2, n + 2).
    variance
        Variances of the leg times in s^2, same shape.
    service
        Service times t_j in seconds, shape (n + 2,).
    profit
        Data rho_j of every vertex, shape (n + 2,).
    reserve
        z, standard deviations of the remaining time kept in hand.
    hard
        z', standard deviations kept in hand for the legs that cannot be corrected.
    slack
        Seconds by which a budget may be overrun, for rounding.
    """

    legs: NDArray[np.float64]
    variance: NDArray[np.float64]
    service: NDArray[np.float64]
    profit: NDArray[np.float64]
    reserve: float
    hard: float
    slack: float


def outlook(problem: TeamOrienteering, law: LegLaw, reserve: float) -> Outlook:
    """What the AUVs expect where legs follow a law, and what they keep in hand."""
    mean, variance = expected_legs(law)
    slack = float((problem.allowed - problem.budgets).min())
    service, profit = problem.service.copy(), problem.profit.copy()
    return Outlook(mean + service, variance, service, profit, reserve, HARD * reserve, slack)


@dataclass(frozen=True, slots=True)
class Course:
    """What one AUV has before it.

    Parameters
    ----------
    anchor
        Vertex where the AUV may next change its mind.
    time
        Time in seconds at which it expects to leave the anchor, its service done.
    spread
        Variance of this time in s^2; 0 where the AUV is there.
    budget
        T_max of the AUV in seconds.
    route
        Sensor nodes still to visit after the anchor.
    """

    anchor: int
    time: float
    spread: float
    budget: float
    route: Route

    def stops(self, destination: int) -> Stops:
        """Anchor, route and destination, with room for one stop more."""
        return np.array((self.anchor, *self.route, destination, destination))

    def without(self, at: int) -> Course:
        """The course without the node at a position of the route."""
        return replace(self, route=(*self.route[:at], *self.route[at + 1 :]))

    def with_node(self, node: int, at: int) -> Course:
        """The course with a node inserted at a position of the route."""
        return replace(self, route=(*self.route[:at], node, *self.route[at:]))


def in_hand(view: Outlook, course: Course) -> float:
    """Time in seconds that the AUV has in hand; negative where it must shorten its route, (24)."""
    stops = course.stops(len(view.profit) - 1)
    return time_in_hand(view, stops, len(stops) - 1, course.budget - course.time, course.spread)


@kernel
def time_in_hand(view: Outlook, stops: Stops, length: int, left: float, spread: float) -> float:
    """Time in hand with `left` seconds left at stops[0], on the way to stops[length - 1]."""
    legs, variance = view.legs, view.variance
    needed, uncertain = 0.0, spread
    for at in range(1, length):
        needed += legs[stops[at - 1], stops[at]]
        uncertain += variance[stops[at - 1], stops[at]]
    end = stops[length - 1]
    last = variance[stops[length - 2], end]
    last += variance[stops[length - 3], stops[length - 2]] if length > 2 else spread
    reserve = max(view.reserve * math.sqrt(uncertain), view.hard * math.sqrt(last))
    hand = left - needed - reserve
    if length > 3:
        first = stops[1]
        out, home = legs[stops[0], first], legs[first, end]
        home = min(home, needed - out)
        risk = variance[stops[0], first] + variance[first, end]
        hand = min(hand, left - out - home - view.hard * math.sqrt(risk))
    return float(hand + view.slack)
