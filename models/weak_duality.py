"""An upper bound from any multipliers of the flow relaxation, by weak duality.

Take a leg (i, j) of a route as an arc x_ij that arrives at time z_ij, in its window [a_ij, b_ij]
of `fiveroute.models.network`. Routes fulfil, among other rows,

    sum_i x_ij - sum_k x_jk = 0                                  (balance)  beta_j
    sum_i z_ij - sum_k (z_jk - t_jk - s_j) x_jk = 0              (clock)    tau_j
    sum_k x_0k = M                                               (fleet)    beta_0
    sum_ij (t_ij + s_j) x_ij <= sum_m T_m                        (price)    lambda >= 0
    sum of x_ij into S - sum_i x_ik >= 0 for k in S, start not in S  (sets)     omega_S >= 0

for all sensor nodes j. Priced into the objective with the multipliers on the right, they leave
for an arc that arrives at z the gain

    g_ij(z) = rho_j - beta_j + beta_i - lambda (t_ij + s_j) - tau_i (t_ij + s_i)
              + (tau_i - tau_j) z + sum_S omega_S ([i not in S, j in S] - [j = k_S]),

which is largest at one end of the window. At most one arc enters a sensor node, and M_c enter
the copy of the destination that belongs to class c. So for *every* choice of multipliers

    lambda sum_m T_m - beta_0 M + sum_j max(0, max_i g_ij) + sum_c M_c max_i g_ic

bounds the data that any plan collects. A linear programming solver proposes multipliers; whatever
its tolerances are, the bound is recomputed here from the data of the problem, over all arcs,
also those the solver never saw. To force or to forbid an arc changes one term: an arc, a
node or an idle node that lowers the bound below a known plan is in no better one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.models.network import Network

__all__ = ["Dual", "Multipliers", "gains", "if_idle", "if_used", "price"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_BLOCK = 256  # tails whose gains are in memory at once
_SAFE = 1e-9  # share of the terms of a sum that its rounding errors stay far below


@dataclass(frozen=True, slots=True, eq=False)
class Multipliers:
    """Multipliers of the rows above, in data, data a second and data.

    Parameters
    ----------
    balance
        beta_0 to beta_n, shape (n + 1,).
    clock
        tau_0 to tau_n, tau_0 = 0, shape (n + 1,).
    price
        lambda.
    sets
        Membership of every S, shape (c, n + 1).
    served
        k_S, shape (c,).
    weight
        omega_S, shape (c,).
    """

    balance: Floats
    clock: Floats
    price: float
    sets: Booleans
    served: Integers
    weight: Floats

    @classmethod
    def zero(cls, n: int) -> Multipliers:
        """Nothing is priced: the bound is the data of all nodes."""
        none = np.zeros(0)
        sets = np.zeros((0, n + 1), dtype=np.bool_)
        return cls(np.zeros(n + 1), np.zeros(n + 1), 0.0, sets, none.astype(np.int64), none)

    def admissible(self) -> Multipliers:
        """The nearest multipliers of the right sign, without the sets of no weight."""
        used = self.weight > 0.0
        return replace(
            self,
            price=max(self.price, 0.0),
            sets=self.sets[used],
            served=self.served[used],
            weight=self.weight[used],
        )


@dataclass(frozen=True, slots=True, eq=False)
class Dual:
    """A bound and its parts.

    Parameters
    ----------
    value
        The bound in data, rounded up; below zero only if no plan exists.
    best
        max_i g_ij for every vertex, shape (size,); minus infinity where no arc enters.
    """

    value: float
    best: Floats

    @classmethod
    def of(cls, network: Network, multipliers: Multipliers, best: Floats) -> Dual:
        """Add up the terms of the bound for admissible multipliers."""
        inner, ends = slice(1, network.n + 1), slice(network.n + 1, None)
        terms = np.concatenate(
            [
                [multipliers.price * float(network.budgets @ network.routes)],
                [-multipliers.balance[0] * network.problem.fleet_size],
                np.maximum(best[inner], 0.0),
                network.routes * best[ends],
            ]
        )
        return cls(float(terms.sum()) + _SAFE * float(np.abs(terms).sum()), best)


def price(network: Network, multipliers: Multipliers) -> Dual:
    """Compute the bound, in O(n^2) and one pass over the arcs for each set."""
    admissible = multipliers.admissible()
    best = np.full(network.size, -np.inf)
    for _, gain in gains(network, admissible):
        np.maximum(best, gain.max(axis=0), out=best)
    return Dual.of(network, admissible, best)


def if_used(network: Network, multipliers: Multipliers, dual: Dual) -> Floats:
    """Bounds on the data of plans that contain an arc, shape (n + 1, size)."""
    held = _held(network, dual)
    bounds = np.full((network.n + 1, network.size), -np.inf)
    for tails, gain in gains(network, multipliers):
        bounds[tails] = dual.value - held + gain
    return bounds


def if_idle(network: Network, dual: Dual) -> Floats:
    """Bounds on the data of plans that leave a node out, shape (size,)."""
    return dual.value - np.where(_is_node(network), _held(network, dual), 0.0)


def _held(network: Network, dual: Dual) -> Floats:
    """What the best arc into a vertex adds to the bound."""
    return np.where(_is_node(network), np.maximum(dual.best, 0.0), dual.best)


def _is_node(network: Network) -> Booleans:
    return np.arange(network.size) <= network.n


def gains(network: Network, multipliers: Multipliers) -> Iterator[tuple[Integers, Floats]]:
    """Gains g_ij at the better end of the window, a block of tails at a time.

    Yields
    ------
    tails : Integers
        Start and sensor nodes, shape (b,).
    gain : Floats
        Shape (b, size); minus infinity for legs on no feasible route.
    """
    size, n = network.size, network.n
    heads, padding = np.arange(size), np.zeros(network.classes)
    beta = np.concatenate([multipliers.balance, padding])
    tau = np.concatenate([multipliers.clock, padding])
    beta[0] = 0.0  # nothing enters the start
    weight, members = multipliers.weight, multipliers.sets.astype(np.float64)
    served = np.zeros(size)
    np.add.at(served, multipliers.served, weight)
    at_head = network.profit - beta - served - multipliers.price * network.service
    for first in range(0, n + 1, _BLOCK):
        tails = np.arange(first, min(first + _BLOCK, n + 1))
        legs = network.legs(tails[:, None], heads[None, :])
        early = network.earliest[tails, None] + legs
        late = np.where(tails[:, None] == 0, early, network.latest)
        slope = multipliers.clock[tails, None] - tau
        gain = at_head + multipliers.balance[tails, None]
        gain -= (multipliers.price + multipliers.clock[tails, None]) * legs
        gain -= (multipliers.clock * network.problem.service[:-1])[tails, None]
        gain += slope * np.where(slope > 0.0, late, early)
        if len(weight):
            outside = weight * (1.0 - members[:, tails].T)
            gain[:, : n + 1] += outside @ members
        gain[~network.usable(tails)] = -np.inf
        yield tails, gain
