"""The clairvoyant plan: legal for the legs that came, never worse than what was done."""

import numpy as np

from fiveroute.check import check
from fiveroute.generate import generate
from fiveroute.models import solve
from fiveroute.routes import Plan
from fiveroute.sea.bounds.clairvoyant import clairvoyant_plan
from fiveroute.sea.luck import Luck
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World


def test_it_is_optimal_on_a_small_mission() -> None:
    world = World.of(generate(nodes=7, seed=2, fleet_size=1))
    problem = world.problem.with_budgets([11_000.0])
    luck = Luck(world.law, 4, 0)
    real, plan = clairvoyant_plan(problem, luck, Plan(((1,),)), 2000)
    np.testing.assert_array_equal(real.travel, luck.matrix())
    assert check(real, plan) == []
    best = solve(real, "brute-force").objective
    assert best is not None
    assert abs(plan.objective(real) - best) < 1e-9


def test_no_run_collects_more_but_by_being_late(world: World, plan: Plan) -> None:
    result = simulate_fleet(world, plan, runs=2, gap=True, seed=6)
    for run in result.runs:
        assert run.clairvoyant is not None
        assert run.late_returns or run.clairvoyant >= run.completion - 1e-9
    assert result.online_gap is not None
    assert 0.0 <= result.online_gap < 0.5
    assert simulate_fleet(world, plan, runs=1).online_gap is None


def test_what_was_late_is_trimmed() -> None:
    world = World.of(generate(nodes=7, seed=2, fleet_size=2))
    problem = world.problem.with_budgets([9000.0, 5000.0])
    done = Plan(((1, 2, 3, 4, 5, 6, 7), (1, 2)))
    real, plan = clairvoyant_plan(problem, Luck(world.law, 4, 0), done, 500)
    assert check(real, plan) == []


def test_where_nobody_can_come_home_nothing_is_claimed() -> None:
    world = World.of(generate(nodes=3, seed=2, fleet_size=1))
    problem = world.problem.with_budgets([10.0])
    _, plan = clairvoyant_plan(problem, Luck(world.law, 4, 0), Plan(((),)), 500)
    assert plan == Plan(((),))
