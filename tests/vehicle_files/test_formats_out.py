"""The rules of each format: what is written keeps them, and the checker sees it when not."""

from __future__ import annotations

import csv
import io
import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from fiveroute.errors import InputError
from fiveroute.vehicle_files import (
    VEHICLE_FORMATS,
    cola2,
    csv_table,
    geojson,
    gpx,
    kml,
    moos,
    neptus,
    qgroundcontrol,
    slocum,
    waypoint_list,
)
from fiveroute.vehicle_files.mission import Mission, Position

BROKEN = [
    ("qgc", '"fileType": "Plan"', '"fileType": "Mission"', "plan of version 1"),
    ("qgc", '"vehicleType": 12', '"vehicleType": 2', "ArduSub"),
    ("qgc", '"doJumpId": 3', '"doJumpId": 4', "numbered"),
    ("qgc", "-20.0\n    ]", "20.0\n    ]", "altitude"),
    ("qgc", '"frame": 3', '"frame": 0', "frame"),
    ("wpl", "QGC WPL 110", "QGC WPL 120", "QGC WPL 110"),
    ("wpl", "\t1\n", "\n", "12 columns"),
    ("wpl", "\n2\t", "\n3\t", "numbered"),
    ("wpl", "-20.000", "0.000", "altitude"),
    ("wpl", "0\t1\t0\t16", "0\t1\t3\t16", "home"),
    ("neptus", 'start="false"', 'start="true"', "first node"),
    ("neptus", "<target>Goto2</target>", "<target>Goto3</target>", "edges"),
    ("neptus", "ManeuverIsDone", "Never", "manoeuvre"),
    ("neptus", "DEPTH", "ALTITUDE", "depths"),
    ("neptus", "<z>20.000</z>", "<z>-20.000</z>", "positive down"),
    ("neptus", "<duration>31</duration>", "<duration>0</duration>", "65535"),
    ("neptus", '<plan id="auv-2"', '<plan id="auv-1"', "ids of their own"),
    ("neptus", "maps/map.nmap", "map.nmap", "name its map"),
    ("moos", "Behavior = BHV_ConstantDepth", "Behavior = BHV_Timer", "depth behaviour"),
    ("moos", "endflag = STAGE = 2", "endflag = STAGE = 3", "next one"),
    ("moos", "condition = STAGE = 2", "condition = STAGE = 1", "follow each other"),
    ("moos", "depth = 20", "depth = -20", "positive down"),
    ("moos", "LatOrigin", "Latitude", "origin"),
    ("slocum", "behavior_name=goto_list", "behavior_name=yo", "goto_list"),
    ("slocum", "100  #", "5  #", "10 m"),
    ("slocum", "6300.0000", "6360.0000", "below 60"),
    ("slocum", "6300.0000", "9100.0000", "not on Earth"),
    ("slocum", "<start:waypoints>", "<start:waypoints>\n 1.0 2.0", "count"),
    ("slocum", "<start:waypoints>", "<start:waypoints>" + "\n 1.0 2.0" * 8, "1 to 7"),
    ("cola2", "tolerance_xy>", "tolerance>", "all tags"),
    ("cola2", "<final_depth>20.000", "<final_depth>-20.000", "positive down"),
    ("cola2", "<surge_velocity>1.250", "<surge_velocity>0.000", "above 0"),
    ("cola2", "<time>31", "<time>0", "some time"),
    ("cola2", "<final_latitude>63", "<final_latitude>163", "not on Earth"),
    ("gpx", 'version="1.1"', 'version="1.0"', "GPX 1.1"),
    ("gpx", "<ele>-35.500", "<ele>35.500", "below the surface"),
    ("gpx", 'lon="10.0', 'lon="210.0', "not on Earth"),
    ("gpx", "<ele>-20.000</ele>", "<name>x</name><ele>-20.000</ele>", "order"),
    ("kml", ",-20.000", ",20.000", "below the surface"),
    ("kml", "10.01000000,63", "10.01000000,163", "not on Earth"),
    ("kml", "<when>2026-06-01T06:11:40Z</when>", "", "its time"),
    ("geojson", "-35.5]", "35.5]", "below the surface"),
    ("geojson", "[10.01, 63.005", "[190.0, 63.005", "not on Earth"),
    ("geojson", "[10.01, 63.005", "[-179.0, 63.005", "not on Earth|180th"),
    ("csv", "auv,number", "number,auv", "names of its columns"),
    ("csv", ",20.000,", ",-20.000,", "positive down"),
    ("csv", ",node,a,", ",node,=a,", "formula"),
    ("csv", ",node,a,", ",node,a,b,", "all columns"),
]


