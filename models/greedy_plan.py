"""A first plan for exact methods: greedy insertion, led by weights of the nodes.

Nodes enter the routes one by one, always the one that earns the most weight a second at its
cheapest place, until none fits. With the visits of a linear relaxation in the weights, the plan
follows the relaxation's choice of nodes. It is a start for a proof, not a good plan.

The cheapest place of every node in every route is kept. An insertion takes one leg out of a
route and puts two into it, so that only the nodes whose cheapest place was that leg look at
the whole route again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock
from fiveroute.models.incumbent import Incumbent
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["greedy_plan", "offer_greedy_plan"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_INSTANT = 1e-9  # seconds that an insertion counts at least


def greedy_plan(
    problem: TeamOrienteering, weight: Floats, clock: Clock | None = None
) -> Plan | None:
    """Fill routes in parallel; None if an empty route does not fit every budget.

    Parameters
    ----------
    problem
        The problem.
    weight
        Worth of every vertex, shape (n + 2,); nodes without worth stay out.
    clock
        When to stop; what is in the routes by then is the plan.
    """
    direct = float(problem.travel[0, -1])
    if (direct > problem.allowed).any():
        return None
    waiting = np.flatnonzero(weight > 0.0)
    stops = [[0, problem.destination] for _ in problem.allowed]
    slack = problem.allowed - direct
    least, place = _cheapest(problem, stops[0], waiting)
    detour, before = (np.tile(row, (len(stops), 1)) for row in (least, place))
    while len(waiting) and not (clock is not None and clock.expired):
        rate = weight[waiting] / np.maximum(detour, _INSTANT)
        rate[detour > slack[:, None]] = -np.inf
        auv, k = np.unravel_index(int(rate.argmax()), rate.shape)
        if rate[auv, k] == -np.inf:
            break
        node, tail, route = int(waiting[k]), int(before[auv, k]), stops[auv]
        slack[auv] -= detour[auv, k]
        route.insert(route.index(tail) + 1, node)
        waiting = np.delete(waiting, k)
        detour, before = np.delete(detour, k, axis=1), np.delete(before, k, axis=1)
        lost = before[auv] == tail
        detour[auv, lost], before[auv, lost] = _cheapest(problem, route, waiting[lost])
        first = route.index(tail)
        least, place = _cheapest(problem, route[first : first + 3], waiting)
        detour[auv], before[auv] = (
            np.where(least < detour[auv], least, detour[auv]),
            np.where(least < detour[auv], place, before[auv]),
        )
    return Plan.of(route[1:-1] for route in stops)


def offer_greedy_plan(incumbent: Incumbent, weight: Floats) -> None:
    """Fill routes by weights of the vertices, shape (n + 2,), for a method's running answer."""
    plan = greedy_plan(incumbent.problem, weight, incumbent.clock)
    if plan is not None:
        incumbent.offer(plan)


def _cheapest(
    problem: TeamOrienteering, stops: list[int], nodes: Integers
) -> tuple[Floats, Integers]:
    """Least detours of nodes, service included, and the stops behind which they have them."""
    tails, heads = np.array(stops[:-1]), np.array(stops[1:])
    detours = problem.travel[np.ix_(tails, nodes)] + problem.travel[np.ix_(nodes, heads)].T
    detours -= problem.travel[tails, heads][:, None]
    gap = detours.argmin(axis=0)
    return detours[gap, np.arange(len(nodes))] + problem.service[nodes], tails[gap]
