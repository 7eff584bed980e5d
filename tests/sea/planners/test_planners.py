"""The planners that know all: who gets what, and what each of them must not do."""

import math
from collections import Counter

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.agents.teammates import SILENCE
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.luck import Luck
from fiveroute.sea.planners.all_knowing import AllKnowing
from fiveroute.sea.planners.ftcmp import Ftcmp
from fiveroute.sea.planners.of_one_mind import OfOneMind
from fiveroute.sea.planners.own_pick_up import OwnPickUp
from fiveroute.sea.planners.re_optimising import ReOptimising
from fiveroute.sea.planners.rmmp import Rmmp
from fiveroute.sea.planners.to_the_letter import ToTheLetter
from fiveroute.sea.run import Run
from fiveroute.sea.world import World

Knowing = type[Ftcmp | OfOneMind | OwnPickUp | ReOptimising | Rmmp | ToTheLetter]
KNOWING: list[Knowing] = [Ftcmp, OfOneMind, OwnPickUp, ReOptimising, Rmmp, ToTheLetter]


def sail(
    kind: Knowing,
    world: World,
    plan: Plan,
    budgets: list[float],
    failures: tuple[float, ...] | None = None,
    number: int = 0,
) -> Run:
    problem = world.problem.with_budgets(budgets)
    view = Outlook.of(problem, world.law, 1.645)
    run = Run(problem, Luck(world.law, 1, number), failures or (math.inf,) * len(budgets))
    run.sail(kind(run, view, plan))
    return run


def collected(run: Run, auv: int | None = None) -> set[int]:
    return {
        e.node
        for e in run.log
        if e.kind == "collect" and e.node is not None and auv in (None, e.auv)
    }


@pytest.mark.parametrize("kind", KNOWING)
def test_who_has_time_takes_the_nodes_of_the_failed(kind: Knowing, world: World) -> None:
    plan = Plan.of([range(1, 13), range(13, 19)])
    run = sail(kind, world, plan, [40_000.0, 40_000.0], (10.0, math.inf))
    assert collected(run, 0) == set()
    given_up = {e.node for e in run.log if e.kind == "discard" and e.auv == 0}
    lost = set(range(1, 13)) - given_up
    inherited = [e.t for e in run.log if e.kind == "collect" and e.node in lost]
    assert inherited
    if kind not in (Rmmp, ReOptimising):
        assert min(inherited) > SILENCE


def test_ftcmp_hands_over_what_a_fault_drops_and_nothing_else(world: World) -> None:
    plan = Plan.of([range(1, 13), [13, 14]])
    run = sail(Ftcmp, world, plan, [9000.0, 40_000.0])
    dropped = {e.node for e in run.log if e.kind == "discard" and e.auv == 0}
    handed = {e.node for e in run.log if e.kind == "pick_up" and e.auv == 1}
    assert handed
    assert handed <= dropped
    assert collected(run) <= set(range(1, 15))


def test_rmmp_shares_all_unvisited_nodes_out(world: World) -> None:
    plan = Plan.of([range(1, 9), range(9, 17)])
    problem = world.problem
    view = Outlook.of(problem, world.law, 1.645)
    crew = Rmmp(Run(problem, Luck(world.law, 1, 0), (math.inf, math.inf)), view, plan)
    cells = [crew._cell(auv, 0.0) for auv in range(2)]
    assert cells[0] | cells[1] == set(range(1, 25))
    assert not cells[0] & cells[1]
    assert set(range(1, 9)) <= cells[0]


def test_word_of_idle_nodes_is_worth_something(world: World) -> None:
    plan = Plan.of([range(1, 9), ()])
    for kind in (OwnPickUp, OfOneMind, ReOptimising, ToTheLetter, Rmmp):
        assert len(collected(sail(kind, world, plan, [18_000.0, 18_000.0]))) > 8
    assert len(collected(sail(Ftcmp, world, plan, [18_000.0, 18_000.0]))) <= 8


def test_a_plan_in_time_is_left_alone_by_the_faithful() -> None:
    """With endless time every planner that follows its plan visits all that is on it."""
    world = World.of(generate(nodes=10, seed=4), 2)
    plan = Plan.of([range(1, 6), range(6, 11)])
    for kind in (Ftcmp, ToTheLetter):
        run = sail(kind, world, plan, [1e6, 1e6])
        order = [e.node for e in run.log if e.kind == "collect" and e.auv == 0]
        assert order == [1, 2, 3, 4, 5]
        assert Counter(e.kind for e in run.log)["discard"] == 0


def test_the_state_of_the_fleet_is_shared(world: World) -> None:
    plan = Plan.of([[1, 2], [3]])
    run = Run(world.problem, Luck(world.law, 1, 0), (math.inf, 5.0))
    crew = AllKnowing(run, Outlook.of(world.problem, world.law, 0.0), plan)
    assert crew.idle == set(range(4, 25))
    assert crew.depart(0) == 1
    assert crew.routes[0] == (2,)
    run.vessels[1].is_alive = False
    run.vessels[1].target = 7
    assert crew.abandoned(SILENCE) == ()
    assert crew.abandoned(SILENCE + 5.0) == (7, 3)
    assert crew.abandoned(SILENCE + 6.0) == ()
    np.testing.assert_array_equal(crew.active, [0])
