"""The ocean on the command line: paths, plans in it, and the judge."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

STREAM = {"currents": {"uniform": {"u": 0.5, "v": 0.0}}}


@pytest.fixture
def sea(tmp_path: Path) -> Callable[..., Path]:
    """Three nodes in a square of 2 km, in an ocean of one's own."""

    def write(name: str = "sea.json", **ocean: object) -> Path:
        document = {
            "format": "fiveroute-instance/1",
            "name": "sea",
            "nodes": [
                {"id": "a", "x": 500.0, "y": 1500.0, "data": 0.5},
                {"id": "b", "x": 1000.0, "y": 400.0, "data": 0.25},
                {"id": "c", "x": 1500.0, "y": 1600.0, "data": 1.0},
            ],
            "start": {"x": 0.0, "y": 0.0},
            "destination": {"x": 2000.0, "y": 0.0},
            "fleet": {"size": 1, "speed": 1.0, "endurance": 5500.0},
            "ocean": ocean,
        }
        path = tmp_path / name
        path.write_text(json.dumps(document), encoding="utf-8")
        return path

    return write


def changed(path: Path, change: Callable[[dict[str, Any]], None]) -> Path:
    document = json.loads(path.read_text(encoding="utf-8"))
    change(document)
    edited = path.with_name("edited-plan.json")
    edited.write_text(json.dumps(document), encoding="utf-8")
    return edited


def test_a_path_downstream_and_back(call: Any, sea: Any) -> None:
    there = call("path", sea(**STREAM), "start", "destination", "--json").doc
    back = call("path", sea(**STREAM), "destination", "start", "--json").doc
    assert there["duration"] == pytest.approx(2000.0 / 1.5)
    assert back["duration"] == pytest.approx(2000.0 / 0.5)
    assert there["waypoints"][0] == [0.0, 0.0]
    assert there["waypoints"][-1] == [2000.0, 0.0]
    assert there["gap"] == pytest.approx(0.0, abs=1e-6)
    assert there["min_clearance"] is None


def test_a_path_round_an_obstacle(call: Any, sea: Any) -> None:
    rock = {"x": 1000.0, "y": 0.0, "radius": 200.0}
    answer = call("path", sea(obstacles=[rock]), "start", "destination", "--json").doc
    tangent = 2.0 * (np.sqrt(1000.0**2 - 200.0**2) + 200.0 * np.arcsin(0.2))
    assert answer["duration"] == pytest.approx(tangent, rel=1e-3)
    assert 0.0 <= answer["min_clearance"] < 5.0
    assert answer["max_curvature"] <= 0.1


def test_a_path_against_too_strong_a_current(call: Any, sea: Any) -> None:
    file = sea(currents={"uniform": {"u": -1.2, "v": 0.0}})
    answer = call("path", file, "start", "destination", "--json")
    assert answer.code == 1
    assert answer.doc["duration"] is None
    assert "against the current" in call("path", file, "start", "c").out


def test_a_picture_of_a_path(call: Any, sea: Any, tmp_path: Path) -> None:
    picture = tmp_path / "path.png"
    rock = {"x": 1000.0, "y": 0.0, "radius": 200.0}
    polygon = {"polygon": [[300, 900], [700, 900], [500, 1200]]}
    file = sea(**STREAM, obstacles=[rock], land=[polygon])
    assert call("path", file, "start", "b", "--picture", picture).code == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert call("path", file, "start", "b", "--picture", picture).code == 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("start", "z"), "TO: 'z': is no stop of 'sea'"),
        (("strat", "a"), "FROM: 'strat': is no stop of 'sea'; did you mean 'start'?"),
    ],
)
def test_unknown_stops(call: Any, sea: Any, arguments: tuple[str, str], message: str) -> None:
    answer = call("path", sea(**STREAM), *arguments)
    assert answer.code == 2
    assert message in answer.err


def test_a_stop_inside_an_obstacle(call: Any, sea: Any) -> None:
    answer = call("plan", sea(obstacles=[{"x": 500.0, "y": 1500.0, "radius": 50.0}]))
    assert answer.code == 2
    assert "'a'" in answer.err
    assert "obstacles[0]" in answer.err


@pytest.mark.parametrize("command", ["plan", "solve"])
def test_a_plan_in_the_ocean_is_accepted_there(
    call: Any, sea: Any, tmp_path: Path, command: str
) -> None:
    file, plan = (
        sea(**STREAM, obstacles=[{"x": 800.0, "y": 1000.0, "radius": 150.0}]),
        (tmp_path / "plan.json"),
    )
    answer = call(command, file, "--output", plan, "--json")
    assert answer.code == 0
    assert answer.doc["straight_lines"] is False
    verdict = call("verify", file, plan, "--json")
    assert verdict.code == 0
    assert verdict.doc["durations"] == pytest.approx(answer.doc["durations"])
    assert json.loads(plan.read_text())["paths"]


