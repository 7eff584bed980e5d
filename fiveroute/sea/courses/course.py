"""What an AUV has before it, and whether it will be in time.

A course begins at an anchor, the vertex where the AUV may next change its mind: the node where
it is, or the one under way to which it is. From there it leads over the nodes of the remaining
route to the destination. The AUV knows the law of the legs (12), not its luck, so it expects
their means t_hat, and keeps a reserve for what may go wrong. Its time in hand is

    T_max - t - t_hat - z sqrt(sum over legs of var_ij + 1.5 max over legs of var_ij),

t being the time at the anchor. It is negative exactly if (24) holds with a reserve of z standard
deviations of the remaining time, the longest leg counted more; z = 0 is (24) as the paper has it.

What the reserve promises: as long as nodes can be left out to help it, an AUV sets out for the
next vertex only if what it then has before it, sailed as planned, ends in time with probability
Phi(z) at least, Phi being the standard normal distribution. Manoeuvres skew the sum of the legs,
but little: for two legs of ten minutes, by 8 seconds at z = 1.645. That is one bet, and an AUV bets
at every node anew. It drops nodes when its luck is bad, so that only its last bets can make it
late; but those are on one leg or two, which nothing can correct, and that is why the longest
counts more. At z = 1.645 one AUV in a hundred is late without that (completion 0.887), 0.3 %
with it (0.869), and 0.1 % if it is added twice (0.866).

An AUV that looks ahead does without this addition: a late return has a price there, see
`fiveroute.sea.courses.recourse`.

A rule that looks no further than the next node, and from there straight home, collects less: far
out, one long leg has a greater variance than the same way in several, whose luck evens out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from fiveroute.kernels import kernel
from fiveroute.routes import Route
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.stops import Stops

__all__ = ["Course", "in_hand", "time_in_hand"]


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

    @property
    def left(self) -> float:
        """Time in seconds that is left at the anchor."""
        return self.budget - self.time

    def stops(self, destination: int) -> Stops:
        """Anchor, route and destination, with room for one stop more."""
        return np.array((self.anchor, *self.route, destination, destination))

    def with_node(self, node: int, at: int) -> Course:
        """The course with a node inserted at a position of the route."""
        return replace(self, route=(*self.route[:at], node, *self.route[at:]))


def in_hand(view: Outlook, course: Course) -> float:
    """Time in seconds that the AUV has in hand; negative where it must shorten its route, (24)."""
    stops = course.stops(view.destination)
    return time_in_hand(view, stops, len(stops) - 1, course.left, course.spread)


@kernel
def time_in_hand(view: Outlook, stops: Stops, length: int, left: float, spread: float) -> float:
    """Time in hand with `left` seconds left at stops[0], on the way to stops[length - 1]."""
    needed, uncertain, widest = 0.0, spread, 0.0
    for at in range(1, length):
        needed += view.legs[stops[at - 1], stops[at]]
        variance = view.variance[stops[at - 1], stops[at]]
        uncertain += variance
        widest = max(widest, variance)
    uncertain += view.longest * widest
    return float(left - needed - view.reserve * math.sqrt(uncertain) + view.slack)
