"""The same nodes in less time: exact methods leave the order of the visits open.

The objective (2) counts data alone, so any order that fits the budget is optimal, even a
silly one. Of plans with equal data the one that takes less time is the better plan; every
route is therefore shortened over its own nodes before it is handed out.
"""

from __future__ import annotations

import numpy as np

from fiveroute.limits import Clock, Limits
from fiveroute.models.tour_descent import good_route
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan, Route

__all__ = ["shortened"]


def shortened(problem: TeamOrienteering, plan: Plan) -> Plan:
    """The plan with every route at most as long as before, and on the same nodes."""
    clock = Limits(time=1.0).start()
    return Plan(tuple(_shortened(problem, route, clock) for route in plan.routes))


def _shortened(problem: TeamOrienteering, route: Route, clock: Clock) -> Route:
    stops = np.array([0, *route, problem.destination])
    ends_only = np.zeros(len(stops))
    own = TeamOrienteering(problem.travel[np.ix_(stops, stops)], ends_only, ends_only, [0.0])
    order = good_route(own, clock, tuple(range(1, len(route) + 1)), kicks=200)
    better = tuple(route[place - 1] for place in order)
    return better if problem.duration(better) < problem.duration(route) else route
