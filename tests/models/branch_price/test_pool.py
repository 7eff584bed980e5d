"""The best plan over a pool."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.branch_price.pool import Pool, plan_of, sail_best
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering


def problem(budgets: list[float]) -> TeamOrienteering:
    """Four nodes worth 1, 2, 3 and 4, everything one second apart."""
    return TeamOrienteering(np.ones((6, 6)) - np.eye(6), np.zeros(6), [0, 1, 2, 3, 4, 0], budgets)


def test_the_best_plan_is_found_and_bounded() -> None:
    bounds: list[float] = []
    three = problem([3.0, 3.0, 2.0])
    roads, incumbent = Roads.of(Network.of(three)), Incumbent(three, "pool")
    pool = Pool.of(roads, [(), (1, 2), (2, 3), (3, 4), (1, 4), (2,)])
    assert sail_best(pool, roads, incumbent, incumbent.clock, on_bound=bounds.append)
    assert incumbent.objective == 10.0
    assert min(bounds) == pytest.approx(10.0)


def test_only_the_first_budgets_take_long_routes() -> None:
    two = problem([2.0, 3.0])
    roads, incumbent = Roads.of(Network.of(two)), Incumbent(two, "pool")
    pool = Pool.of(roads, [(1, 4), (2, 3)])
    assert sail_best(pool, roads, incumbent, incumbent.clock)
    assert incumbent.plan is not None
    assert incumbent.plan.routes[0] == ()
    assert incumbent.objective == 5.0


def test_a_fleet_that_needs_more_routes_than_there_are() -> None:
    travel = np.array([[0.0, 1.0, 9.0], [9.0, 0.0, 1.0], [9.0, 9.0, 0.0]])
    two = TeamOrienteering(travel, np.zeros(3), [0, 1, 0], [2.0, 2.0])
    roads, incumbent = Roads.of(Network.of(two)), Incumbent(two, "pool")
    bounds: list[float] = []
    pool = Pool.of(roads, [(1,)])
    assert sail_best(pool, roads, incumbent, incumbent.clock, on_bound=bounds.append)
    assert bounds == [-np.inf]
    assert incumbent.plan is None


def test_long_routes_go_to_large_budgets() -> None:
    roads = Roads.of(Network.of(problem([2.0, 4.0, 3.0])))
    plan = plan_of(roads, [(1,), (2, 3), ()])
    assert plan is not None
    assert plan.routes == ((), (2, 3), (1,))
    assert plan_of(roads, [(1,)] * 4) is None


def test_a_plan_within_the_gap_is_no_proof() -> None:
    rng, nodes = np.random.default_rng(0), 60
    travel = np.ones((nodes + 2, nodes + 2)) - np.eye(nodes + 2)
    data = [0.0, *rng.uniform(1.0, 2.0, nodes), 0.0]
    large = TeamOrienteering(travel, np.zeros(nodes + 2), data, [6.0] * 12)
    roads = Roads.of(Network.of(large))
    routes = [tuple((rng.permutation(nodes)[:5] + 1).tolist()) for _ in range(600)]
    incumbent = Incumbent(large, "pool", Limits(gap=0.3))
    bounds: list[float] = []
    pool = Pool.of(roads, routes)
    is_settled = sail_best(pool, roads, incumbent, incumbent.clock, on_bound=bounds.append)
    assert min(bounds) > incumbent.objective + 1e-3
    assert not is_settled