@pytest.mark.parametrize(("name", "old", "new", "words"), BROKEN)
def test_checkers_see_what_is_broken(
    mission: Mission, name: str, old: str, new: str, words: str
) -> None:
    files = VEHICLE_FORMATS[name].write(mission)
    VEHICLE_FORMATS[name].check(files)
    broken = {path: text.replace(old, new) for path, text in files.items()}
    assert broken != files
    with pytest.raises(InputError, match=words):
        VEHICLE_FORMATS[name].check(broken)


def test_zones_are_a_fence_of_qgroundcontrol(mission: Mission) -> None:
    fence = json.loads(qgroundcontrol.write(mission)["auv-1.plan"])["geoFence"]
    (circle,), (polygon,) = fence["circles"], fence["polygons"]
    assert (circle["inclusion"], circle["circle"]["radius"]) == (False, 300.0)
    assert circle["circle"]["center"] == [63.1, 10.1]
    assert (polygon["inclusion"], polygon["polygon"][0]) == (False, [63.1, 9.9])


def test_home_is_the_surface_at_the_start(mission: Mission) -> None:
    plan = json.loads(qgroundcontrol.write(mission)["auv-1.plan"])
    assert plan["mission"]["plannedHomePosition"] == [63.0, 10.0, 0]
    home = waypoint_list.write(mission)["auv-1.waypoints"].splitlines()[1].split("\t")
    assert [float(cell) for cell in home[8:11]] == [63.0, 10.0, 0.0]


def test_minutes_of_the_slocum_are_carried(mission: Mission) -> None:
    """59.99999 minutes are the next degree; west and south are negative, longitude first."""
    edge = Position(-73.8083333333, -0.9999999999)
    points = mission.vehicles[0].waypoints
    vehicle = replace(mission.vehicles[0], waypoints=(points[0], replace(points[1], place=edge)))
    text = slocum.write(replace(mission, vehicles=(vehicle,)))["auv-1/goto_l10.ma"]
    row = text.partition("# LON        LAT\n")[2].splitlines()[0].split()
    assert row[:2] == ["-7348.5000", "-100.0000"]


def test_long_missions_of_the_slocum_go_on_in_the_next_file(mission: Mission) -> None:
    points = mission.vehicles[0].waypoints
    long = replace(mission.vehicles[0], waypoints=(points[0], *[points[1]] * 15))
    files = slocum.write(replace(mission, vehicles=(long,)))
    assert list(files) == [f"auv-1/goto_l{n}.ma" for n in (10, 11, 12)]
    counts = [re.search(r"num_waypoints\(nodim\) +(\d+)", text) for text in files.values()]
    assert [found and found[1] for found in counts] == ["7", "7", "1"]
    endless = replace(long, waypoints=(points[0], *[points[1]] * 631))
    with pytest.raises(InputError, match="--tolerance"):
        slocum.write(replace(mission, vehicles=(endless,)))


