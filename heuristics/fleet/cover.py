"""Recombination: the routes out of a pool that collect most together.

Routes that were good at different times and on different islands are combined anew,

    max  sum of rho_j over the nodes j on some chosen route  -  price * sum of durations,

one route for every AUV that keeps its limit. Routes may share nodes: all but one of them
leaves such a node out afterwards and has time for others, so that few routes suffice for
many combinations (the master problem of column generation, as a cover; solved over a pool
of routes by B. A. Foster and D. M. Ryan, Operational Research Quarterly 27, 1976,
doi 10.1057/jors.1976.63). AUV after AUV takes the route that is worth most beside the
others' until none changes; then some AUVs are given random routes and it begins again.
"""

from __future__ import annotations

import numpy as np

from fiveroute.heuristics.fleet.network import Floats, Ints
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below

__all__ = ["improve_cover"]


@kernel
def improve_cover(
    first: Ints,
    nodes: Ints,
    time: Floats,
    profit: Floats,
    limit: Floats,
    price: float,
    chosen: Ints,
    attempts: int,
    state: RandomState,
) -> None:
    """Make `chosen`, the route of every AUV, worth more, in place.

    Route r of the pool takes time[r] and visits nodes[first[r]] to nodes[first[r + 1] - 1].
    """
    count = np.zeros(len(profit), np.int64)
    for auv in range(len(chosen)):
        _add(first, nodes, count, chosen[auv], 1)
    current = chosen.copy()
    best = _descend(first, nodes, time, profit, limit, price, count, current)
    chosen[:] = current
    for _ in range(attempts):
        for _ in range(1 + below(state, 2)):
            auv, route = below(state, len(chosen)), below(state, len(time))
            if time[route] <= limit[auv]:
                _exchange(first, nodes, count, current, auv, route)
        value = _descend(first, nodes, time, profit, limit, price, count, current)
        if value >= best:
            best = value
            chosen[:] = current
        else:
            for auv in range(len(chosen)):
                _exchange(first, nodes, count, current, auv, chosen[auv])


@kernel
def _descend(
    first: Ints,
    nodes: Ints,
    time: Floats,
    profit: Floats,
    limit: Floats,
    price: float,
    count: Ints,
    chosen: Ints,
) -> float:
    """Let AUV after AUV take its best route until none changes; returns the worth of all."""
    rounding = 1e-9 * profit.sum()
    unchanged, auv = 0, 0
    while unchanged < len(chosen):
        before = chosen[auv]
        _add(first, nodes, count, before, -1)
        best, most = before, _worth(first, nodes, time, profit, price, count, before)
        for route in range(len(time)):
            if time[route] <= limit[auv]:
                worth = _worth(first, nodes, time, profit, price, count, route)
                if worth > most + rounding:
                    best, most = route, worth
        _add(first, nodes, count, best, 1)
        chosen[auv] = best
        unchanged = unchanged + 1 if best == before else 1
        auv = (auv + 1) % len(chosen)
    total = 0.0
    for node in range(len(profit)):
        if count[node] > 0:
            total += profit[node]
    for route in chosen:
        total -= price * time[route]
    return total


@kernel
def _worth(
    first: Ints, nodes: Ints, time: Floats, profit: Floats, price: float, count: Ints, route: int
) -> float:
    """What a route adds to the nodes that are visited already."""
    worth: float = -price * time[route]
    for node in nodes[first[route] : first[route + 1]]:
        if count[node] == 0:
            worth += profit[node]
    return worth


@kernel
def _exchange(first: Ints, nodes: Ints, count: Ints, chosen: Ints, auv: int, route: int) -> None:
    _add(first, nodes, count, chosen[auv], -1)
    _add(first, nodes, count, route, 1)
    chosen[auv] = route


@kernel
def _add(first: Ints, nodes: Ints, count: Ints, route: int, times: int) -> None:
    for node in nodes[first[route] : first[route + 1]]:
        count[node] += times
