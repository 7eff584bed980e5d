"""No coordination: an AUV that runs short of time discards nodes, and nobody picks them up.

The five-tiered planner without its fifth tier. The AUVs do not know of each other, so that each
sails its mission alone, which a kernel does in some microseconds.
"""

from __future__ import annotations

import math

import numpy as np

from fiveroute.kernels import kernel
from fiveroute.routes import Plan
from fiveroute.sea.courses.discarding import discard, shed
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.luck import leg_luck
from fiveroute.sea.run import Run, course_of
from fiveroute.stops import Stops, remove_stops
from fiveroute.tiers.actuation import LegLaw

__all__ = ["Alone", "sail_alone"]


class Alone:
    """Steers the fleet of one run, its log included.

    Parameters
    ----------
    run
        The run.
    view
        What the AUVs expect.
    plan
        What they set out with.
    """

    def __init__(self, run: Run, view: Outlook, plan: Plan) -> None:
        self._run, self._view = run, view
        self._routes = list(plan.routes)

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        vessel = self._run.vessels[auv]
        vessel.target = vessel.at
        course, dropped = discard(self._view, course_of(self._view, vessel, t, self._routes[auv]))
        for node in dropped:
            self._run.note(t, auv, "discard", node)
        self._routes[auv] = course.route[1:]
        return course.route[0] if course.route else self._run.problem.destination

    def come_home(self, auv: int, t: float) -> None:
        """Nothing is left to do."""


@kernel
def sail_alone(
    law: LegLaw, key: np.uint64, view: Outlook, stops: Stops, budget: float, fails: float
) -> tuple[float, float]:
    """Sail one AUV over stops, both ends included, which it uses up.

    Returns
    -------
    collected
        Data collected.
    arrival
        Time in seconds at which it reaches the destination; infinite if it fails before.
    """
    length, t, collected = len(stops), 0.0, 0.0
    while True:
        length = shed(view, stops, length, budget - t, 0.0)
        i, j = stops[0], stops[1]
        t += leg_luck(law, key, i, j)[0] + view.service[j]
        if t > fails:
            return collected, math.inf
        collected += view.profit[j]
        if length == 2:
            return collected, t
        length = remove_stops(stops, length, 0, 1)
