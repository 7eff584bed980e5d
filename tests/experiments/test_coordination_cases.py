"""Cases with and without coordination, and the auctions that are shown."""

import numpy as np
import pytest

from fiveroute.experiments.coordination_cases import Case, Sailed, busiest_auction
from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.events import Event
from fiveroute.sea.run_result import RunResult
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World


@pytest.fixture(scope="module")
def case() -> Case:
    """A small mission, so loosely planned that there is something to gain."""
    instance = generate(nodes=14, seed=3)
    world = World.of(instance, 2)
    plan = Plan.of([[1, 2, 3], [4, 5]])
    alone, together = (
        simulate_fleet(world, plan, planner=planner, runs=4).runs
        for planner in ("no-coordination", "five-tier")
    )
    return Case(1, instance, world, plan, alone, together)


def test_what_became_of_a_plan() -> None:
    log = [(0, 1), (1, 3), (0, 4)]
    events = tuple(Event(float(k), auv, "collect", node) for k, (auv, node) in enumerate(log))
    run = RunResult(0, 0.5, (9.0, 9.0), 0, events=events)
    sailed = Sailed.of(run, Plan.of([[1, 2], [3, 4]]))
    assert sailed.routes == ((1, 4), (3,))
    assert sailed.lost == {2}
    assert sailed.gained == {4}


def test_the_run_shown_is_the_one_nearest_to_the_mean(case: Case) -> None:
    gains = case.gains
    assert gains.mean() > 0.0
    assert abs(gains[case.typical] - gains.mean()) == np.abs(gains - gains.mean()).min()
    assert case.planned == pytest.approx(
        case.world.problem.collected([1, 2, 3, 4, 5]) / case.world.problem.total_profit
    )


def test_an_auction_gives_each_node_once_and_each_auv_one_a_round(case: Case) -> None:
    rounds = busiest_auction(case.world, case.plan, 3)
    given = []
    for r in rounds:
        assert r.psi.shape == (len(r.auvs), len(r.nodes))
        for m, j in enumerate(r.won):
            if j >= 0:
                assert r.psi[m, j] > 0.0
                given.append(r.nodes[j])
    assert len(given) >= 2
    assert len(given) == len(set(given))
    assert set(given) <= set(range(1, 15))


def test_no_auction_where_nothing_is_idle() -> None:
    world = World.of(generate(nodes=2, seed=3), 1)
    assert busiest_auction(world, Plan.of([[1, 2]]), 1) == ()
