"""Plans against an ensemble: the risk measure, the recourse, and the choice."""

from dataclasses import replace

import numpy as np
import pytest

from fiveroute.decide.ensembles import (
    cvar,
    ensemble_sweep,
    held_out_of,
    plan_against_ensemble,
    recourse_completion,
)
from fiveroute.decide.members import drawn_members, member_times
from fiveroute.decide.picture import sweep_figure
from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.instance import Instance, Ocean, Vortex
from fiveroute.ocean.uncertain_ocean import VortexUncertainty
from fiveroute.paths.voyage import Voyage
from fiveroute.routes import Plan


@pytest.fixture(scope="module")
def mission() -> Instance:
    instance = generate("uniform", nodes=8, seed=5)
    vortex = Vortex(x=5000.0, y=5000.0, circulation=3000.0, radius=1500.0)
    currents = replace(instance.ocean.currents, vortices=(vortex,))
    return replace(
        instance,
        fleet=replace(instance.fleet, size=2, endurance=11000.0),
        ocean=replace(Ocean(), currents=currents),
    )


def test_the_worst_share_decides() -> None:
    rates = [0.9, 0.5, 0.7, 0.6, 1.0]
    assert cvar(rates, 0.4) == pytest.approx(0.55)
    assert cvar(rates, 1.0) == pytest.approx(np.mean(rates))
    assert cvar(rates, 0.01) == 0.5


def test_planned_times_leave_nothing_out(mission: Instance) -> None:
    problem = mission.problem(2)
    plan = Plan.of([(1, 2), (3,)])
    budgets = np.full(2, 1.2 * max(plan.durations(problem)))
    roomy = replace(problem, budgets=budgets)
    assert recourse_completion(roomy, plan, problem.travel) == pytest.approx(
        problem.collected([1, 2, 3]) / problem.total_profit
    )


def test_an_auv_turns_home_in_time(mission: Instance) -> None:
    problem = mission.problem(2)
    blocked = problem.travel.copy()
    blocked[:, 2] = np.inf
    rate = recourse_completion(problem, Plan.of([(2, 1), ()]), blocked)
    assert rate == pytest.approx(problem.collected([1]) / problem.total_profit)


def test_the_choice_is_the_best_of_the_training_members(mission: Instance) -> None:
    uncertainty = VortexUncertainty(displacement=1500.0, strength=0.8)
    members = drawn_members(mission, 8, uncertainty, np.random.default_rng(1))
    voyage = Voyage.straight(mission)
    times = [member_times(voyage, member) for member in members]
    planned = plan_against_ensemble(voyage, times, 3, alpha=0.4)
    assert len(planned.chosen.training) == 5
    assert len(planned.chosen.held_out) == 3
    worth = [cvar(each.training, 0.4) for each in planned.candidates]
    assert worth == sorted(worth, reverse=True)
    sweep = ensemble_sweep(voyage, planned)
    assert sweep.marked == planned.chosen.name
    assert sweep.because == "best in the worst 2 of 5 planned with; 3 held out"
    sweep_figure(sweep)


def test_the_same_times_are_planned_for_once(mission: Instance) -> None:
    times = [mission.travel, 1.2 * mission.travel, mission.travel]
    planned = plan_against_ensemble(Voyage.straight(mission), times, 1)
    names = {candidate.name for candidate in planned.candidates}
    assert names == {"the planned times", "the mean", "the 50 % quantile"}


def test_half_of_the_members_are_held_out() -> None:
    assert [held_out_of(count) for count in (2, 3, 30)] == [1, 1, 15]
    assert held_out_of(30, 10) == 10


@pytest.mark.parametrize("held_out", [0, 4, 9])
def test_both_kinds_of_members_are_needed(mission: Instance, held_out: int) -> None:
    times = [mission.travel] * 4
    with pytest.raises(InputError, match="held_out"):
        plan_against_ensemble(Voyage.straight(mission), times, held_out)
