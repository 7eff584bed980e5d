"""Simulation on the command line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli import simulate
from fiveroute.sea.agents.channel import PRESETS
from fiveroute.sea.simulation import PLANNERS

KEYS = {
    "instance",
    "planner",
    "runs",
    "fleet_size",
    "completion",
    "planned_completion",
    "late_returns",
    "double_visits",
    "messages",
    "seconds",
}


@pytest.mark.parametrize("planner", ["five-tier", "no-coordination", "ftcmp", "rmmp"])
def test_the_promised_keys(call: Any, tiny: Path, planner: str) -> None:
    answer = call("simulate", tiny, "--planner", planner, "--runs", 5, "--json")
    assert answer.code == 0
    assert set(answer.doc) >= KEYS
    assert set(answer.doc["completion"]) == {"mean", "std", "min", "p25", "median", "p75", "max"}
    assert answer.doc["completion"]["max"] <= 1.0


def test_a_filed_plan_is_carried_out(call: Any, tiny: Path, tmp_path: Path) -> None:
    plan, log = tmp_path / "plan.json", tmp_path / "events.jsonl"
    call("plan", tiny, "--output", plan)
    answer = call(
        "simulate", tiny, plan, "--runs", 4, "--reserve", 0, "--events", log, "--gap", "--json"
    )
    assert answer.code == 0
    planned = json.loads(plan.read_text())["objective"] / 1.75
    assert answer.doc["planned_completion"] == pytest.approx(planned)
    assert answer.doc["online_gap"] >= -1e-9
    events = [json.loads(line) for line in log.read_text().splitlines()]
    assert {event["run"] for event in events} == set(range(4))
    collected = sum(
        {"a": 0.5, "b": 0.25, "far": 1.0}[event["node"]]
        for event in events
        if event["kind"] == "collect"
    )
    assert answer.doc["completion"]["mean"] == pytest.approx(collected / 4 / 1.75)


def test_a_plan_has_its_own_fleet_size(call: Any, tiny: Path, tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    call("plan", tiny, "--output", plan)
    assert call("simulate", tiny, plan, "--runs", 1, "--fleet-size", 1).code == 0
    answer = call("simulate", tiny, plan, "--runs", 1, "--fleet-size", 2)
    assert answer.code == 2
    assert "the plan has 1 AUVs" in answer.err


def test_the_same_seed_gives_the_same_numbers(call: Any, tiny: Path, tmp_path: Path) -> None:
    tables = []
    for workers in (1, 2):
        table = tmp_path / f"{workers}.csv"
        call("simulate", tiny, "--runs", 8, "--workers", workers, "--output", table)
        tables.append(table.read_text())
    assert tables[0] == tables[1]


def test_a_vehicle_sails_the_legs(call: Any, tiny: Path, tmp_path: Path) -> None:
    tables = []
    for workers in (1, 2):
        table = tmp_path / f"{workers}.csv"
        answer = call(
            *("simulate", tiny, "--actuation", "vehicle", "--runs", 4, "--gap"),
            *("--workers", workers, "--output", table, "--json"),
        )
        assert answer.code == 0
        assert answer.doc["collisions"] == 0
        assert answer.doc["online_gap"] is None
        assert "no gap is given" in answer.err
        tables.append(table.read_text())
    assert tables[0] == tables[1]


@pytest.mark.parametrize("actuation", ["abstraction", "vehicle"])
def test_the_tracks_are_written(call: Any, tiny: Path, tmp_path: Path, actuation: str) -> None:
    import xarray as xr

    path = tmp_path / "tracks.nc"
    args = ("simulate", tiny, "--actuation", actuation, "--runs", 2, "--tracks", path)
    assert call(*args).code == 0
    with xr.open_dataset(path) as data:
        assert data["run"].to_numpy().tolist() == [0, 1]
        assert data["row_size"].sum().item() == data.sizes["obs"] > 4
        assert data["x"][0].item() == data["y"][0].item() == 0.0
    assert call(*args).code == 2


def test_the_choices_are_those_there_are() -> None:
    """The command line names them without importing what they stand for."""
    assert set(simulate.PLANNERS) == set(PLANNERS)
    assert set(simulate.CHANNELS) == set(PRESETS)


def test_a_short_answer_for_people(call: Any, tiny: Path) -> None:
    answer = call("simulate", tiny, "--runs", 3)
    assert answer.code == 0
    assert "tiny: 3 runs of 1 AUVs, five-tier" in answer.out
    assert "late returns" in answer.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--output", "runs.xlsx"), "ends in .parquet, .csv or .md"),
        (("--planner", "nobody"), "nobody"),
        (("--loss", "2"), "2"),
    ],
)
def test_bad_calls(call: Any, tiny: Path, arguments: tuple[str, str], message: str) -> None:
    answer = call("simulate", tiny, *arguments)
    assert answer.code == 2
    assert message in answer.err


def test_a_table_has_its_registry_beside_it(call: Any, tiny: Path, tmp_path: Path) -> None:
    table, entry = tmp_path / "runs.csv", tmp_path / "runs.run.json"
    assert call("simulate", tiny, "--runs", 3, "--seed", 5, "--output", table).code == 0
    record = json.loads(entry.read_text())
    assert record["config"]["seed"] == 5
    assert record["ended"] is not None
    assert sorted(file.name for file in tmp_path.iterdir() if "runs" in file.name) == [
        "runs.csv",
        "runs.run.json",
    ]


def test_another_campaign_that_is_not_over_is_not_touched(
    call: Any, tiny: Path, tmp_path: Path
) -> None:
    table, entry = tmp_path / "runs.csv", tmp_path / "runs.run.json"
    call("simulate", tiny, "--runs", 3, "--output", table)
    table.unlink()
    entry.write_text(entry.read_text().replace('"ended": "', '"ended": null, "once": "'))
    answer = call("simulate", tiny, "--runs", 4, "--output", table)
    assert answer.code == 2
    assert "runs was 3, and is 4" in answer.err
    assert call("simulate", tiny, "--runs", 3, "--output", table).code == 0


def test_a_fleet_that_cannot_get_home_is_told_so(call: Any, tiny: Path, tmp_path: Path) -> None:
    document = json.loads(tiny.read_text())
    document["fleet"]["endurance"] = 1.0
    short = tmp_path / "short.json"
    short.write_text(json.dumps(document))
    answer = call("simulate", short, "--runs", 2, "--json")
    assert answer.code == 1
    assert "the destination is out of reach in time" in answer.err
    assert answer.doc["late_returns"] > 0
