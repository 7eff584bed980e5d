"""The flow model against brute force, closed forms and known optima."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.limits import Limits, Progress
from fiveroute.models import flow
from fiveroute.problem import TIME_TOLERANCE, TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Plan


@pytest.mark.parametrize("seed", range(150))
def test_agrees_with_brute_force(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    result = flow.solve(truth.problem)
    if truth.optimum is None:
        assert result.status is Status.INFEASIBLE
    else:
        assert result.status is Status.OPTIMAL
        assert result.objective == pytest.approx(truth.optimum, rel=1e-6, abs=1e-6)
        assert result.bound is not None
        assert result.bound >= truth.optimum


def test_supports_everything() -> None:
    assert flow.supports(TeamOrienteering([[0, 1], [1, 0]], [0, 0], [0, 0], [1.0, 2.0]))


def field(n: int, seed: int, fleet: int, budget: float) -> TeamOrienteering:
    """Nodes in a square of 10 by 10, the paper's ends and data."""
    rng = np.random.default_rng(seed)
    xy = np.vstack([[3.0, 5.0], rng.uniform(0.0, 10.0, (n, 2)), [7.0, 5.0]])
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    profit = np.pad(1.0 - rng.random(n), 1)
    return TeamOrienteering(travel, np.zeros(n + 2), profit, [budget] * fleet)


def test_proves_what_brute_force_cannot() -> None:
    problem = field(20, seed=1, fleet=3, budget=9.0)
    result = flow.solve(problem)
    assert result.status is Status.OPTIMAL
    better = flow.solve(problem.with_budgets([9.0, 9.0, 9.5]))
    assert better.status is Status.OPTIMAL
    assert (better.objective or 0.0) >= (result.objective or 0.0)


def test_a_route_within_the_judge_s_tolerance_is_found() -> None:
    """The budget is short by half of what the judge forgives."""
    x = np.arange(4.0)
    budget = 3.0 * (1.0 - 0.5 * TIME_TOLERANCE)
    problem = TeamOrienteering(abs(x[:, None] - x), np.zeros(4), [0, 1, 1, 0], [budget])
    assert flow.solve(problem).objective == 2.0


@pytest.mark.parametrize("share", [1e-7, 1e-8, 3e-9])
def test_a_route_just_beyond_the_tolerance_is_not(share: float) -> None:
    """Less than the solver would notice: the judge does, and the route is cut off."""
    rng = np.random.default_rng(7)
    xy = rng.uniform(0.0, 1.0, (7, 2))
    travel = 1e4 * np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    problem = TeamOrienteering(travel, np.zeros(7), [0, 1, 1, 1, 1, 1, 0], [1e9])
    order = flow.solve(problem).plan
    assert order is not None
    shortest = _shortest_through_all(problem)
    tight = problem.with_budgets([shortest * (1.0 - share)])
    result = flow.solve(tight)
    assert result.status is Status.OPTIMAL
    assert result.objective == 4.0
    assert flow.solve(problem.with_budgets([shortest])).objective == 5.0


def _shortest_through_all(problem: TeamOrienteering) -> float:
    from itertools import permutations

    return min(problem.duration(route) for route in permutations(range(1, problem.n + 1)))


def test_an_interrupt_keeps_the_best_plan_so_far() -> None:
    limits = Limits()
    told: list[Progress] = []

    def interrupt(progress: Progress) -> None:
        told.append(progress)
        if progress.objective and progress.bound is not None:
            threading.Thread(target=limits.interrupt.set).start()

    problem = field(40, seed=3, fleet=2, budget=14.0)
    result = flow.solve(problem, limits, progress=interrupt)
    assert result.status is Status.FEASIBLE
    assert result.bound is not None
    assert 0.0 < (result.objective or 0.0) < result.bound < problem.total_profit


def test_a_warm_start_leads_the_way() -> None:
    problem = field(12, seed=2, fleet=2, budget=9.0)
    best = flow.solve(problem)
    assert best.plan is not None
    again = flow.solve(problem, warm_start=best.plan)
    assert again.objective == best.objective
    nothing = flow.solve(problem, Limits(time=0.0), warm_start=best.plan)
    assert nothing.plan == best.plan
    assert nothing.status is Status.FEASIBLE


@pytest.mark.parametrize("seed", range(40))
def test_a_core_too_small_for_the_best_plan_claims_no_proof(
    seed: int, odd: Callable[[int], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    truth = odd(seed)
    monkeypatch.setattr(flow, "_CORE_ARCS", 1)
    monkeypatch.setattr(flow, "_MOST_ARCS", 4)
    result = flow.solve(truth.problem)
    if result.status is Status.INFEASIBLE:
        assert truth.optimum is None
    elif truth.optimum is not None:
        assert (result.objective or 0.0) <= truth.optimum + 1e-9
        assert result.bound is not None
        assert result.bound >= truth.optimum


def test_large_problems_get_a_plan_and_a_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(flow, "_LARGE", 10)
    monkeypatch.setattr(flow, "_TOO_LARGE", 20)
    result = flow.solve(field(25, seed=1, fleet=2, budget=9.0))
    assert result.status is Status.FEASIBLE
    best = flow.solve(field(15, seed=1, fleet=2, budget=9.0))
    assert best.status is Status.OPTIMAL


def test_one_auv_does_what_two_cannot() -> None:
    """Both AUVs need node 1 to get across in time."""
    times = [[0, 1, 10], [9, 0, 1], [9, 9, 0]]
    alone = TeamOrienteering(times, [0, 0, 0], [0, 1, 0], [2.0])
    assert flow.solve(alone).plan == Plan.of([[1]])
    assert flow.solve(alone.with_budgets([2.0, 2.0])).status is Status.INFEASIBLE
    assert flow.solve(alone.with_budgets([2.0, 10.0])).plan == Plan.of([[1], []])


@pytest.mark.parametrize(("name", "optimum"), [("p2.2.d", 160.0), ("p1.3.h", 70.0)])
def test_published_optima(name: str, optimum: float, public_file: Callable[[str], Path]) -> None:
    path = public_file(f"benchmarks/top-chao/{name}.txt")
    words = path.read_text(encoding="utf-8").split()
    rows = np.array(words[6:], dtype=np.float64).reshape(-1, 3)
    travel = np.hypot(*(rows[:, None, :2] - rows[:, :2]).transpose(2, 0, 1))
    profit = np.pad(rows[1:-1, 2], 1)
    budgets = [float(words[5])] * int(words[3])
    result = flow.solve(TeamOrienteering(travel, np.zeros(len(rows)), profit, budgets))
    assert (result.status, result.objective, result.bound) == (Status.OPTIMAL, optimum, optimum)
