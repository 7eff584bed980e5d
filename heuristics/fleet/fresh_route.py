"""A route of its own for nodes that no AUV visits.

Nodes far from all routes are no worth their detour one by one, and no small change sends
an AUV to all of them. So one AUV gets a new route that is made of idle nodes only: again
and again the node of most data per second, the seconds raised to a random power, joins
at its cheapest place.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fiveroute.heuristics.fleet.network import Floats, Ints, Network, Trail
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, uniform

__all__ = ["fill_empty_routes", "fresh_route"]


def fill_empty_routes(network: Network, trails: Sequence[Trail], state: RandomState) -> list[Trail]:
    """The routes, with a fresh one for every AUV that visits nothing."""
    size, fleet_size = len(network.nodes), len(network.limit)
    filled = list(trails)
    is_idle = np.ones(size, np.bool_)
    for trail in trails:
        is_idle[list(trail)] = False
    for auv in range(fleet_size):
        if not filled[auv]:
            start, limit = size + auv, float(network.limit[auv])
            idle = np.flatnonzero(is_idle)
            route = fresh_route(
                network.leg, network.profit, start, start + fleet_size, limit, idle, state
            )
            is_idle[route] = False
            filled[auv] = tuple(route.tolist())
    return filled


@kernel
def fresh_route(
    leg: Floats,
    profit: Floats,
    start: int,
    end: int,
    limit: float,
    idle: Ints,
    state: RandomState,
) -> Ints:
    """Nodes out of `idle` in the order of a new route that keeps the limit."""
    route = np.empty(len(idle) + 2, np.int64)
    route[0], route[1] = start, end
    cost, place = np.empty(len(idle)), np.zeros(len(idle), np.int64)
    slack = limit - leg[start, end]
    power = uniform(state)
    waiting = len(idle)
    length = 2
    items = idle.copy()
    for rank in range(waiting):
        cost[rank] = np.inf
        _look(leg, route, 0, items[rank], rank, cost, place)
    while True:
        chosen, most = -1, 0.0
        for rank in range(waiting):
            if cost[rank] <= slack:
                worth = profit[items[rank]] / max(cost[rank], 1e-9 * limit) ** power
                if worth > most:
                    chosen, most = rank, worth
        if chosen < 0:
            return route[1 : length - 1].copy()
        at, node = place[chosen], items[chosen]
        slack -= cost[chosen]
        route[at + 2 : length + 1] = route[at + 1 : length].copy()
        route[at + 1] = node
        length += 1
        waiting -= 1
        items[chosen], cost[chosen], place[chosen] = items[waiting], cost[waiting], place[waiting]
        for rank in range(waiting):
            if place[rank] == at:
                cost[rank] = np.inf
                for spot in range(length - 1):
                    _look(leg, route, spot, items[rank], rank, cost, place)
            else:
                if place[rank] > at:
                    place[rank] += 1
                _look(leg, route, at, items[rank], rank, cost, place)
                _look(leg, route, at + 1, items[rank], rank, cost, place)


@kernel
def _look(
    leg: Floats, route: Ints, spot: int, node: int, rank: int, cost: Floats, place: Ints
) -> None:
    """Note what the node costs behind the stop at `spot`, if that is least."""
    added = leg[route[spot], node] + leg[node, route[spot + 1]] - leg[route[spot], route[spot + 1]]
    if added < cost[rank]:
        cost[rank], place[rank] = added, spot
