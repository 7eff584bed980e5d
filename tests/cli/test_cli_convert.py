"""From a chart of nodes to a mission, at the command line."""

import json
import zipfile
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
    found = "2 nodes (data 3 in all) in 5.07 by 5.57 km, 1 zone to keep out of"
    assert (answer.code, answer.out, answer.err) == (0, "", f"fiveroute: {target}: {found}\n")
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


def test_a_chart_says_what_was_understood(call: Any, tmp_path: Path) -> None:
    """A column that means nothing to us, here the data, must not be lost in silence."""
    table = tmp_path / "nodes.csv"
    table.write_text("Station;lon;lat;Megabytes\na;10,01;63,05;2\n;;;\n")
    target = tmp_path / "sea.json"
    answer = call("convert", table, "--to", "native", "--output", target, *ENDS, *FLEET)
    assert answer.code == 0
    assert "1 node (each counts 1 as data)" in answer.err
    assert "0 zones" in answer.err


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("route.gpx", '<gpx><rte><rtept lat="63" lon="10"/></rte></gpx>', ("nodes", "waypoint")),
        ("coast.kml", "<kml><LineString/></kml>", ("nodes", "missing")),
        ("nodes.kmz", "PK\x03\x04", ("nodes.kmz: is a damaged zip archive", "copy it again")),
    ],
)
def test_charts_without_nodes_are_refused(
    call: Any, tmp_path: Path, name: str, content: str, words: tuple[str, ...]
) -> None:
    chart = tmp_path / name
    chart.write_text(content)
    answer = call("convert", chart, "--to", "native", "--output", tmp_path / "x", *ENDS, *FLEET)
    assert (answer.code, answer.err.count("\n")) == (2, 1)
    assert all(word in answer.err for word in words)


def test_a_coast_of_lines_keeps_nobody_out(call: Any, table: Path, tmp_path: Path) -> None:
    coast = tmp_path / "coast.kml"
    coast.write_text("<kml><LineString><coordinates>10,63 10.1,63</coordinates></LineString></kml>")
    how = ("--to", "native", "--output", tmp_path / "x", *ENDS, *FLEET, "--zones", coast)
    answer = call("convert", table, *how)
    assert answer.code == 2
    assert "--zones: hold no polygon" in answer.err


def test_an_atoll_in_an_archive_becomes_land_with_a_lagoon(
    call: Any, table: Path, tmp_path: Path
) -> None:
    rings = ("10.2,63 10.3,63 10.3,63.1 10.2,63", "10.25,63.01 10.29,63.01 10.29,63.05 10.25,63.01")
    outer, inner = (f"<LinearRing><coordinates>{r}</coordinates></LinearRing>" for r in rings)
    with zipfile.ZipFile(tmp_path / "atoll.kmz", "w") as archive:
        archive.writestr(
            "doc.kml",
            "<kml><Placemark><ExtendedData><Data name='kind'><value>land</value></Data>"
            f"</ExtendedData><Polygon><outerBoundaryIs>{outer}</outerBoundaryIs>"
            f"<innerBoundaryIs>{inner}</innerBoundaryIs></Polygon></Placemark></kml>",
        )
    target = tmp_path / "sea.json"
    how = ("--to", "native", "--output", target, *ENDS, *FLEET, "--zones", tmp_path / "atoll.kmz")
    answer = call("convert", table, *how)
    assert (answer.code, answer.out) == (0, "")
    assert answer.err.endswith("1 zone to keep out of, cut into 2 without holes\n")
    assert len(json.loads(target.read_text())["ocean"]["land"]) == 2


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
        ((*ENDS, *FLEET, "--depth-rating", "20"), ("node 'a'", "rating of 20 m", "1 of 2")),
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
