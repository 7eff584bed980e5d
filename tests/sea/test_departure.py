"""Plans to set out with: legal for the inflated legs, and for the fleet that is asked for."""

import numpy as np
import pytest

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.sea.departure import departure_plan


@pytest.mark.parametrize("planner", ["five-tier", "ftcmp", "rmmp"])
@pytest.mark.parametrize("slack", [1.0, 1.2])
def test_plans_keep_to_the_inflated_times(planner: str, slack: float) -> None:
    instance = generate(nodes=15, seed=5)
    plan = departure_plan(instance, planner, fleet_size=2, slack=slack, seed=3)
    problem = instance.problem(2, slack * instance.travel)
    assert check(problem, plan) == []
    assert plan == departure_plan(instance, planner, fleet_size=2, slack=slack, seed=3)
    assert plan.objective(problem) > 0.5 * problem.total_profit


def test_the_fleet_is_estimated_without_slack() -> None:
    instance = generate(nodes=15, seed=5)
    assert len(departure_plan(instance, "rmmp", slack=3.0).routes) == 2


def test_legs_of_the_ocean_are_used() -> None:
    instance = generate(nodes=6, seed=5)
    far = np.full((8, 8), 8000.0)
    assert len(departure_plan(instance, "ftcmp", fleet_size=1, travel=far).visited) <= 2


@pytest.mark.parametrize("slack", [0.9, np.inf])
def test_what_makes_no_sense_is_refused(slack: float) -> None:
    with pytest.raises(InputError, match="slack"):
        departure_plan(generate(nodes=3, seed=1), slack=slack)