def test_straight_lines_are_another_matter(call: Any, sea: Any, tmp_path: Path) -> None:
    """A plan for still water keeps within time there, but not its word in the ocean."""
    file, plan = sea(**STREAM), tmp_path / "plan.json"
    answer = call("plan", file, "--straight-lines", "--output", plan, "--json").doc
    assert answer["straight_lines"] is True
    assert call("verify", file, plan, "--straight-lines").code == 0
    verdict = call("verify", file, plan, "--json")
    assert verdict.code == 1
    assert {v["kind"] for v in verdict.doc["violations"]} <= {"duration", "over_budget"}


def test_a_plan_for_another_ocean_is_refused(call: Any, sea: Any, tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    call("plan", sea(**STREAM), "--output", plan)
    other = sea("other.json", currents={"uniform": {"u": 0.4, "v": 0.0}})
    answer = call("verify", other, plan)
    assert answer.code == 2
    assert "instance_hash" in answer.err


def test_false_paths_are_found_out(call: Any, sea: Any, tmp_path: Path) -> None:
    rock = {"x": 1000.0, "y": 0.0, "radius": 200.0}
    file, plan = sea(obstacles=[rock]), tmp_path / "plan.json"
    call("plan", file, "--output", plan)

    def through_the_rock(document: dict[str, Any]) -> None:
        document["paths"][0][-1] = [document["paths"][0][-1][0], [1000.0, 0.0], [2000.0, 0.0]]

    def elsewhere(document: dict[str, Any]) -> None:
        document["paths"][0][0][-1] = [0.0, -500.0]

    kinds = []
    for change in (through_the_rock, elsewhere):
        verdict = call("verify", file, changed(plan, change), "--json")
        assert verdict.code == 1
        kinds.append({v["kind"] for v in verdict.doc["violations"]})
    assert "collision" in kinds[0]
    assert "path" in kinds[1]


def test_an_unreachable_node_is_not_visited(call: Any, sea: Any) -> None:
    """Node c lies within four walls that overlap at their corners."""
    sides = [(1300, 1300, 1700, 1350), (1300, 1850, 1700, 1900), (1300, 1300, 1350, 1900)]
    sides.append((1650, 1300, 1700, 1900))
    walls = [{"polygon": [[w, s], [e, s], [e, n], [w, n]]} for w, s, e, n in sides]
    answer = call("plan", sea(land=walls), "--json")
    assert answer.doc["unreachable"] == ["c"]
    assert "cannot be reached and are not visited: c" in answer.err
    assert answer.doc["completion_rate"] <= 0.75 / 1.75 + 1e-9


def test_a_node_out_of_reach_counts_once_at_sea(call: Any, sea: Any, tmp_path: Path) -> None:
    """The completion of a simulation is that of its log, over the data of all nodes."""
    sides = [(1300, 1300, 1700, 1350), (1300, 1850, 1700, 1900), (1300, 1300, 1350, 1900)]
    sides.append((1650, 1300, 1700, 1900))
    walls = [{"polygon": [[w, s], [e, s], [e, n], [w, n]]} for w, s, e, n in sides]
    file, log = sea(land=walls), tmp_path / "events.jsonl"
    answer = call("simulate", file, "--runs", 3, "--events", log, "--json")
    assert answer.doc["unreachable"] == ["c"]
    data = {node["id"]: node["data"] for node in json.loads(file.read_text())["nodes"]}
    events = [json.loads(line) for line in log.read_text().splitlines()]
    collected = sum(data[event["node"]] for event in events if event["kind"] == "collect")
    assert collected > 0.0
    expected = collected / 3 / sum(data.values())
    assert answer.doc["completion"]["mean"] == pytest.approx(expected)


def test_gap_and_giant_route_in_the_ocean(call: Any, sea: Any) -> None:
    file = sea(**STREAM)
    route = call("giant-route", file, "--exact", "--json").doc
    still = call("giant-route", file, "--exact", "--straight-lines", "--json").doc
    assert route["status"] == "optimal"
    assert route["duration"] != pytest.approx(still["duration"], rel=1e-3)
    assert call("gap", file, "--json").doc["rows"][0]["nodes"] == 3


def test_legs_planned_in_haste_are_told(call: Any, sea: Any) -> None:
    eddy = {"x": 1000.0, "y": 900.0, "circulation": 900.0, "radius": 300.0}
    file = sea(currents={"vortices": [eddy]})
    hasty = call("plan", file, "--time-limit", 1e-3, "--json")
    assert "time ran out while legs were planned" in hasty.err
    assert "time ran out" not in call("plan", file, "--json").err
