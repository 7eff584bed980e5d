"""Short routes through given nodes by insertion and local search.

Quick, and different for every order of the nodes: a source of various giant routes beside
the best one. A giant route that is one or two per cent longer is often the better start
for the route tier, since it falls into other sub-routes.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fiveroute.heuristics.route_kernels import cheapest_place, shorten
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route
from fiveroute.stops import insert_stop

__all__ = ["insertion_route", "various_routes"]

_LONGEST_SHORTENED = 1000
"""Nodes on a route beyond which a kernel would shorten it for seconds."""


def insertion_route(problem: TeamOrienteering, nodes: Sequence[int]) -> Route:
    """Insert node after node at its cheapest place, then apply 2-opt and or-opt.

    Routes of more than 1,000 nodes are left as inserted.

    Parameters
    ----------
    problem
        The problem; its budgets play no part.
    nodes
        The nodes, in the order in which they are inserted.
    """
    vertices = np.array([0, *nodes, problem.destination])
    legs = problem.travel[np.ix_(vertices, vertices)] + problem.service[vertices]
    stops = np.full(len(vertices), len(nodes) + 1)
    stops[0] = 0
    for node in range(1, len(nodes) + 1):
        insert_stop(stops, node + 1, cheapest_place(legs, stops, node + 1, node)[1], node)
    if len(nodes) <= _LONGEST_SHORTENED:
        shorten(legs, stops, len(stops))
    return tuple(vertices[stops[1:-1]].tolist())


def various_routes(
    problem: TeamOrienteering, count: int, rng: np.random.Generator
) -> tuple[Route, ...]:
    """Different routes through all nodes: the `count` shortest of twice as many, best first."""
    orders = ((rng.permutation(problem.n) + 1).tolist() for _ in range(2 * count))
    routes = (insertion_route(problem, order) for order in orders)
    by_duration = {problem.duration(route): route for route in routes}
    return tuple(by_duration[duration] for duration in sorted(by_duration)[:count])
