"""A first plan for exact methods: greedy insertion, led by weights of the nodes.

Nodes enter the routes one by one, always the one that earns the most weight a second at its
cheapest place, until none fits. With the visits of a linear relaxation in the weights, the plan
follows the relaxation's choice of nodes. It is a start for a proof, not a good plan.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.plan import Plan
from fiveroute.problem import TeamOrienteering

__all__ = ["greedy_plan"]

_INSTANT = 1e-9  # seconds that an insertion counts at least


def greedy_plan(problem: TeamOrienteering, weight: NDArray[np.float64]) -> Plan | None:
    """Fill routes in parallel; None if an empty route does not fit every budget.

    Parameters
    ----------
    problem
        The problem.
    weight
        Worth of every vertex, shape (n + 2,); nodes without worth stay out.
    """
    travel, service, allowed = problem.travel, problem.service, problem.allowed
    if (travel[0, -1] > allowed).any():
        return None
    stops = [[0, problem.destination] for _ in allowed]
    slack = allowed - travel[0, -1]
    waiting = np.flatnonzero(weight > 0.0)
    while len(waiting):
        best: tuple[float, int, int, int, float] | None = None
        for auv, route in enumerate(stops):
            tails, heads = np.array(route[:-1]), np.array(route[1:])
            detour = travel[np.ix_(tails, waiting)] + travel[np.ix_(waiting, heads)].T
            detour += service[waiting] - travel[tails, heads][:, None]
            place = detour.argmin(axis=0)
            least = detour[place, np.arange(len(waiting))]
            rate = np.where(
                least <= slack[auv], weight[waiting] / np.maximum(least, _INSTANT), -np.inf
            )
            k = int(rate.argmax())
            if np.isfinite(rate[k]) and (best is None or rate[k] > best[0]):
                best = float(rate[k]), auv, k, int(place[k]), float(least[k])
        if best is None:
            break
        _, auv, k, place_of_best, detour_of_best = best
        stops[auv].insert(place_of_best + 1, int(waiting[k]))
        slack[auv] -= detour_of_best
        waiting = np.delete(waiting, k)
    return Plan.of(route[1:-1] for route in stops)
