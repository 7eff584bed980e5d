"""Trimming of routes that are too long, and pick-up of idle nodes into the fleet's routes.

Both go by the effectiveness-cost ratio of a node. A route that breaks the limit (6) drops
the node of least phi = rho / saved time (25), until it fits. As long as some idle node
fits somewhere, the (node, AUV, position) of greatest psi = rho / added time (26), (27) in
the whole fleet is carried out. Ratios are recomputed after every change.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock, Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

__all__ = ["RouteDuration", "insertions", "pick_up", "trim"]

RouteDuration = Callable[[Sequence[int]], float]
"""Duration of a route in seconds that must keep within the budget."""


def trim(
    problem: TeamOrienteering, auv: int, route: Sequence[int], duration: RouteDuration | None = None
) -> Route:
    """Drop nodes of least phi until the route keeps within the budget of its AUV.

    A node that saves no time is never dropped, so that a route may stay too long where
    times violate the triangle inequality.

    Parameters
    ----------
    problem
        The problem.
    auv
        The AUV, counted from 0.
    route
        Its route.
    duration
        How to measure a route; None takes the planned duration.
    """
    duration = duration or problem.duration
    travel, service = problem.travel, problem.service
    kept = list(route)
    while kept and duration(kept) > problem.allowed[auv]:
        stops = np.array([0, *kept, problem.destination])
        before, node, after = stops[:-2], stops[1:-1], stops[2:]
        saved = travel[before, node] + travel[node, after] - travel[before, after] + service[node]
        phi = np.divide(
            problem.profit[node], saved, out=np.full(len(node), np.inf), where=saved > 0.0
        )
        worst = int(np.lexsort((-saved, phi))[0])
        if saved[worst] <= 0.0:
            break
        del kept[worst]
    return tuple(kept)


def pick_up(
    problem: TeamOrienteering,
    routes: Sequence[Route],
    duration: RouteDuration | None = None,
    clock: Clock | None = None,
) -> tuple[Route, ...]:
    """Insert idle nodes, the greatest psi of the whole fleet first, until none fits.

    Parameters
    ----------
    problem
        The problem.
    routes
        A route in time for every AUV.
    duration
        How to measure a route, besides the planned duration, which must fit in any case.
    clock
        Ends the pick-up early; no limit without one.
    """
    planned = problem.duration
    duration = duration or planned
    clock = clock or Limits().start()
    fleet = list(routes)
    visited = {node for route in fleet for node in route}
    idle = np.array([v for v in range(1, problem.n + 1) if v not in visited], dtype=np.int64)
    offers = [_offers(problem, auv, route, idle) for auv, route in enumerate(fleet)]
    psi = np.array([ratios for ratios, _ in offers])
    place = np.array([places for _, places in offers])
    while psi.size and psi.max() > 0.0 and not clock.expired:
        auv, chosen = divmod(int(psi.argmax()), len(idle))
        at = place[auv, chosen]
        longer = (*fleet[auv][:at], int(idle[chosen]), *fleet[auv][at:])
        if max(planned(longer), duration(longer)) > problem.allowed[auv]:
            psi[auv, chosen] = 0.0
            continue
        fleet[auv] = longer
        left = np.arange(len(idle)) != chosen
        idle, psi, place = idle[left], psi[:, left], place[:, left]
        psi[auv], place[auv] = _offers(problem, auv, longer, idle)
    return tuple(fleet)


def insertions(
    problem: TeamOrienteering, route: Route, idle: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """The cheapest insertion of every idle node into one route, in time or not.

    Returns
    -------
    psi
        Data per added second (27), shape (len(idle),); infinite for a node that adds no
        time and brings data, or saves time.
    extra
        Added time in seconds.
    place
        Position in the route at which to insert.
    """
    travel = problem.travel
    extra, place = np.full(len(idle), np.inf), np.zeros(len(idle), np.int64)
    for at, (before, after) in enumerate(pairwise((0, *route, problem.destination))):
        detour = travel[before, idle] + travel[idle, after] - travel[before, after]
        place[detour < extra] = at
        np.minimum(extra, detour, out=extra)
    extra += problem.service[idle]
    gain = problem.profit[idle]
    psi = np.where((gain > 0.0) | (extra < 0.0), np.inf, 0.0)
    np.divide(gain, extra, out=psi, where=extra > 0.0)
    return psi, extra, place


def _offers(
    problem: TeamOrienteering, auv: int, route: Route, idle: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Psi of every idle node in one route, 0 where it does not fit, and its position."""
    psi, extra, place = insertions(problem, route, idle)
    psi[problem.duration(route) + extra > problem.allowed[auv]] = 0.0
    return psi, place
