"""Pricing by inspection: where all routes that matter are known, look at every one of them.

Once the routes of all better plans fit into memory (`fiveroute.models.branch_price.elementary`),
their worth under any multipliers is one product with the matrix of visits. Cuts may then
remember everything at no cost, and every bound strikes off the routes that it shows to be
useless (C. Contardo and R. Martinelli 2014, doi 10.1016/j.disopt.2014.03.001).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from fiveroute.limits import Clock
from fiveroute.models.branch_price.duals import Duals
from fiveroute.models.branch_price.pool import Pool
from fiveroute.models.branch_price.pricing import Priced
from fiveroute.models.branch_price.roads import Roads
from fiveroute.routes import Route

__all__ = ["Inspector"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_ROUTES = 60  # found in one pricing, besides the best of every node


class Inspector:
    """Finds valuable routes among those of a pool.

    Parameters
    ----------
    roads
        Legs and limits.
    pool
        All routes of better plans.
    """

    def __init__(self, roads: Roads, pool: Pool) -> None:
        self.roads = roads
        self._take(pool)

    def _take(self, pool: Pool) -> None:
        self.pool = pool
        self._worth = pool.profit - self.roads.toll * pool.time
        self._by_node = csr_array(pool.visits)
        self._paying: dict[tuple[int, ...], Ints] = {}

    def price(self, duals: Duals, clock: Clock, *, exact: bool = True) -> Priced:
        """The most valuable routes; always exact."""
        value = self._value(duals)
        missing = np.flatnonzero(value > duals.floor[self.pool.classes])
        return Priced(self._varied(missing, value), self._best(value), True)

    def walk_bound(self, duals: Duals) -> Floats:
        """Bounds on best_c."""
        return self._best(self._value(duals))

    def strike_off(self, duals: Duals, floors: Floats) -> None:
        """Drop the routes that are worth no more than their floor."""
        kept = np.flatnonzero(self._value(duals) > floors[self.pool.classes])
        if len(kept) < len(self.pool):
            self._take(self.pool.chosen(kept))

    def _value(self, duals: Duals) -> Floats:
        value: Floats = self._worth - self.pool.visits.T @ duals.node
        for cut, price in zip(duals.cuts, duals.price.tolist(), strict=True):
            if price > 0.0:
                value[self._payers(cut.nodes)] -= price
        return value

    def _payers(self, nodes: tuple[int, ...]) -> Ints:
        """Routes that visit two of three nodes."""
        if nodes not in self._paying:
            start, visitors = self._by_node.indptr, self._by_node.indices
            every = np.concatenate([visitors[start[i] : start[i + 1]] for i in nodes])
            every.sort()
            twice = every[1:][every[1:] == every[:-1]]
            self._paying[nodes] = np.unique(twice).astype(np.int64)
        return self._paying[nodes]

    def _best(self, value: Floats) -> Floats:
        best = np.full(len(self.roads.limits), -np.inf)
        np.maximum.at(best, self.pool.classes, value)
        return np.maximum.accumulate(best)

    def _varied(self, missing: Ints, value: Floats) -> list[Route]:
        """The best of some routes, among them the best over every node."""
        order = missing[np.argsort(-value[missing], kind="stable")]
        chosen = dict.fromkeys(order[:_ROUTES].tolist())
        rank = np.full(len(value), len(value))
        rank[order] = np.arange(len(order))
        for node in range(1, len(self.roads.leg) - 1):
            start, stop = self._by_node.indptr[node : node + 2]
            if start < stop:
                first = int(rank[self._by_node.indices[start:stop]].min())
                if first < len(order):
                    chosen[int(order[first])] = None
        return [self.pool.route(k) for k in chosen]
