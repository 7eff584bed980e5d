"""Greedy insertion: what it takes, and that the judge accepts it."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.check import check
from fiveroute.models.greedy_plan import greedy_plan
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def test_the_greatest_weight_a_second_goes_first() -> None:
    """Node 1 lies on the way, node 2 is worth a detour, and node 3 no longer fits."""
    xy = np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (5.0, -9.0), (10.0, 0.0)])
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    problem = TeamOrienteering(travel, np.zeros(5), [0, 1, 2, 3, 0], [17.0])
    plan = greedy_plan(problem, problem.profit)
    assert plan is not None
    assert plan.visited == {1, 2}


def test_worthless_nodes_stay_out() -> None:
    problem = TeamOrienteering(np.ones((4, 4)), np.zeros(4), [0, 1, 1, 0], [9.0])
    assert greedy_plan(problem, np.array([0.0, 0.0, 1.0, 0.0])) == Plan.of([[2]])


def test_none_where_the_direct_leg_is_too_long() -> None:
    problem = TeamOrienteering([[0, 5], [5, 0]], [0, 0], [0, 0], [6.0, 4.0])
    assert greedy_plan(problem, problem.profit) is None


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 8), st.integers(0, 2**32 - 1))
def test_every_plan_is_feasible(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    travel = rng.uniform(0.0, 10.0, (n + 2, n + 2)) * (rng.random((n + 2, n + 2)) < 0.8)
    profit = np.pad(rng.random(n), 1)
    problem = TeamOrienteering(travel, 2.0 * profit, profit, rng.uniform(1.0, 40.0, 3))
    plan = greedy_plan(problem, profit)
    assert (plan is None) == (travel[0, -1] > problem.allowed.min())
    if plan is not None:
        assert check(problem, plan) == []
