"""From a plan file to files for vehicles, at the command line."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from fiveroute.cli.export import _FORMATS
from fiveroute.vehicle_files import VEHICLE_FORMATS


@pytest.fixture
def plan(call: Any, edited: Callable[..., Path], tmp_path: Path) -> Path:
    path = tmp_path / "plan.json"
    mission = edited(crs="+proj=aeqd +lat_0=63 +lon_0=10", fleet__depth=12.0)
    assert call("plan", mission, "--output", path).code == 0
    return path


def test_the_command_knows_all_formats() -> None:
    assert list(_FORMATS) == list(VEHICLE_FORMATS)


@pytest.mark.parametrize("name", VEHICLE_FORMATS)
def test_every_format_is_written(call: Any, plan: Path, tmp_path: Path, name: str) -> None:
    target = tmp_path / "out"
    answer = call("export", plan, "--to", name, "--output", target, "--depart", "2026-06-01T06:00")
    assert (answer.code, answer.out) == (0, "")
    assert "auv-1: 2 nodes, 4 waypoints, home after 33.5 s" in answer.err
    assert target.exists()
    again = call("export", plan, "--to", name, "--output", target)
    assert (again.code, again.err.count("\n")) == (2, 1)
    assert "--force" in again.err
    assert call("export", plan, "--to", name, "--output", target, "--force").code == 0


def test_options_reach_the_file(call: Any, plan: Path, tmp_path: Path) -> None:
    target = tmp_path / "one.plan"
    options = ("--auv", 1, "--depth", 7, "--vehicle", "sparus", "--origin", "10,63")
    assert call("export", plan, "--to", "qgc", "--output", target, *options).code == 0
    items = json.loads(target.read_text())["mission"]["items"]
    assert [item["Altitude"] for item in items[1:]] == [-7.0, -7.0, -0.1]


@pytest.mark.parametrize(
    ("changes", "options", "words"),
    [
        ({"crs": None}, (), ("instance.crs", "--origin")),
        ({"fleet__depth": None}, (), ("depth", "--depth")),
        ({"fleet__depth_rating": 10.0}, (), ("12", "rating of 10 m")),
        ({}, ("--auv", 2), ("--auv", "2")),
        ({}, ("--origin", "10"), ("two numbers",)),
        ({}, ("--origin", "nan,1"), ("two numbers",)),
        ({}, ("--depth", "-1"), ("--depth",)),
        ({}, ("--depth", "nan"), ("--depth",)),
        ({}, ("--tolerance", "inf"), ("--tolerance",)),
        ({}, ("--depart", "soon"), ("--depart",)),
    ],
)
def test_what_is_wrong_is_told_in_one_line(
    call: Any,
    edited: Callable[..., Path],
    tmp_path: Path,
    changes: dict[str, object],
    options: tuple[str, ...],
    words: tuple[str, ...],
) -> None:
    stated = {"crs": "+proj=aeqd +lat_0=63 +lon_0=10", "fleet__depth": 12.0} | changes
    path = tmp_path / "plan.json"
    assert call("plan", edited(**stated), "--output", path).code == 0
    answer = call("export", path, "--to", "gpx", "--output", tmp_path / "x.gpx", *options)
    assert (answer.code, answer.out, answer.err.count("\n")) == (2, "", 1)
    assert all(word in answer.err for word in words)
    assert not (tmp_path / "x.gpx").exists()


def test_an_unsafe_plan_is_refused(call: Any, plan: Path, tmp_path: Path) -> None:
    from fiveroute.formats import instance_hash, native

    document = json.loads(plan.read_text())
    document["instance"]["ocean"]["obstacles"] = [{"x": 15.0, "y": 0.0, "radius": 2.0}]
    document["instance_hash"] = instance_hash(native.read(json.dumps(document["instance"]), ""))
    plan.write_text(json.dumps(document))
    answer = call("export", plan, "--to", "wpl", "--output", tmp_path / "out")
    assert answer.code == 2
    assert "unsafe" in answer.err
    assert "obstacle" in answer.err
    assert not (tmp_path / "out").exists()
