import pytest

from fiveroute.problem import TeamOrienteering
from fiveroute.result import GiantRouteResult, Result, Status, is_closed, optimality_gap
from fiveroute.routes import Plan

TWO = TeamOrienteering(
    travel=[[0, 1, 1, 1], [1, 0, 1, 1], [1, 1, 0, 1], [1, 1, 1, 0]],
    service=[0] * 4,
    profit=[0, 3, 5, 0],
    budgets=[2],
)


def judged(plan: Plan | None, bound: float | None) -> Result:
    return Result.judged(TWO, plan, method="test", seconds=0.0, bound=bound)


def test_meeting_bound_is_a_proof() -> None:
    result = judged(Plan.of([[2]]), 5.0)
    assert result.status is Status.OPTIMAL
    assert (result.objective, result.bound, result.gap) == (5.0, 5.0, 0.0)


def test_open_gap_is_feasible() -> None:
    result = judged(Plan.of([[1]]), 5.0)
    assert result.status is Status.FEASIBLE
    assert result.gap == pytest.approx(2 / 3)


def test_no_bound_no_gap() -> None:
    result = judged(Plan.of([[1]]), None)
    assert (result.status, result.gap) == (Status.FEASIBLE, None)


def test_no_plan_keeps_the_bound() -> None:
    result = judged(None, 7.0)
    assert (result.status, result.objective, result.bound) == (Status.NO_SOLUTION, None, 7.0)


def test_infeasible_collects_nothing_and_that_is_proved() -> None:
    result = Result.infeasible(method="test", seconds=0.0)
    assert (result.objective, result.bound, result.gap) == (0.0, 0.0, 0.0)


def test_an_infeasible_plan_is_a_bug_not_an_answer() -> None:
    with pytest.raises(AssertionError, match="over_budget"):
        judged(Plan.of([[1, 2]]), None)


def test_a_bound_below_the_objective_is_a_bug_not_an_answer() -> None:
    with pytest.raises(AssertionError, match="below objective"):
        judged(Plan.of([[2]]), 4.9)


def test_rounding_below_the_objective_is_lifted() -> None:
    assert judged(Plan.of([[2]]), 5.0 - 1e-9).bound == 5.0


def test_gap_of_nothing_collected_is_huge_not_undefined() -> None:
    assert optimality_gap(0.0, 1.0) == pytest.approx(1e12)
    assert optimality_gap(0.0, 0.0) == 0.0


@pytest.mark.parametrize("unit", [1e-12, 1e-3, 1.0, 1e6])
def test_closed_is_relative_whatever_the_unit(unit: float) -> None:
    assert is_closed(unit, unit * (1.0 + 0.9e-6))
    assert not is_closed(unit, unit * (1.0 + 2e-6))


def test_nothing_is_closed_by_nothing_only() -> None:
    assert is_closed(0.0, 0.0)
    assert not is_closed(0.0, 1e-12)


@pytest.mark.parametrize(
    ("status", "bound", "gap"),
    [(Status.OPTIMAL, 9.0, 0.0), (Status.FEASIBLE, 9.0, 0.1), (Status.FEASIBLE, None, None)],
)
def test_gap_of_a_giant_route(status: Status, bound: float | None, gap: float | None) -> None:
    result = GiantRouteResult("test", status, (1, 2), 10.0, bound, 0.0)
    assert result.gap == (None if gap is None else pytest.approx(gap))
