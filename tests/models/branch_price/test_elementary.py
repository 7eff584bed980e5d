"""Enumeration finds every route that it must, and each node set once."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.branch_price.column_generation import Relaxation
from fiveroute.models.branch_price.duals import Duals
from fiveroute.models.branch_price.elementary import enumerate_routes
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering

NODES = 6


def roads(seed: int) -> Roads:
    rng = np.random.default_rng(seed)
    travel = rng.integers(0, 8, (NODES + 2, NODES + 2)).astype(np.float64)
    profit = np.pad(rng.uniform(0.1, 1.0, NODES), 1)
    budgets = rng.integers(6, 16, 2).astype(np.float64)
    return Roads.of(Network.of(TeamOrienteering(travel, 0.0 * profit, profit, budgets)))


def relaxation(roads: Roads, seed: int) -> Relaxation:
    rng = np.random.default_rng(seed)
    duals = Duals(np.pad(rng.uniform(0.0, 0.8, NODES), 1), np.zeros(len(roads.limits)))
    best = np.full(len(roads.limits), 2.0)
    return Relaxation(duals.bound(roads.routes, best), duals, best)


def shortest_by_set(roads: Roads) -> dict[frozenset[int], float]:
    shortest: dict[frozenset[int], float] = {}
    for count in range(NODES + 1):
        for route in permutations(range(1, NODES + 1), count):
            nodes, time = frozenset(route), roads.duration(route)
            shortest[nodes] = min(time, shortest.get(nodes, np.inf))
    return shortest


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("gap", [1.0, 2.0, 9.0])
def test_all_sets_worth_enough_are_there_once(seed: int, gap: float) -> None:
    if (ways := roads(seed)).leg[0, -1] > ways.limits[0] or np.isinf(ways.leg).all():
        pytest.skip("nobody gets across")
    bound = relaxation(ways, seed)
    pool = enumerate_routes(ways, bound, bound.value - gap, Limits().start(), 10_000)
    assert pool is not None
    found = {frozenset(pool.route(k)): k for k in range(len(pool))}
    assert len(found) == len(pool)
    for nodes, k in found.items():
        assert set(np.flatnonzero(pool.visits.toarray()[:, k])) == nodes
        assert pool.classes[k] == ways.class_of(ways.duration(pool.route(k)))
        assert pool.profit[k] == pytest.approx(ways.profit[list(nodes)].sum())
    for nodes, time in shortest_by_set(ways).items():
        auv_class = ways.class_of(time)
        worth = (ways.profit - bound.duals.node)[list(nodes)].sum()
        if auv_class < len(ways.limits) and worth > bound.best[auv_class] - gap:
            assert ways.duration(pool.route(found[nodes])) == pytest.approx(time)


def test_too_many_are_refused() -> None:
    ways = roads(0)
    bound = relaxation(ways, 0)
    assert enumerate_routes(ways, bound, bound.value - 9.0, Limits().start(), 3) is None
    assert enumerate_routes(ways, bound, bound.value - 9.0, Limits(time=0.0).start(), 999) is None
