"""The head start of exact methods."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.exact import solve_from_good_plan
from fiveroute.limits import Limits
from fiveroute.models import solve
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status


def in_square(n: int, seed: int, budget: float) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    points = rng.uniform(0.0, 10.0, (n + 2, 2))
    travel = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    return TeamOrienteering(travel, np.zeros(n + 2), np.pad(rng.random(n), 1), [budget] * 2)


@pytest.mark.parametrize("seed", range(4))
def test_the_proof_is_the_same(seed: int) -> None:
    problem = in_square(14, seed, 14.0)
    started = solve_from_good_plan(problem)
    assert started.status is Status.OPTIMAL
    assert started.objective == pytest.approx(solve(problem, "circuit").objective)


def test_an_expired_clock_gives_an_answer() -> None:
    result = solve_from_good_plan(in_square(40, 1, 20.0), limits=Limits(time=0.0))
    assert result.status in (Status.FEASIBLE, Status.OPTIMAL)


def test_where_no_plan_exists() -> None:
    """The direct leg takes longer than the budget."""
    problem = in_square(20, 1, 14.0).with_budgets([0.1, 0.1])
    assert solve_from_good_plan(problem).status is Status.INFEASIBLE


def test_no_search_for_a_few_nodes() -> None:
    assert solve_from_good_plan(in_square(6, 2, 12.0), "brute-force").status is Status.OPTIMAL
