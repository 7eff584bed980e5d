"""No order of the nodes is worth more than the exact policy, and it gets what it promises."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.sea.bounds.online_bound import Pilot, node_prices
from fiveroute.sea.bounds.online_value import chart
from fiveroute.sea.bounds.optimal_policy import OptimalPolicy, Steersman
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import look_ahead, next_stop, with_recourse
from fiveroute.sea.luck import Luck
from fiveroute.sea.run import Run
from fiveroute.sea.world import World


def mission(nodes: int, budget: float, seed: int) -> World:
    world = World.of(generate(nodes=nodes, seed=seed), 1)
    return replace(world, problem=world.problem.with_budgets([budget]))


def worth_of(view: Outlook, order: tuple[int, ...], budget: float) -> float:
    stops = np.array([0, *order, len(view.profit) - 1])
    values = np.empty((len(stops), view.late.shape[1]))
    look_ahead(view, stops, len(stops), values)
    return next_stop(view, stops, len(stops), 0, budget, values)[1]


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("budget", [7000.0, 9000.0, 12000.0])
def test_no_order_is_worth_more(seed: int, budget: float) -> None:
    view = with_recourse(mission(4, budget, seed).outlook(1.645))
    worths = [worth_of(view, order, budget) for order in permutations(range(1, 5))]
    assert OptimalPolicy(view).worth(budget) >= max(worths) - 1e-9


def test_with_one_node_there_is_one_order() -> None:
    view = with_recourse(mission(1, 9000.0, 4).outlook(1.0))
    for budget in (6000.0, 7500.0, 9000.0):
        assert OptimalPolicy(view).worth(budget) == pytest.approx(worth_of(view, (1,), budget))


@pytest.mark.parametrize("seed", [1, 5])
def test_it_gets_what_it_promises(seed: int) -> None:
    world = mission(6, 9000.0, seed)
    view = with_recourse(world.outlook(0.5))
    policy, problem, got = OptimalPolicy(view), world.problem, []
    for number in range(600):
        run = Run(problem, Luck(world.law, seed, number), (np.inf,))
        run.sail(Steersman(policy, run))
        nodes = [event.node for event in run.log if event.kind == "collect"]
        late = run.log[-1].t > problem.budgets[0]
        got.append(sum(problem.profit[node] for node in nodes if node) - view.price * late)
    error = float(np.std(got)) / len(got) ** 0.5
    assert np.mean(got) == pytest.approx(policy.worth(9000.0), abs=3.0 * error + 0.1)


def test_the_bound_of_all_policies_is_above_it() -> None:
    world = mission(6, 9000.0, 2)
    view = with_recourse(world.outlook(1.0))
    prices = node_prices(world, view.price)
    pilot = Pilot(world, chart(world, 900, 2), view.price, prices)
    worth = OptimalPolicy(view).worth(9000.0)
    assert worth <= 1.01 * pilot.expected
    assert worth >= 0.8 * pilot.expected


def test_it_is_for_few_nodes() -> None:
    with pytest.raises(InputError, match="12 nodes at most"):
        OptimalPolicy(mission(13, 9000.0, 1).outlook(1.0))
