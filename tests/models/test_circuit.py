"""The CP-SAT model: its roundings, its workers, and routes that only rounding lets through."""

import threading
from itertools import permutations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models import circuit
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Plan


def scattered(n: int, budgets: list[float], seed: int) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(0.0, 100.0, (2, n + 2))
    travel = np.hypot(x[:, None] - x, y[:, None] - y)
    return TeamOrienteering(travel, np.zeros(n + 2), np.pad(1.0 - rng.random(n), 1), budgets)


def durations(problem: TeamOrienteering) -> list[float]:
    """Of the routes through all nodes, in every order."""
    return [problem.duration(order) for order in permutations(range(1, problem.n + 1))]


@pytest.mark.parametrize("short", [2e-9, 3e-9, 1e-8])
def test_a_route_that_only_rounding_lets_through_is_forbidden(short: float) -> None:
    """The budget lacks a few billionths of what all four nodes take: three must do."""
    whole = scattered(4, [1.0], seed=2)
    result = circuit.solve(whole.with_budgets([min(durations(whole)) * (1.0 - short)]))
    assert result.status is Status.OPTIMAL
    assert result.plan is not None
    assert len(result.plan.visited) == 3


def test_the_exact_budget_is_enough() -> None:
    whole = scattered(4, [1.0], seed=2)
    result = circuit.solve(whole.with_budgets([min(durations(whole))]))
    assert result.plan is not None
    assert len(result.plan.visited) == 4


@pytest.mark.parametrize("budget", [1e-12, 1.0, 1e15, 1e300])
def test_no_size_of_numbers_overflows(budget: float) -> None:
    """Legs of a tenth of the budget each: nine stops of ten nodes fit."""
    travel = np.full((12, 12), budget / 10.0)
    problem = TeamOrienteering(travel, np.zeros(12), np.pad(np.full(10, budget), 1), [budget])
    result = circuit.solve(problem)
    assert result.status is Status.OPTIMAL
    if budget >= 1.0:
        assert result.objective == pytest.approx(9.0 * budget)


def test_more_workers_find_the_same_value() -> None:
    problem = scattered(7, [150.0, 150.0], seed=3)
    one, two = circuit.solve(problem), circuit.solve(problem, workers=2)
    assert one.objective == pytest.approx(two.objective)
    assert one.status is two.status is Status.OPTIMAL


def test_an_early_stop_claims_no_more_than_it_knows() -> None:
    """Stopped before presolve, CP-SAT itself would report the bound 0."""
    problem = scattered(6, [200.0, 200.0], seed=5)
    best = circuit.solve(problem).objective
    assert best is not None
    for seconds in (1e-6, 1e-4, 1e-3, 1e-2):
        bound = circuit.solve(problem, Limits(time=seconds)).bound
        assert bound is not None
        assert bound >= best - 1e-6


def test_an_interrupt_ends_a_long_search() -> None:
    """By the interrupt, not by the time limit, which only keeps a failure from hanging."""
    problem = scattered(60, [400.0, 400.0], seed=1)
    limits = Limits(time=60.0)
    threading.Timer(0.5, limits.interrupt.set).start()
    result = circuit.solve(problem, limits)
    assert result.status is Status.FEASIBLE
    assert result.bound is not None
    assert result.bound <= problem.total_profit
    assert result.seconds < limits.time


def test_a_warm_start_is_kept_whatever_the_order_of_equal_auvs() -> None:
    problem = scattered(5, [300.0, 300.0], seed=7)
    result = circuit.solve(problem, Limits(gap=1e9), warm_start=Plan(((5,), (1,))))
    assert result.plan == Plan(((5,), (1,)))
