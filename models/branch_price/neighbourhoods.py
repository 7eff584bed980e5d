"""Neighbourhoods of the ng-route relaxation, and how they grow.

N_i starts as the nodes next to i. Where the linear programme uses a route that comes back to a node
v, v joins the neighbourhoods of all nodes in between, which forbids that cycle for ever
(R. Roberti and A. Mingozzi 2014, doi 10.1287/trsc.2013.0474, in the dynamic form of Baldacci et
al. 2011). Nodes joined by legs of next to no time always remember each other: a route could go
round in circles there without end.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from fiveroute.models.branch_price.roads import Roads
from fiveroute.routes import Route

__all__ = ["MOST_NEIGHBOURS", "grow", "is_forgetful", "nearest"]

Booleans = NDArray[np.bool_]

MOST_NEIGHBOURS = 62
"""Nodes that fit into one machine word."""

_INSTANT = 1e-3  # share of the horizon below which a leg takes next to no time


def nearest(roads: Roads, count: int) -> Booleans:
    """Every node with its `count` - 1 nearest in either direction, shape (n + 2, n + 2)."""
    size = len(roads.leg)
    near = np.eye(size, dtype=np.bool_)
    there = np.minimum(roads.leg, roads.leg.T)
    there[[0, -1]] = there[:, [0, -1]] = np.inf
    order = np.argsort(there, axis=1, kind="stable")[:, : count - 1]
    rows = np.arange(size)[:, None]
    near[rows, order] = np.isfinite(there[rows, order]) | (order == rows)
    instant = there <= _INSTANT * roads.limits[-1]
    cluster = np.arange(size)
    while (least := np.where(instant, cluster, size).min(axis=1)).min() < size and (
        least < cluster
    ).any():
        cluster = np.minimum(cluster, least)
    together = cluster[:, None] == cluster
    fits = together.sum(axis=1) <= MOST_NEIGHBOURS // 2
    result: Booleans = near | (together & fits[:, None])
    return result


def grow(near: Booleans, routes: Iterable[Route], most: int = MOST_NEIGHBOURS) -> bool:
    """Forbid the cycles of some routes, in place; return whether that was possible."""
    grown = False
    for route in routes:
        last: dict[int, int] = {}
        for place, node in enumerate(route):
            if node in last:
                between = np.array(route[last[node] + 1 : place], dtype=np.int64)
                room = near[between].sum(axis=1) < most
                if (room | near[between, node]).all():
                    near[between, node] = grown = True
            last[node] = place
    return grown


def is_forgetful(near: Booleans, route: Route) -> bool:
    """Whether a route comes back to each of its nodes only after it has forgotten it."""
    memory: set[int] = set()
    for node in route:
        if node in memory:
            return False
        memory = {known for known in memory if near[node, known]} | {node}
    return True
