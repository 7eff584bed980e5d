"""Complete enumeration against brute force and closed forms."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from fiveroute.limits import Limits
from fiveroute.models import circuit, enumeration
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status


@pytest.mark.parametrize("seed", range(150))
def test_agrees_with_brute_force(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    result = enumeration.solve(truth.problem)
    if truth.optimum is None:
        assert result.status is Status.INFEASIBLE
    else:
        assert result.status is Status.OPTIMAL
        assert result.objective == pytest.approx(truth.optimum, rel=1e-6, abs=1e-6)


def plane(n: int, seed: int, budgets: list[float]) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0.0, 10.0, (n + 2, 2))
    profit = np.pad(1.0 - rng.random(n), 1)
    return TeamOrienteering(cdist(xy, xy), 0.2 * (profit > 0.0), profit, budgets)


@pytest.mark.parametrize("budgets", [[12.0, 12.0], [9.0, 13.0]])
def test_agrees_with_circuits(budgets: list[float]) -> None:
    problem = plane(11, 3, budgets)
    result, other = enumeration.solve(problem), circuit.solve(problem)
    assert result.status is other.status is Status.OPTIMAL
    assert result.objective == pytest.approx(other.objective, abs=1e-6)


def test_more_nodes_than_a_word_has_bits() -> None:
    """A node in each of 70 directions, one second away: each AUV gets one."""
    n = 70
    travel = np.full((n + 2, n + 2), 2.0)
    travel[0] = travel[:, 0] = travel[-1] = travel[:, -1] = 1.0
    profit = np.pad(np.arange(1.0, n + 1.0), 1)
    result = enumeration.solve(TeamOrienteering(travel, 0.0 * profit, profit, [2.0] * 3))
    assert result.status is Status.OPTIMAL
    assert result.objective == 70.0 + 69.0 + 68.0
    assert result.plan is not None
    assert sorted(result.plan.routes) == [(68,), (69,), (70,)]


def test_longer_routes_over_more_nodes_than_a_word_has_bits() -> None:
    """On a line of 70 nodes, each AUV sails along once and takes all it has time for."""
    x = np.concatenate([[0.0], np.arange(1.0, 71.0), [71.0]])
    service = np.pad(np.full(70, 5.0), 1)
    profit = np.pad(np.ones(70), 1)
    travel = np.where(x[:, None] < x, x - x[:, None], 1e3)
    result = enumeration.solve(TeamOrienteering(travel, service, profit, [82.0]))
    assert result.status is Status.OPTIMAL
    assert result.objective == 2.0


def test_too_many_routes_leave_a_quick_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(enumeration, "MOST_PARTIAL", 50)
    problem = plane(11, 3, [12.0, 12.0])
    result = enumeration.solve(problem)
    assert result.status is Status.FEASIBLE
    assert result.bound is not None
    assert result.bound <= problem.total_profit * (1.0 + 1e-8)
    assert result.objective is not None
    assert result.objective > 0.0


def test_a_bound_holds_whenever_it_is_stopped() -> None:
    problem = plane(12, 4, [14.0, 14.0])
    best = enumeration.solve(problem).objective
    assert best is not None
    for time in (0.0, 0.01, 0.05, 0.1, 0.2):
        result = enumeration.solve(problem, Limits(time=time))
        assert result.bound is not None
        assert result.bound >= best - 1e-6
