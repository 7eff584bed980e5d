"""An upper bound from any multipliers of the symmetric relaxation, by weak duality.

The rows and their multipliers are those of `fiveroute.models.symmetric_relaxation`. With

    g_e = u_i + u_j - lambda c_e + sum of omega_S over the sets that e = {i, j} leaves,

the data of any plan are for *every* choice of multipliers at most

    lambda sum_m T_m - M (u_0 + u_d + sum over S with the destination of omega_S)
    + sum_j max(0, rho_j - 2 u_j - 2 sum over S with k_S = j of omega_S)
    + sum over e in E' of max(0, g_e) (M times for the direct leg)
    + sum_j max(0, max of g_e over e at j outside E')

where E' is any set of edges: at most two edges meet at a node, and every edge has two ends. M edges
meet at the start and M at the destination, whose terms of the last sum count M / 2 each.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from fiveroute.models.network import Network

__all__ = ["SymmetricMultipliers", "symmetric_bound"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_SAFE = 1e-9  # share of the terms of a sum that its rounding errors stay far below


@dataclass(frozen=True, slots=True, eq=False)
class SymmetricMultipliers:
    """Multipliers in data and data a second, the signs right. Build them with `of`.

    Parameters
    ----------
    node
        u_0 to u_(n + 1), shape (n + 2,).
    price
        lambda.
    served
        k_S, shape (c,); n + 1 where the set holds the destination.
    weight
        omega_S, shape (c,).
    sides
        The smaller side of every cut, as S or its complement, shape (c, n + 2).
    """

    node: Floats
    price: float
    served: Integers
    weight: Floats
    sides: csr_array

    @classmethod
    def of(
        cls, node: Floats, price: float, sets: Booleans, served: Integers, weight: Floats
    ) -> SymmetricMultipliers:
        """Drop what has the wrong sign or no weight."""
        used = weight > 0.0
        sides = sets[used]
        large = 2 * sides.sum(axis=1) > sides.shape[1]
        sides[large] = ~sides[large]
        return cls(
            node, max(price, 0.0), served[used], weight[used], csr_array(sides.astype(np.float64))
        )

    @property
    def level(self) -> Floats:
        """u_j plus the weights of the sides that hold j, shape (n + 2,)."""
        level: Floats = self.node + self.weight @ self.sides
        return level

    def gains(self, vertices: Integers, times: Floats) -> Floats:
        """G of all edges of some vertices, shape (b, n + 2), from their times."""
        both = self.sides[:, vertices].T.multiply(self.weight).tocsr() @ self.sides
        level = self.level
        gain: Floats = level[vertices, None] + level - 2.0 * both.toarray()
        usable = np.isfinite(times)
        gain -= self.price * np.where(usable, times, 0.0)
        gain[~usable] = -np.inf
        return gain

    def gains_of(self, edges: Integers, times: Floats) -> Floats:
        """G of edges, shape (2, m), from their times."""
        columns, level = self.sides.tocsc(), self.level
        both = self.weight @ columns[:, edges[0]].multiply(columns[:, edges[1]])
        gain: Floats = level[edges[0]] + level[edges[1]] - self.price * times - 2.0 * both
        return gain


def symmetric_bound(
    network: Network, multipliers: SymmetricMultipliers, inside: Floats, others: Floats
) -> float:
    """Add up the terms of the bound.

    Parameters
    ----------
    inside
        g_e for the edges in E', that of the direct leg M times, shape (m,).
    others
        Greatest g_e at every vertex over all other edges, shape (n + 2,).
    """
    n, fleet = network.n, float(network.problem.fleet_size)
    node, served, weight = multipliers.node, multipliers.served, multipliers.weight
    tied = np.zeros(n + 2)
    np.add.at(tied, served, weight)
    ends = np.full(n + 2, 1.0)
    ends[[0, -1]] = fleet / 2.0
    terms = np.concatenate(
        [
            [multipliers.price * float(network.budgets @ network.routes)],
            -fleet * np.array([node[0], node[-1], tied[-1]]),
            np.maximum(network.problem.profit - 2.0 * (node + tied), 0.0)[1:-1],
            np.maximum(inside, 0.0),
            ends * np.maximum(others, 0.0),
        ]
    )
    return float(terms.sum()) + _SAFE * float(np.abs(terms).sum())
