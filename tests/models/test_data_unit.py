"""Methods count data in a unit that fits them, and nobody else notices."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.limits import Progress, ProgressCallback
from fiveroute.models.data_unit import in_fitting_unit
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result, Status
from fiveroute.routes import Plan

ROOMY = 9.0


def stars(profit: list[float], budget: float = 2.0) -> TeamOrienteering:
    """Three nodes a second from everywhere, the third of them out of reach."""
    travel = np.ones((5, 5))
    travel[3] = travel[:, 3] = ROOMY
    return TeamOrienteering(travel, [0] * 5, [0.0, *profit, 0.0], [budget])


class Method:
    """Takes node 2, claims twice what it holds, and remembers what it was asked."""

    def __init__(self, answer: Status = Status.FEASIBLE) -> None:
        self.answer = answer
        self.asked: TeamOrienteering | None = None

    def __call__(self, problem: TeamOrienteering, progress: ProgressCallback | None) -> Result:
        self.asked = problem
        data = float(problem.profit[2])
        if progress is not None:
            progress(Progress(1.0, None, 2.0 * data, "so far"))
        if self.answer is Status.INFEASIBLE:
            return Result.infeasible(method="two", seconds=1.0)
        plan = Plan.of([[2]]) if self.answer is Status.FEASIBLE else None
        return Result.judged(problem, plan, method="two", seconds=1.0, bound=2.0 * data, seed=7)


def asked(problem: TeamOrienteering) -> TeamOrienteering:
    method = Method()
    in_fitting_unit(method, problem, None)
    assert method.asked is not None
    return method.asked


@pytest.mark.parametrize("profit", [[1.0, 0.0, 2.0], [0.3, 0.6, 0.1], [1e-9, 4.0, 0.0]])
def test_what_counts_enough_is_left_alone(profit: list[float]) -> None:
    problem = stars(profit)
    assert asked(problem) is problem


@pytest.mark.parametrize("data", [0.3, 1e-4, 3e-9, 1e-200, 5e-324])
def test_the_largest_data_within_reach_count_about_one(data: float) -> None:
    profit = asked(stars([data / 3.0, data, 1e6])).profit
    assert profit[3] == 0.0
    unit = data / profit[2]
    assert np.frexp(unit)[0] == 0.5  # a power of two
    assert profit[1] * unit == data / 3.0
    if data > 1e-300:
        assert 1.0 <= profit[2] < 2.0


def test_the_answer_is_in_the_unit_of_the_problem() -> None:
    problem = stars([1e-7, 3e-7, 5.0])
    told: list[Progress] = []
    result = in_fitting_unit(Method(), problem, told.append)
    assert told == [Progress(1.0, None, 6e-7, "so far")]
    assert (result.plan, result.objective, result.bound) == (Plan.of([[2]]), 3e-7, 6e-7)
    assert (result.status, result.method, result.seed) == (Status.FEASIBLE, "two", 7)


def test_an_answer_without_a_plan_stays_one() -> None:
    problem = stars([1e-7, 3e-7, 0.0])
    open_ended = in_fitting_unit(Method(Status.NO_SOLUTION), problem, None)
    assert (open_ended.status, open_ended.bound) == (Status.NO_SOLUTION, 6e-7)
    assert in_fitting_unit(Method(Status.INFEASIBLE), problem, None).status is Status.INFEASIBLE
