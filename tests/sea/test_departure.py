"""Plans to set out with: legal, and chosen by rehearsal."""

import pytest

from fiveroute.check import check
from fiveroute.generate import generate
from fiveroute.limits import Limits
from fiveroute.routes import Plan
from fiveroute.sea.departure import departure_plan, rehearse
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World


@pytest.fixture(scope="module")
def small() -> World:
    return World.of(generate(nodes=15, seed=5), 2)


@pytest.mark.parametrize("planner", ["five-tier", "ftcmp", "rmmp"])
def test_every_planner_has_a_plan_of_its_own(small: World, planner: str) -> None:
    plan = departure_plan(small, planner, runs=2, seed=3)
    assert check(small.problem, plan) == []
    assert plan.objective(small.problem) > 0.4 * small.problem.total_profit
    assert plan == departure_plan(small, planner, runs=2, seed=3)


def test_rehearsals_find_the_better_plan(small: World) -> None:
    good = departure_plan(small, "no-coordination", runs=2)
    assert rehearse(small, [Plan.empty(2), good], "no-coordination") == good
    assert rehearse(small, [good, Plan.empty(2)], "no-coordination") == good


def test_a_rehearsed_plan_collects_more_than_a_tight_one(world: World, plan: Plan) -> None:
    chosen = departure_plan(world, seed=1)
    theta = [simulate_fleet(world, p, runs=60, log=False).completions for p in (plan, chosen)]
    assert theta[1].mean() > theta[0].mean()


def test_it_stops_when_asked(small: World) -> None:
    plan = departure_plan(small, limits=Limits(time=0.0))
    assert check(small.problem, plan) == []
