"""The search for courses with options: legal, repeatable, and as good as trying all of them."""

from itertools import permutations

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.limits import Limits
from fiveroute.routes import Plan
from fiveroute.sea.courses.option_search import best_options
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import with_recourse
from fiveroute.sea.world import World


def view_of(world: World) -> Outlook:
    return with_recourse(Outlook.of(world.problem, world.law, 1.645))


def search(world: World, plan: Plan, trials: int) -> tuple[Plan, float]:
    rng = np.random.default_rng(1)
    budgets = world.problem.budgets
    routes, worth = best_options(view_of(world), plan.routes, budgets, trials, rng)
    return Plan(routes), worth


def test_no_node_is_lost_or_there_twice(world: World, plan: Plan) -> None:
    better, worth = search(world, plan, 1000)
    nodes = [node for route in better.routes for node in route]
    assert len(set(nodes)) == len(nodes)
    assert set(nodes) <= set(range(1, world.problem.destination))
    assert (better, worth) == search(world, plan, 1000)
    same, again = search(world, better, 0)
    assert same == better
    assert again == pytest.approx(worth)
    assert worth > search(world, plan, 0)[1]


def test_it_finds_the_best_order_of_few_nodes() -> None:
    world = World.of(generate(nodes=5, seed=4), 1)
    short = World(
        world.problem.with_budgets(np.array([9000.0])),
        world.law,
        world.points,
        world.lengths_km,
    )
    orders = [search(short, Plan((order,)), 0)[1] for order in permutations(range(1, 6))]
    assert search(short, Plan.empty(1), 3000)[1] == pytest.approx(max(orders))


@pytest.mark.parametrize("nodes", [0, 1])
def test_few_nodes_are_no_difficulty(nodes: int) -> None:
    world = World.of(generate(nodes=nodes, seed=4), 2)
    plan, worth = search(world, Plan.empty(2), 100)
    assert worth == pytest.approx(plan.objective(world.problem), abs=0.05)


def test_it_ends_when_asked(world: World, plan: Plan) -> None:
    clock = Limits(time=0.0).start()
    view, rng = view_of(world), np.random.default_rng(1)
    budgets = world.problem.budgets
    _, worth = best_options(view, plan.routes, budgets, 10**9, rng, clock)
    assert worth >= search(world, plan, 0)[1]
