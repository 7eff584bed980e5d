"""The fastest ways from start to destination: whether a fleet can make it at all.

Where times keep the triangle inequality, the direct leg is the fastest way, and an AUV
that has not even the time for it proves the problem infeasible. In general a detour over
sensor nodes may be faster, service included; then the fastest of all ways decides. Each
node serves one AUV only, so that routes for the whole fleet are searched one after
another, the AUV with least time first, which may fail where there are some.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

__all__ = ["is_proved_infeasible", "shortest_route", "shortest_routes"]


def shortest_route(problem: TeamOrienteering, barred: Collection[int] = ()) -> Route:
    """The route of least duration, by Dijkstra's algorithm.

    Parameters
    ----------
    problem
        The problem.
    barred
        Nodes that the route must not visit.
    """
    end = problem.destination
    time = np.full(end + 1, np.inf)
    came_from = np.zeros(end + 1, np.int64)
    closed = np.zeros(end + 1, np.bool_)
    closed[list(barred)] = True
    time[0] = 0.0
    vertex = 0
    while vertex != end:
        closed[vertex] = True
        arrival = time[vertex] + problem.travel[vertex] + problem.service
        sooner = (arrival < time) & ~closed
        time[sooner] = arrival[sooner]
        came_from[sooner] = vertex
        vertex = int(np.where(closed, np.inf, time).argmin())
    route: list[int] = []
    while came_from[vertex] != 0:
        vertex = int(came_from[vertex])
        route.append(vertex)
    return tuple(reversed(route))


def is_proved_infeasible(problem: TeamOrienteering) -> bool:
    """Whether some AUV has no time for the fastest of all ways to the destination."""
    least = float(problem.allowed.min())
    if problem.duration(()) <= least:
        return False
    return problem.duration(shortest_route(problem)) > least * (1.0 + 1e-12)


def shortest_routes(problem: TeamOrienteering) -> tuple[Route, ...] | None:
    """A route in time for every AUV with few or no nodes; None where none were found."""
    routes: list[Route] = [()] * problem.fleet_size
    taken: set[int] = set()
    for auv in np.argsort(problem.budgets, kind="stable").tolist():
        if problem.duration(()) <= problem.allowed[auv]:
            continue
        routes[auv] = shortest_route(problem, taken)
        if problem.duration(routes[auv]) > problem.allowed[auv]:
            return None
        taken.update(routes[auv])
    return tuple(routes)
