"""Column generation against brute force and enumeration, by every way it can end."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from fiveroute.limits import Limits, Progress
from fiveroute.models import branch_price, enumeration
from fiveroute.models.branch_price import solver
from fiveroute.models.branch_price.subproblem import Subproblem
from fiveroute.problem import TeamOrienteering
from fiveroute.result import PROOF_TOLERANCE, Result, Status

Odd = Callable[[int], Any]


def field(n: int, seed: int, budgets: list[float], skew: float = 0.0) -> TeamOrienteering:
    """Nodes in a square of 10 by 10, the paper's ends and data; asymmetric if skewed."""
    rng = np.random.default_rng(seed)
    xy = np.vstack([[3.0, 5.0], rng.uniform(0.0, 10.0, (n, 2)), [7.0, 5.0]])
    travel = cdist(xy, xy) * rng.uniform(1.0 - skew, 1.0 + skew, (n + 2, n + 2))
    profit = np.pad(1.0 - rng.random(n), 1)
    return TeamOrienteering(travel, 0.1 * (profit > 0.0), profit, budgets)


def require_truth(truth: Any, result: Result) -> None:
    if truth.optimum is None:
        assert result.status is Status.INFEASIBLE
        return
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(truth.optimum, rel=1e-6, abs=1e-6)
    assert result.bound is not None
    assert result.bound >= truth.optimum - PROOF_TOLERANCE


@pytest.mark.parametrize("seed", range(150))
def test_agrees_with_brute_force(seed: int, odd: Odd) -> None:
    require_truth(odd(seed), branch_price.solve(odd(seed).problem))


@pytest.mark.parametrize("seed", range(150))
@pytest.mark.parametrize("with_cuts", [False, True])
def test_branching_alone_agrees_with_brute_force(
    seed: int, with_cuts: bool, odd: Odd, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No enumeration, no plan over known routes, next to no neighbourhoods."""
    for name, value in (("_FIRST_PARTIAL", 0), ("_MOST_PARTIAL", 0), ("_NEIGHBOURS", 2)):
        monkeypatch.setattr(solver, name, value)
    monkeypatch.setattr(solver, "_PLAN_TIME", 0.0)
    if not with_cuts:
        monkeypatch.setattr(Subproblem, "cut", lambda *_: False)
    require_truth(odd(seed), branch_price.solve(odd(seed).problem))


@pytest.mark.parametrize("seed", range(100))
@pytest.mark.parametrize("with_pool", [False, True])
def test_a_price_of_time_agrees_with_brute_force(
    seed: int, with_pool: bool, odd: Odd, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Time has its price from the start; no plan over known routes, all routes by inspection."""
    changes = [("_NEARLY", -1.0), ("_FEWER", 100.0), ("_PLAN_TIME", 0.0)]
    if with_pool:
        changes += [("_ROUTES_TO_SAIL", -1), ("_MOST_ROUTES_TO_SAIL", -1)]
    for name, value in changes:
        monkeypatch.setattr(solver, name, value)
    require_truth(odd(seed), branch_price.solve(odd(seed).problem))


def test_the_cheapest_plan_is_not_the_best_where_none_is_known(
    odd: Odd, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The direct leg is too long for some AUV, so that the search starts without a plan."""
    for name, value in (("_NEARLY", -1.0), ("_FEWER", 100.0), ("_PLAN_TIME", 0.0), ("_TOLL", 0.5)):
        monkeypatch.setattr(solver, name, value)
    require_truth(odd(1703), branch_price.solve(odd(1703).problem))


@pytest.mark.parametrize("seed", range(100))
def test_a_bound_holds_whenever_it_is_stopped(seed: int, odd: Odd) -> None:
    truth = odd(seed)
    limit = float(np.random.default_rng(seed).uniform(0.0, 0.02))
    result = branch_price.solve(truth.problem, Limits(time=limit))
    if truth.optimum is None:
        assert result.plan is None
    else:
        assert result.status is not Status.INFEASIBLE
        assert result.bound is not None
        assert result.bound >= truth.optimum - PROOF_TOLERANCE


@pytest.mark.parametrize("seed", range(6))
def test_agrees_with_enumeration(seed: int) -> None:
    budgets = [9.0, 9.0] if seed % 2 else [8.0, 10.0, 9.0]
    problem = field(12 + seed, seed, budgets, skew=0.2 * (seed % 3))
    result, other = branch_price.solve(problem), enumeration.solve(problem)
    assert result.status is other.status is Status.OPTIMAL
    assert result.objective == pytest.approx(other.objective, abs=1e-6)


@pytest.mark.parametrize("time", [0.05, 0.3, 1.0])
def test_bounds_of_a_larger_problem_hold_at_any_time(time: float) -> None:
    problem = field(30, 4, [11.0, 11.0])
    stopped = branch_price.solve(problem, Limits(time=time))
    done = branch_price.solve(problem)
    assert done.status is Status.OPTIMAL
    assert stopped.bound is not None
    assert stopped.bound >= (done.objective or 0.0) - PROOF_TOLERANCE
    assert (stopped.objective or 0.0) <= (done.bound or 0.0)


def test_a_warm_start_is_the_first_plan() -> None:
    problem = field(20, 5, [9.0, 9.0])
    best = branch_price.solve(problem)
    told: list[Progress] = []
    again = branch_price.solve(problem, warm_start=best.plan, progress=told.append)
    assert told[0].objective == 0.0
    assert told[1].objective == best.objective
    assert again.objective == best.objective
    assert again.status is Status.OPTIMAL


def test_progress_tells_the_columns() -> None:
    told: list[Progress] = []
    branch_price.solve(field(20, 5, [9.0, 9.0]), progress=told.append)
    assert any("columns" in progress.message for progress in told)


def test_an_interrupt_keeps_the_best_plan() -> None:
    """Interrupted at the first bound that columns give, long before the proof."""
    limits = Limits()

    def watch(progress: Progress) -> None:
        if "columns" in progress.message:
            limits.interrupt.set()

    result = branch_price.solve(field(60, 6, [20.0, 20.0]), limits, progress=watch)
    assert limits.interrupt.is_set()
    assert result.status is Status.FEASIBLE
    assert result.objective is not None
    assert result.objective > 0.0


def test_hundreds_of_nodes_get_a_bound() -> None:
    problem = field(600, 7, [9.0])
    result = branch_price.solve(problem, Limits(time=20.0))
    assert result.status is Status.FEASIBLE
    assert result.bound is not None
    assert result.bound < problem.total_profit


@pytest.mark.parametrize("seed", range(6))
def test_limited_work_ends_it_at_the_same_place_with_a_valid_bound(seed: int) -> None:
    problem = field(14, seed, [22.0, 22.0], skew=0.2)
    optimum = enumeration.solve(problem).objective
    assert optimum is not None
    for work in (1.0, 2_000.0, 20_000.0):
        one, other = (branch_price.solve(problem, Limits(work=work)) for _ in range(2))
        assert one.bound is not None
        assert one.objective is not None
        assert (one.objective, one.bound) == (other.objective, other.bound)
        assert one.objective <= optimum + PROOF_TOLERANCE
        assert one.bound >= optimum - PROOF_TOLERANCE
