"""The bound holds for what is known to be possible: exact policies, plans, and planners."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.instance import Uncertainty
from fiveroute.routes import Plan
from fiveroute.sea.bounds.online_bound import Pilot, node_prices, online_bound
from fiveroute.sea.bounds.online_value import Chart, chart
from fiveroute.sea.luck import Luck
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World

STEPS, PRICE = 16, 2.0


def optimum(sea: Chart, profit: list[float], fleet: int, steps: int) -> float:
    """Data less fines of the best policy of a whole fleet, the AUV with most time moving first."""

    @cache
    def best(auvs: tuple[tuple[int, int], ...], seen: frozenset[int]) -> float:
        if not auvs:
            return 0.0
        *rest, (k, i) = auvs
        most = best(tuple(rest), seen) - PRICE * float(sea.late[i, k])
        for j in set(range(1, len(profit) - 1)) - seen:
            worth, then = profit[j], k - int(sea.first[i, j])
            law = sea.share[sea.begin[i, j] :][: sea.width[i, j]].tolist()
            for x, share in enumerate(law):
                if x > then:
                    worth += share * (best(tuple(rest), seen | {j}) - PRICE)
                else:
                    worth += share * best(tuple(sorted([*rest, (then - x, j)])), seen | {j})
            most = max(most, worth)
        return most

    return best(((steps, 0),) * fleet, frozenset())


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("fleet", [1, 2])
def test_no_policy_beats_it(seed: int, fleet: int) -> None:
    world = World.of(generate(nodes=4, seed=seed), fleet)
    problem = world.problem.with_budgets(np.full(fleet, 9000.0))
    world = replace(world, problem=problem)
    sea = chart(world, STEPS, 3)
    known = optimum(sea, problem.profit.tolist(), fleet, STEPS)
    pilot = Pilot(world, sea, PRICE, node_prices(world, PRICE))
    runs = [pilot.most(Luck(world.law, seed, run)) for run in range(40)]
    error = float(np.std(runs)) / len(runs) ** 0.5
    assert max(runs) <= pilot.expected + 1e-9
    assert pilot.expected >= known - 1e-9
    assert known - 3.0 * error - 1e-9 <= np.mean(runs) <= 1.05 * known


def test_without_luck_it_bounds_plans_and_is_near_them() -> None:
    calm = Uncertainty(drift=0.0, manoeuvres_per_km=0.0)
    world = World.of(generate(nodes=12, seed=3), 2, uncertainty=calm)
    problem = world.problem.with_budgets([8000.0, 8000.0])
    plan = fleet_search(problem, rng=np.random.default_rng(1), iterations=4000)
    bound = online_bound(replace(world, problem=problem), price=2.0, runs=1, steps=900)
    assert plan.objective(problem) < problem.total_profit
    best = world.completion(plan.objective(problem))
    assert best - 1e-9 <= bound.runs[0] <= min(bound.expected + 1e-9, best + 0.08)


def test_a_planner_pays_no_tax_on_average_and_never_beats_the_bound(
    world: World, plan: Plan
) -> None:
    fine, runs = 8.0, 40
    pilot = Pilot(world, chart(world, 900, 2), fine, node_prices(world, fine))
    taxes = []
    for run in simulate_fleet(world, plan, runs=runs, reserve=0.8).runs:
        luck = Luck(world.law, 0, run.run)
        routes = [tuple(to for _, to, _ in legs[:-1]) for legs in run.legs]
        taxed = sum(pilot.taxed(pilot.legs(luck), route) for route in routes)
        data = sum(world.problem.collected(route) for route in routes)
        taxes.append(data - fine * run.late_returns - taxed)
        if run.run < 4:
            assert taxed <= pilot.most(luck) + 1e-9
    error = float(np.std(taxes)) / runs**0.5
    assert error > 0.05
    assert -3.0 * error - 0.2 <= np.mean(taxes) <= 3.0 * error


def test_more_luck_is_the_same_luck(world: World) -> None:
    both = online_bound(world, runs=2, seed=4, steps=600, memory=1)
    second = online_bound(world, runs=1, first_run=1, seed=4, steps=600, memory=1)
    assert both.runs[1:] == second.runs


def test_what_it_cannot_bound(world: World) -> None:
    with pytest.raises(InputError, match="less than a step"):
        online_bound(world, steps=20)
    unequal = replace(world, problem=world.problem.with_budgets([9000.0, 8000.0]))
    with pytest.raises(InputError, match="must be equal"):
        online_bound(unequal)
