"""The running answer: only judged plans, only falling bounds."""

import pytest

from fiveroute.limits import Limits, Progress
from fiveroute.models.incumbent import Incumbent
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Plan

# Two nodes of data 1 and 3, one second between any two vertices, time for one of them.
PROBLEM = TeamOrienteering([[0, 1, 1, 1]] * 4, [0] * 4, [0, 1, 3, 0], [2.0])
OFF_GRID = TeamOrienteering(PROBLEM.travel, PROBLEM.service, [0, 1, 3.00007, 0], [2.0])


def test_it_begins_with_the_empty_plan_and_all_data() -> None:
    answer = Incumbent(PROBLEM, "test")
    assert (answer.plan, answer.objective, answer.bound) == (Plan(((),)), 0.0, 4.0)
    assert not answer.is_settled


def test_plans_pass_the_judge_and_only_better_ones_are_kept() -> None:
    answer = Incumbent(PROBLEM, "test", warm_start=Plan(((2,),)))
    assert answer.offer(Plan(((1,),)))
    assert not answer.offer(Plan(((1, 2),)))
    assert answer.plan == Plan(((2,),))


def test_bounds_only_fall_and_settle_the_matter() -> None:
    answer = Incumbent(OFF_GRID, "test", warm_start=Plan(((2,),)))
    for bound, expected in ((9.0, 4.00007), (3.5, 3.5), (3.7, 3.5), (3.00007, 3.00007)):
        answer.lower(bound)
        assert answer.bound == expected
    assert answer.is_settled
    assert answer.result().status is Status.OPTIMAL


def test_bounds_fall_to_what_a_plan_can_collect() -> None:
    answer = Incumbent(PROBLEM, "test", warm_start=Plan(((2,),)))
    answer.lower(3.9)
    assert answer.bound == 3.0


def test_the_gap_of_the_limits_settles_too() -> None:
    answer = Incumbent(PROBLEM, "test", Limits(gap=0.5), warm_start=Plan(((2,),)))
    assert answer.is_settled
    assert answer.must_stop
    assert answer.result().status is Status.FEASIBLE


def test_what_improves_is_told() -> None:
    told: list[Progress] = []
    answer = Incumbent(PROBLEM, "test", progress=told.append)
    answer.offer(Plan(((1,),)))
    answer.lower(3.0)
    answer.lower(3.5)
    assert [(p.objective, p.bound) for p in told] == [(0.0, 4.0), (1.0, 4.0), (1.0, 3.0)]


def test_infeasible_contradicts_a_plan() -> None:
    with pytest.raises(AssertionError, match="proves infeasible what"):
        Incumbent(PROBLEM, "test").infeasible()
    assert Incumbent(PROBLEM.with_budgets([0.5]), "test").infeasible().bound == 0.0
