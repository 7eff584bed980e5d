"""From a chart of nodes to a mission, at the command line."""

import json
from pathlib import Path
from typing import Any

import pytest

TABLE = "id,lon,lat,data,depth\na,10.0,63.05,2,30\nb,10.05,63.02,1,\n"
ENDS = ("--start", "10,63", "--destination", "10.1,63")
FLEET = ("--speed", "1.5", "--endurance", "20000")


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "nodes.csv"
    path.write_text(TABLE)
    return path


def test_a_table_becomes_a_mission(call: Any, table: Path, tmp_path: Path) -> None:
    zones, currents = tmp_path / "coast.geojson", tmp_path / "model.nc"
    corners = [[10.2, 63.0], [10.3, 63.0], [10.3, 63.1], [10.2, 63.0]]
    land = {"type": "Polygon", "coordinates": [corners]}
    document = {"type": "Feature", "properties": {"kind": "land"}, "geometry": land}
    zones.write_text(json.dumps(document))
    currents.write_bytes(b"CDF")
    target = tmp_path / "missions" / "sea.json"
    target.parent.mkdir()
    options = ("--zones", zones, "--currents", currents, "--depth", 5, "--depth-rating", 80)
    answer = call("convert", table, "--to", "native", "--output", target, *ENDS, *FLEET, *options)
    assert (answer.code, answer.out, answer.err) == (0, "", "")
    sea = json.loads(target.read_text())
    assert [node["id"] for node in sea["nodes"]] == ["a", "b"]
    assert sea["nodes"][0]["depth"] == 30.0
    assert sea["fleet"] == {
        "size": None, "speed": 1.5, "endurance": 20000.0, "depth": 5.0, "depth_rating": 80.0
    }  # fmt: skip
    assert len(sea["ocean"]["land"]) == 1
    assert sea["ocean"]["currents"]["file"] == str(currents)
    assert sea["crs"].startswith("+proj=aeqd")


def test_currents_are_found_from_the_mission(
    call: Any, table: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.nc").write_bytes(b"CDF")
    (tmp_path / "deep").mkdir()
    target = Path("deep") / "sea.json"
    answer = call(
        "convert", "nodes.csv", "--to", "native", "--output", target, *ENDS, *FLEET,
        "--currents", "model.nc",
    )  # fmt: skip
    assert answer.code == 0
    assert json.loads(target.read_text())["ocean"]["currents"]["file"] == "../model.nc"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (FLEET, ("--start", "LON,LAT")),
        ((*ENDS[:2], *FLEET), ("--destination",)),
        ((*ENDS, *FLEET[:2]), ("--endurance",)),
        ((*ENDS, *FLEET[2:]), ("--speed",)),
        ((*ENDS, *FLEET, "--speed", "0"), ("--speed", "x>0")),
        ((*ENDS, *FLEET, "--endurance", "inf"), ("--endurance", "finite")),
        ((*ENDS, *FLEET, "--fleet-size", "0"), ("--fleet-size",)),
        ((*ENDS, *FLEET, "--start", "63,10"), ("longitude first",)),
        ((*ENDS, *FLEET, "--currents", "nowhere.nc"), ("nowhere.nc", "does not exist")),
        ((*ENDS, *FLEET, "--zones", "nowhere.kml"), ("nowhere.kml", "does not exist")),
    ],
)
def test_what_is_missing_is_told_in_one_line(
    call: Any, table: Path, tmp_path: Path, options: tuple[str, ...], words: tuple[str, ...]
) -> None:
    answer = call("convert", table, "--to", "native", "--output", tmp_path / "x.json", *options)
    assert (answer.code, answer.out, answer.err.count("\n")) == (2, "", 1)
    assert all(word in answer.err for word in words)
    assert not (tmp_path / "x.json").exists()


def test_missions_need_no_terms(call: Any, tiny: Path, tmp_path: Path) -> None:
    answer = call("convert", tiny, "--to", "native", "--output", tmp_path / "x", "--speed", "2")
    assert answer.code == 2
    assert "--speed is for charts" in answer.err


def test_other_commands_name_the_way(call: Any, table: Path) -> None:
    answer = call("plan", table)
    assert answer.code == 2
    assert "fiveroute convert" in answer.err