def test_a_stay_of_moos_begins_at_the_node(mission: Mission) -> None:
    """Its clock runs as soon as its stage does, so that the way there is another stage."""
    text = moos.write(mission)["auv-1.bhv"]
    kinds = [line.partition(" = ")[2] for line in text.splitlines() if line.startswith("Behavior")]
    depth = "BHV_ConstantDepth"
    way, stay = ["BHV_Waypoint", depth], ["BHV_StationKeep", depth]
    assert kinds == [*way, *way, *stay, *way, *way, "BHV_MaxDepth"]
    assert "  duration = 31\n  duration_idle_decay = false\n" in text
    assert "  max_depth = 100\n" in text
    assert text.count("DEPLOY = false") == 2


def test_moos_measures_along_the_grid_of_its_zone() -> None:
    """Well off the zone's central meridian its north is two degrees off ours."""
    origin = Position(5.9, 63.0)
    (x, y), (east, north) = moos.utm_metres([Position(5.9, 63.09), Position(5.9, 63.0)], origin)
    assert (east, north) == (0.0, 0.0)
    assert y == pytest.approx(10_030.0, abs=20.0)
    assert x == pytest.approx(
        -10_030.0 * 0.0451, rel=0.02
    )  # 2.9 degrees off the meridian, times sin 63


def test_neptus_says_its_home_in_minutes_and_seconds(mission: Mission) -> None:
    west = replace(mission, origin=Position(-9.1785, 38.245869444))
    root = ElementTree.fromstring(neptus.write(west)["mission.nmis"])
    origin = root.find("definitions/home-reference/origin")
    assert origin is not None
    assert origin.findtext("latitude") == "38N14'45.1300''"
    assert origin.findtext("longitude") == "9W10'42.6000''"


def test_missions_of_cola2_park_after_they_arrive(mission: Mission) -> None:
    steps = ElementTree.fromstring(cola2.write(mission)["auv-1.xml"]).iter("maneuver")
    assert [step.attrib["type"] for step in steps] == ["goto", "goto", "park", "goto", "goto"]


def test_times_are_written_where_the_departure_is_known(mission: Mission) -> None:
    timeless = replace(mission, departure=None)
    assert "2026-06-01T06:23:20Z" in gpx.write(mission)["mission.gpx"]
    assert "<time>" not in gpx.write(timeless)["mission.gpx"]
    track = kml.write(mission)["mission.kml"]
    assert "2026-06-01T06:23:20Z" in track
    assert "2026-06-01T06:23:50Z" in track  # it leaves the node 30 s later
    assert "gx:Track" not in kml.write(timeless)["mission.kml"]
    arrivals = json.loads(geojson.write(timeless)["mission.geojson"])["features"][0]["properties"]
    assert arrivals["arrivals"] == [0.0, 700.0, 1400.0, 2000.0, 2600.0]


def test_lines_of_geojson_are_cut_at_the_180th_meridian(mission: Mission) -> None:
    points = mission.vehicles[0].waypoints
    ends = Position(179.9, 10.0), Position(-179.7, 14.0)
    way = tuple(replace(p, place=e) for p, e in zip(points[:2], ends, strict=True))
    vehicle = replace(mission.vehicles[0], waypoints=way)
    files = geojson.write(replace(mission, vehicles=(vehicle,)))
    geojson.check(files)
    geometry = json.loads(files["mission.geojson"])["features"][0]["geometry"]
    assert geometry["type"] == "MultiLineString"
    (_, east), (west, _) = geometry["coordinates"]
    assert east == [180.0, pytest.approx(11.0), pytest.approx(-5.0)]
    assert west == [-180.0, pytest.approx(11.0), pytest.approx(-5.0)]


def test_rows_of_the_table_have_numbers_and_times(mission: Mission) -> None:
    text = csv_table.write(mission)["mission.csv"]
    rows = list(csv.DictReader(io.StringIO(text)))
    assert len(rows) == 7
    node = rows[2]
    assert (node["auv"], node["number"], node["kind"], node["id"]) == ("auv-1", "2", "node", "a")
    assert (node["depth"], node["service_time"], node["arrival"]) == ("35.500", "30.200", "1400.0")
    assert node["time"] == "2026-06-01T06:23:20Z"
