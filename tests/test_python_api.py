"""What ``import fiveroute`` offers: complete, lazy, and the same as the command line."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import fiveroute as fr
from fiveroute.formats import write_instance
from fiveroute.generate import generate
from fiveroute.vehicle_files import Choices


@pytest.fixture(scope="module")
def sea() -> fr.Instance:
    instance = generate("uniform", nodes=8, seed=2)
    fleet = replace(instance.fleet, size=2, endurance=9000.0)
    return replace(instance, fleet=fleet, ocean=type(instance.ocean)())


def test_every_name_can_be_had() -> None:
    assert set(fr.__all__) <= set(dir(fr))
    assert [name for name in dir(fr) if not name.startswith("__")] == sorted(fr.__all__)
    for name in fr.__all__:
        assert getattr(fr, name) is not None
    with pytest.raises(AttributeError, match="nonsense"):
        _ = fr.nonsense  # type: ignore[attr-defined]


def test_importing_it_loads_next_to_nothing() -> None:
    script = "import sys, fiveroute; print(len([m for m in sys.modules if 'numpy' in m]))"
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "0"


def test_a_plan_knows_its_gap(sea: fr.Instance) -> None:
    plan = fr.plan(sea)
    assert plan.objective is not None
    assert plan.bound is not None
    assert plan.objective <= plan.bound + 1e-9
    difference = max(plan.bound - plan.objective, 0.0)
    assert plan.gap == pytest.approx(difference / plan.objective, abs=1e-6)
    assert len(plan.routes) == len(plan.durations) == plan.fleet_size == 2
    assert max(plan.durations) <= 9000.0 * (1 + 1e-9)
    assert plan.verify().feasible
    assert str(plan).count("AUV") == 2
    assert "<svg" in plan._repr_html_()


def test_a_plan_is_short_where_it_is_typed(sea: fr.Instance) -> None:
    plan = fr.plan(sea)
    assert repr(plan) == f"<FleetPlan {str(plan).splitlines()[0]}>"


def test_what_is_no_mission_is_refused(sea: fr.Instance) -> None:
    path: Any = "sea.json"
    for call in (fr.plan, fr.solve, fr.simulate):
        with pytest.raises(fr.InputError, match="read its file first"):
            call(path)
    with pytest.raises(fr.InputError, match="runs: 0: must be at least 1"):
        fr.simulate(sea, runs=0)
    car: Any = "car"
    with pytest.raises(fr.InputError, match="actuation: 'car': take one of abstraction, vehicle"):
        fr.simulate(sea, runs=1, actuation=car)


def test_a_plan_for_other_nodes_is_not_sailed(sea: fr.Instance) -> None:
    """They have the same ids, so that the wrong plan would look like a bad one."""
    other = generate("uniform", nodes=8, seed=3)
    with pytest.raises(fr.InputError, match="plan: 'uniform-8-2': was made for other nodes"):
        fr.simulate(other, fr.plan(sea), runs=1)


def test_an_instance_is_made_from_arrays() -> None:
    nodes = tuple(
        fr.Node(id=f"N{k}", x=x, y=y, data=1.0)
        for k, (x, y) in enumerate([(900.0, 100.0), (1500.0, -200.0), (60_000.0, 0.0)], start=1)
    )
    sea = fr.Instance(
        name="mine",
        nodes=nodes,
        start=fr.Point(x=0.0, y=0.0),
        destination=fr.Point(x=2000.0, y=0.0),
        fleet=fr.Fleet(size=1, speed=1.5, endurance=3600.0),
        service=fr.Service(delay=60.0),
    )
    assert fr.solve(sea).routes == [["N1", "N2"]]
    assert isinstance(sea.problem(), fr.TeamOrienteering)


def test_a_plan_made_in_haste_says_what_its_routes_take(tmp_path: Path) -> None:
    """Legs are timed roughly where time is up, and would be called false claims by the judge."""
    instance = generate("paper", nodes=6, seed=5)
    instance = replace(instance, fleet=replace(instance.fleet, size=2, endurance=12_000.0))
    plan = fr.plan(instance, limits=1e-3)
    assert plan.voyage.hasty is not None
    assert plan.result.plan is not None
    rough = plan.result.plan.durations(plan.problem)
    assert all(
        exact <= other <= 1.003 * exact for exact, other in zip(plan.durations, rough, strict=True)
    )
    assert plan.verify().feasible
    plan.save(tmp_path / "plan.json")
    assert fr.read_plan(tmp_path / "plan.json").verify().feasible


def test_an_exact_method_proves_no_less(sea: fr.Instance) -> None:
    plan, proved = fr.plan(sea), fr.solve(sea)
    assert proved.status is fr.Status.OPTIMAL
    assert proved.gap == 0.0
    assert (plan.objective or 0.0) <= (proved.objective or 0.0) + 1e-9


def test_a_plan_goes_into_files(sea: fr.Instance, tmp_path: Path) -> None:
    plan = fr.plan(sea, limits=30)
    plan.save(tmp_path / "plan.json")
    filed = json.loads((tmp_path / "plan.json").read_text())
    assert filed["routes"] == plan.routes
    assert plan.view(tmp_path / "plan.html").read_text().startswith("<!")
    choices = Choices(depth=10.0, origin=(8.6, 63.9))
    plan.export("csv", tmp_path / "plan.csv", choices)
    assert (tmp_path / "plan.csv").stat().st_size > 0
    with pytest.raises(fr.InputError, match="force"):
        plan.save(tmp_path / "plan.json")


def test_a_saved_plan_comes_back(sea: fr.Instance, tmp_path: Path) -> None:
    plan = fr.plan(sea)
    plan.save(tmp_path / "plan.json")
    again = fr.read_plan(tmp_path / "plan.json")
    assert again.filed() == plan.filed()
    assert again.verify().feasible
    assert str(again) == str(plan)
    assert fr.simulate(sea, again, runs=2).runs == fr.simulate(sea, plan, runs=2).runs


@pytest.mark.parametrize(
    ("routes", "says"), [([["2", "2"], []], "plan it anew"), ([["2", "none"], []], "no node")]
)
def test_a_saved_plan_that_breaks_a_rule_is_refused(
    sea: fr.Instance, tmp_path: Path, routes: list[list[str]], says: str
) -> None:
    fr.plan(sea).save(tmp_path / "plan.json")
    document = json.loads((tmp_path / "plan.json").read_text())
    (tmp_path / "plan.json").write_text(json.dumps(document | {"routes": routes}))
    with pytest.raises(fr.InputError, match=says):
        fr.read_plan(tmp_path / "plan.json")


def test_an_instance_is_read_wherever_it_lies(
    sea: fr.Instance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    currents = replace(sea.ocean.currents, file="forecast.nc")
    named = replace(sea, ocean=replace(sea.ocean, currents=currents))
    write_instance(named, tmp_path / "sea.json", "native")
    monkeypatch.chdir(tmp_path)
    instance = fr.read("sea.json")
    assert instance.ocean.currents.file == str(tmp_path / "forecast.nc")
    with pytest.raises(fr.InputError, match=r"forecast\.nc"):
        fr.plan(instance)


def test_runs_at_sea_are_repeatable(sea: fr.Instance) -> None:
    uncertain = replace(sea, uncertainty=replace(sea.uncertainty, drift=0.2))
    plan = fr.plan(uncertain)
    one, two = (fr.simulate(uncertain, plan, runs=4, seed=3) for _ in range(2))
    assert one.completions.tolist() == two.completions.tolist()
    assert one.fleet_size == 2
    assert fr.simulate(uncertain, runs=2).runs


@pytest.fixture(scope="module")
def runs(sea: fr.Instance) -> fr.FleetRuns:
    uncertain = replace(sea, uncertainty=replace(sea.uncertainty, drift=0.2))
    return fr.simulate(uncertain, fr.plan(uncertain), runs=3, channel="fsk", seed=3)


def test_runs_tell_what_became_of_the_fleet(runs: fr.FleetRuns) -> None:
    lines = str(runs).splitlines()
    assert lines[0] == f"{runs.plan.instance.name}: 3 runs of 2 AUVs, five-tier"
    assert f"{100 * runs.completions.mean():.1f} % of all data" in lines[1]
    assert repr(runs) == f"<FleetRuns {lines[0]}>"
    page = runs._repr_html_()
    assert lines[1] in page
    assert "<svg" in page
    assert runs.plan.gap is not None


def test_runs_go_into_files(runs: fr.FleetRuns, tmp_path: Path) -> None:
    """The table, the log and the tracks agree with one another."""
    runs.save(tmp_path / "runs.csv")
    rows = (tmp_path / "runs.csv").read_text().splitlines()
    assert len(rows) == 1 + 3
    runs.save_events(tmp_path / "events.jsonl")
    events = [json.loads(line) for line in (tmp_path / "events.jsonl").read_text().splitlines()]
    ids = {node.id for node in runs.plan.instance.nodes}
    assert {event["node"] for event in events if event["kind"] == "collect"} <= ids
    runs.save_tracks(tmp_path / "tracks.nc")
    with xr.open_dataset(tmp_path / "tracks.nc") as tracks:
        assert tracks.sizes["trajectory"] == 3 * 2
    for run in runs.runs:
        for track, arrival in zip(runs.tracks(run), run.arrivals, strict=True):
            assert track[-1, 0] == pytest.approx(arrival)
    with pytest.raises(fr.InputError, match="force"):
        runs.save(tmp_path / "runs.csv")


def test_runs_are_played_on_a_page(runs: fr.FleetRuns, tmp_path: Path) -> None:
    assert runs.view(tmp_path / "runs.html").read_text().startswith("<!")
    assert runs.view(tmp_path / "run.png", run=1).stat().st_size > 1000


def test_what_no_fleet_can_do_is_refused(sea: fr.Instance) -> None:
    with pytest.raises(fr.InputError, match="channel: 'shouting': is none of unlimited, fsk"):
        fr.simulate(sea, runs=1, channel="shouting")
    with pytest.raises(fr.InputError, match="the plan has 2 AUVs"):
        fr.simulate(sea, fr.plan(sea), runs=1, fleet_size=3)


def test_a_proof_for_straight_lines_does_not_hold_in_a_current() -> None:
    instance = generate("paper", nodes=6, seed=5)
    instance = replace(instance, fleet=replace(instance.fleet, size=2, endurance=12_000.0))
    straight = fr.plan(instance, straight_lines=True)
    assert straight.bound is not None
    assert fr.simulate(instance, straight, runs=1, straight_lines=True).plan.bound is not None
    assert fr.simulate(instance, straight, runs=1).plan.bound is None


def test_wrong_options_are_refused_before_the_legs_are_planned() -> None:
    instance = generate("paper", nodes=40, seed=5)
    wrong: Any = "nonsense"
    told: list[fr.Progress] = []
    with pytest.raises(fr.InputError, match="search: 'nonsense': take one of"):
        fr.plan(instance, search=wrong, progress=told.append)
    assert told == []
