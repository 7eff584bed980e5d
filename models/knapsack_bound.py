"""A knapsack of nodes whose weights are the least shares of time that a visit takes.

Split the time of every leg in halves between its two ends. A visited node j then takes at least

    h_j = (min_i t_ij + min_k t_jk) / 2 + s_j

over the legs that some feasible route contains, and every route takes half of the shortest
leg out of the start and half of the shortest into the destination besides. What all
AUVs together can collect is at most the fractional knapsack of these weights in the sum of their
budgets (Dantzig 1957, doi 10.1287/opre.5.2.266).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.models.network import Network

__all__ = ["knapsack_bound"]

_SAFE = 1e-9  # share of the data that rounding errors stay far below
_BLOCK = 256  # tails whose legs are in memory at once


def knapsack_bound(network: Network) -> float:
    """Data that the whole fleet can collect at most, in O(n^2)."""
    out, into = _shortest_legs(network)
    n, nodes = network.n, network.reachable
    capacity = float(network.budgets @ network.routes)
    ends = network.routes * into[n + 1 :]
    capacity -= float(ends[network.routes > 0].sum() + network.problem.fleet_size * out[0]) / 2.0
    if not np.isfinite(capacity):
        return 0.0  # some AUV has no route at all
    share = (into[nodes] + out[nodes]) / 2.0 + network.service[nodes]
    return fractional_knapsack(network.profit[nodes], share, capacity)


def fractional_knapsack(
    profit: NDArray[np.float64], weight: NDArray[np.float64], capacity: float
) -> float:
    """Greatest profit of parts of items within a capacity, rounded up."""
    with np.errstate(over="ignore"):  # what weighs next to nothing comes first
        order = np.argsort(-profit / np.maximum(weight, 1e-300), kind="stable")
    weight = weight[order]
    room = np.maximum(capacity * (1.0 + _SAFE) - (np.cumsum(weight) - weight), 0.0)
    parts = np.ones(len(weight))
    np.divide(np.minimum(room, weight), weight, out=parts, where=weight > 0.0)
    return float(profit[order] @ parts) * (1.0 + _SAFE)


def _shortest_legs(network: Network) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Shortest usable leg out of the start and every node, and into every vertex."""
    out = np.empty(network.n + 1)
    into = np.full(network.size, np.inf)
    heads = np.arange(network.size)
    for first in range(0, network.n + 1, _BLOCK):
        tails = np.arange(first, min(first + _BLOCK, network.n + 1))
        legs = np.where(network.usable(tails), network.legs(tails[:, None], heads[None, :]), np.inf)
        out[tails] = legs.min(axis=1)
        np.minimum(into, legs.min(axis=0), out=into)
    return out, into
