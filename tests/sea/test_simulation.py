"""The simulation as a whole: whoever steers, a run obeys the sea and the rules."""

import math
from collections import Counter

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.instance import Uncertainty
from fiveroute.limits import Limits
from fiveroute.routes import Plan
from fiveroute.sea.luck import Luck
from fiveroute.sea.run_result import RunResult
from fiveroute.sea.simulation import PLANNERS, simulate_fleet
from fiveroute.sea.world import World

every_planner = pytest.mark.parametrize("planner", sorted(PLANNERS))


@pytest.mark.parametrize(
    "planner", sorted({*PLANNERS} - {"rmmp", "re-optimising"})
)  # which plan anew
def test_in_a_calm_sea_the_plan_is_what_happens(planner: str, plan: Plan) -> None:
    calm = World.of(generate(nodes=24, seed=3), 2, uncertainty=Uncertainty(floor=1.0))
    result = simulate_fleet(calm, plan, planner=planner, runs=2, reserve=0.0)
    for run in result.runs:
        assert run.completion == pytest.approx(result.planned_completion)
        assert run.arrivals == pytest.approx(plan.durations(calm.problem))
    assert result.late_returns == 0


@every_planner
def test_every_leg_takes_what_luck_says(planner: str, world: World, plan: Plan) -> None:
    run = simulate_fleet(world, plan, planner=planner, runs=1, first_run=4, seed=9).runs[0]
    legs = Luck(world.law, 9, 4).matrix() + world.problem.service
    for auv in range(world.problem.fleet_size):
        at, t = 0, 0.0
        for event in run.events:
            if event.auv == auv and event.kind in ("collect", "arrive"):
                node = world.problem.destination if event.node is None else event.node
                t += legs[at, node]
                assert event.t == pytest.approx(t)
                at = node
        assert at == world.problem.destination
        assert run.arrivals[auv] == pytest.approx(t)


@every_planner
def test_nothing_is_collected_twice_and_everybody_comes_home(
    planner: str, world: World, plan: Plan
) -> None:
    result = simulate_fleet(world, plan, planner=planner, runs=60)
    for run in result.runs:
        counts = Counter(event.node for event in run.events if event.kind == "collect")
        assert max(counts.values()) == 1
        data = world.problem.collected(sorted(node for node in counts if node is not None))
        assert run.completion == pytest.approx(data / world.problem.total_profit)
        assert Counter(e.kind for e in run.events)["arrive"] == world.problem.fleet_size
        assert [event.t for event in run.events] == sorted(event.t for event in run.events)
    assert result.double_visits == 0
    assert result.late_returns <= 0.02 * 120


@every_planner
def test_a_seed_gives_one_answer(planner: str, world: World, plan: Plan) -> None:
    def runs(first: int, count: int, seed: int = 5) -> tuple[RunResult, ...]:
        return simulate_fleet(
            world, plan, planner=planner, runs=count, first_run=first, failures=0.3, seed=seed
        ).runs

    together = runs(0, 6)
    assert together == runs(0, 6)
    assert together[4:] == runs(4, 2)
    assert together != runs(0, 6, seed=6)


def test_without_a_reserve_many_are_late(world: World, plan: Plan) -> None:
    late = [
        simulate_fleet(world, plan, planner="no-coordination", reserve=z, log=False, runs=400)
        for z in (0.0, 1.645)
    ]
    assert late[0].late_returns > 0.05 * 800
    assert late[1].late_returns <= 0.01 * 800


def test_the_kernel_sails_as_the_log_says(world: World, plan: Plan) -> None:
    told, counted = (
        simulate_fleet(
            world, plan, planner="no-coordination", runs=20, failures=0.3, log=log, seed=2
        )
        for log in (True, False)
    )
    np.testing.assert_allclose(told.completions, counted.completions)
    for one, two in zip(told.runs, counted.runs, strict=True):
        assert one.arrivals == pytest.approx(two.arrivals)
        assert not two.events


def test_who_fails_does_not_arrive(world: World, plan: Plan) -> None:
    result = simulate_fleet(world, plan, runs=30, failures=0.5)
    ends = Counter(e.kind for run in result.runs for e in run.events)
    assert ends["fail"] + ends["arrive"] == 60
    assert ends["fail"] > 10
    for run in result.runs:
        failed = {event.auv: event.t for event in run.events if event.kind == "fail"}
        assert all(math.isinf(run.arrivals[auv]) for auv in failed)
        assert all(e.t <= failed.get(e.auv, math.inf) for e in run.events)


def test_it_stops_when_asked(world: World, plan: Plan) -> None:
    assert len(simulate_fleet(world, plan, runs=50, limits=Limits(time=0.0)).runs) == 1


@pytest.mark.parametrize(
    "options",
    [
        {"planner": "nobody"},
        {"runs": 0},
        {"reserve": -1.0},
        {"reserve": math.nan},
        {"failures": 1.5},
    ],
)
def test_what_makes_no_sense_is_refused(
    world: World, plan: Plan, options: dict[str, float]
) -> None:
    with pytest.raises(InputError):
        simulate_fleet(world, plan, **options)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="plan"):
        simulate_fleet(world, Plan(((1,), (1,))))
