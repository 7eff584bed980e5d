"""Plans to set out with: legal for the legs they were made for, and chosen by rehearsal."""

import numpy as np
import pytest

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.limits import Limits
from fiveroute.plan import Plan
from fiveroute.sea.departure import departure_plan, rehearse, slack_plan
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.theatre import Theatre


@pytest.fixture(scope="module")
def small() -> Theatre:
    return Theatre.of(generate(nodes=15, seed=5), 2)


@pytest.mark.parametrize("slack", [1.0, 1.2])
def test_slack_plans_keep_to_the_inflated_times(slack: float) -> None:
    instance = generate(nodes=15, seed=5)
    plan = slack_plan(instance, slack, seed=3)
    assert len(plan.routes) == 2
    assert check(instance.problem(2, slack * instance.travel), plan) == []


def test_slack_plans_sail_the_legs_of_the_ocean() -> None:
    far = np.full((8, 8), 8000.0)
    plan = slack_plan(generate(nodes=6, seed=5), fleet_size=1, travel=far)
    assert len(plan.visited) <= 1


@pytest.mark.parametrize("planner", ["five-tier", "ftcmp", "rmmp"])
def test_every_planner_has_a_plan_of_its_own(small: Theatre, planner: str) -> None:
    plan = departure_plan(small, planner, runs=2, seed=3)
    assert check(small.problem, plan) == []
    assert plan.objective(small.problem) > 0.4 * small.problem.total_profit
    assert plan == departure_plan(small, planner, runs=2, seed=3)


def test_rehearsals_find_the_better_plan(small: Theatre) -> None:
    good = departure_plan(small, "no-coordination", runs=2)
    assert rehearse(small, [Plan.empty(2), good], "no-coordination") == good
    assert rehearse(small, [good, Plan.empty(2)], "no-coordination") == good


def test_a_rehearsed_plan_collects_more_than_a_tight_one(theatre: Theatre, plan: Plan) -> None:
    chosen = departure_plan(theatre, seed=1)
    theta = [simulate_fleet(theatre, p, runs=60, log=False).completions for p in (plan, chosen)]
    assert theta[1].mean() > theta[0].mean()


def test_it_stops_when_asked(small: Theatre) -> None:
    plan = departure_plan(small, limits=Limits(time=0.0))
    assert check(small.problem, plan) == []


@pytest.mark.parametrize("slack", [0.9, np.inf])
def test_what_makes_no_sense_is_refused(slack: float) -> None:
    with pytest.raises(InputError, match="slack"):
        slack_plan(generate(nodes=3, seed=1), slack)
