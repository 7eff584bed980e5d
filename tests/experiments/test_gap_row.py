"""One instance, measured by planner, exact method and peers."""

from dataclasses import replace

import pytest

from fiveroute.experiments import gap_row
from fiveroute.experiments.gap_row import GapSettings, Side, measure
from fiveroute.generate import scenario
from fiveroute.instance import Instance
from fiveroute.limits import Limits
from fiveroute.paths.voyage import Voyage
from fiveroute.peers import PeerAnswer


def ring(**fleet: object) -> Instance:
    instance = scenario("ring", 10, seed=1, fleet_size=2)
    return replace(instance, fleet=replace(instance.fleet, **fleet))  # type: ignore[arg-type]


def measured(side: Side = "both", **fleet: object) -> gap_row.GapRow:
    return measure(Voyage.straight(ring(**fleet)), GapSettings(side=side))


def test_both_sides_meet() -> None:
    row = measured()
    assert row.status == row.exact_status == "optimal"
    assert row.heuristic == row.exact == row.best_known
    assert row.bound is not None
    assert row.gap == 0.0
    assert row.is_solved
    assert not row.contradicts


def test_a_planner_alone_has_no_bound() -> None:
    row = measured("heuristic")
    assert (row.bound, row.gap, row.exact, row.exact_seconds) == (None, None, None, None)
    assert row.heuristic == measured().heuristic
    assert not row.is_solved


def test_an_exact_method_alone_has_no_plan_to_start_from() -> None:
    row = measured("exact")
    assert (row.heuristic, row.exact, row.status) == (None, measured().exact, "optimal")
    assert row.seconds == row.exact_seconds


@pytest.mark.parametrize("side", ["both", "exact"])
def test_a_mission_out_of_reach_is_proved_so(side: Side) -> None:
    row = measured(side, endurance=1.0)
    assert (row.status, row.is_solved) == ("infeasible", True)


def test_peers_get_the_planners_problem_and_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def ask(name: str, problem: object, limits: Limits, seed: int) -> PeerAnswer:
        asked.append((name, limits.time, seed))
        return PeerAnswer(1e9, "feasible", 0.1)

    monkeypatch.setattr(gap_row, "ask", ask)
    settings = GapSettings(0.5, side="heuristic", peers=("vroom", "pyvrp"), seed=4)
    row = measure(Voyage.straight(ring()), settings)
    assert asked == [("vroom", 0.5, 4), ("pyvrp", 0.5, 4)]
    assert row.best_known == 1e9


@pytest.mark.parametrize("side", ["heuristic", "exact"])
def test_the_fleet_may_be_another(side: Side) -> None:
    instance = ring(size=None)
    row = measure(Voyage.straight(instance), GapSettings(side=side, fleet_size=1))
    assert row.fleet_size == 1
