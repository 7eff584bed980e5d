"""Any plan, read again by programs that are not ours: count, order, position, depth.

Positions come back within 0.1 m (0.15 m from the Slocum's minutes, of which 0.0001 is 0.19 m), in
their order, with depths of the right sign.
"""

from __future__ import annotations

import csv
import io
import itertools
import json
import re
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import gpxpy
import numpy as np
import pyproj
import pytest
import shapely.geometry
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Circle, Fleet, Instance, Node, Ocean, Point
from fiveroute.result import Status
from fiveroute.vehicle_files import VEHICLE_FORMATS, Choices
from fiveroute.vehicle_files.from_plan import mission_of
from fiveroute.vehicle_files.mission import Mission, Vehicle, Waypoint
from fiveroute.verdict import judge

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import fastkml
    from pymavlink import mavwp

GEOD = pyproj.Geod(ellps="WGS84")
FEW = settings(
    deadline=None,
    max_examples=12,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
HOSTILE = [
    "=cmd|' /C calc'!A0",
    "]]><script>alert(1)</script>&amp;",
    'quo"te, comma; tab\tend',
    "line\nbreak }\nBehavior = BHV_Evil {",
    "# hash // slash\r\n<end:waypoints>",
    "-5",
    "'apostrophe",
    "नोड 🛰 \u202e\u0007",
    "long " * 200,
    "../../etc/passwd",
]
METRES = st.floats(-9000.0, 9000.0)
LATITUDES = st.floats(-75.0, 75.0)
LONGITUDES = st.floats(-180.0, -1.0) | st.floats(1.0, 180.0) | st.just(180.0)  # ArduSub: not 0, 0
DEPTHS = st.none() | st.floats(0.0, 150.0)
NAMES = st.sampled_from(HOSTILE) | st.text(
    st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12
)


@st.composite
def missions(draw: st.DrawFn) -> Mission:
    """The mission of a random plan that sails crooked ways between random nodes."""
    names = draw(st.lists(NAMES, min_size=1, max_size=7, unique=True))
    nodes = tuple(
        Node(name, draw(METRES), draw(METRES), 1.0, draw(st.floats(0.0, 900.0)), draw(DEPTHS))
        for name in names
    )
    instance = Instance(
        name=draw(NAMES),
        nodes=nodes,
        start=Point(draw(METRES), draw(METRES)),
        destination=Point(draw(METRES), draw(METRES)),
        fleet=Fleet(2, draw(st.floats(0.3, 3.0)), None, depth=draw(st.floats(0.0, 150.0))),
        ocean=Ocean(obstacles=(Circle(1e5, 1e5, 50.0),)),
        crs=f"+proj=aeqd +lat_0={draw(LATITUDES):.4f} +lon_0={draw(LONGITUDES):.4f}",
    )
    cut = draw(st.integers(0, len(nodes)))
    routes = (tuple(range(1, cut + 1)), tuple(range(cut + 1, len(nodes) + 1)))
    points, last = instance.points, len(nodes) + 1
    paths = tuple(
        tuple(
            (tuple(points[tail]), (draw(METRES), draw(METRES)), tuple(points[head]))
            for tail, head in itertools.pairwise((0, *route, last))
        )
        for route in routes
    )
    filed = PlanFile(
        instance=instance,
        routes=tuple(tuple(nodes[k - 1].id for k in route) for route in routes),
        durations=(0.0, 0.0),
        objective=float(len(nodes)),
        status=Status.FEASIBLE,
        bound=None,
        method="by hand",
        seed=None,
        version="",
        paths=paths,
    )
    filed = replace(filed, durations=judge(instance, filed).durations)
    return mission_of(filed, Path(), Choices())


Seen = list[tuple[float, float, float]]
"""Longitude, latitude and depth of waypoints."""


def assert_same(seen: Seen, points: tuple[Waypoint, ...], metres: float = 0.1) -> None:
    assert len(seen) == len(points)
    for (lon, lat, depth), point in zip(seen, points, strict=True):
        *_, away = GEOD.inv(lon, lat, point.place.lon, point.place.lat)
        assert away < metres
        assert depth == pytest.approx(point.depth, abs=0.11)  # ArduSub's surface is at 0.1 m


def written(name: str, mission: Mission) -> dict[str, str]:
    known = VEHICLE_FORMATS[name]
    files = known.write(mission)
    known.check(files)
    return files


def moved(vehicle: Vehicle) -> tuple[Waypoint, ...]:
    return vehicle.waypoints[1:]


@FEW
@given(mission=missions())
def test_pymavlink_loads_waypoint_lists(mission: Mission, tmp_path: Path) -> None:
    for vehicle, text in zip(mission.vehicles, written("wpl", mission).values(), strict=True):
        path = tmp_path / "auv.waypoints"
        path.write_text(text)
        loader = mavwp.MAVWPLoader()
        loader.load(str(path))
        items = [loader.wp(k) for k in range(loader.count())]
        assert [item.command for item in items[:2]] == [16, 178]
        assert_same([(w.y, w.x, -w.z) for w in items[2:]], moved(vehicle))
        assert all(w.param1 >= p.hold for w, p in zip(items[2:], moved(vehicle), strict=True))
        assert_same([(items[0].y, items[0].x, 0.0)], vehicle.waypoints[:1])


@FEW
@given(mission=missions())
def test_plans_of_qgroundcontrol_are_json(mission: Mission) -> None:
    for vehicle, text in zip(mission.vehicles, written("qgc", mission).values(), strict=True):
        items = json.loads(text)["mission"]["items"][1:]
        places = [item["params"][4:] for item in items]
        assert_same([(lon, lat, -altitude) for lat, lon, altitude in places], moved(vehicle))
        assert all(altitude <= -0.1 for *_, altitude in places)


@FEW
@given(mission=missions())
def test_gpxpy_reads_gpx(mission: Mission) -> None:
    (text,) = written("gpx", mission).values()
    chart = gpxpy.parse(text)
    assert len(chart.waypoints) == len(mission.nodes)
    for vehicle, route in zip(mission.vehicles, chart.routes, strict=True):
        assert_same(
            [(p.longitude, p.latitude, -(p.elevation or 0.0)) for p in route.points],
            vehicle.waypoints,
        )


@FEW
@given(mission=missions())
def test_fastkml_reads_kml(mission: Mission) -> None:
    (text,) = written("kml", mission).values()
    document: Any = fastkml.KML.from_string(text.partition("\n")[2]).features[0]
    for vehicle, folder in zip(mission.vehicles, document.features, strict=False):
        line = folder.features[0].kml_geometry.kml_coordinates
        assert_same([(lon, lat, -z) for lon, lat, z in line.coords], vehicle.waypoints)
    points = document.features[-2].features
    assert len(points) == len(mission.nodes) + 2


@FEW
@given(mission=missions())
def test_shapely_reads_geojson(mission: Mission) -> None:
    (text,) = written("geojson", mission).values()
    features = json.loads(text)["features"]
    for vehicle, feature in zip(mission.vehicles, features, strict=False):
        shape = shapely.geometry.shape(feature["geometry"])
        parts = [list(part.coords) for part in getattr(shape, "geoms", [shape])]
        for before, after in itertools.pairwise(parts):
            (lon, *spot), (other, *same) = before.pop(), after.pop(0)
            assert (abs(lon), spot) == (180.0, same)
            assert lon == -other
        seen = [(lon, lat, -z) for part in parts for lon, lat, z in part]
        assert_same(seen, vehicle.waypoints)
    names = {f["properties"].get("name") for f in features if f["properties"]["kind"] == "node"}
    assert names == {node.name for node in mission.nodes}


@FEW
@given(mission=missions())
def test_tables_keep_rows_and_names(mission: Mission) -> None:
    (text,) = written("csv", mission).values()
    rows = list(csv.DictReader(io.StringIO(text, newline="")))
    for vehicle in mission.vehicles:
        own = [row for row in rows if row["auv"] == vehicle.name]
        places = [(float(r["longitude"]), float(r["latitude"]), float(r["depth"])) for r in own]
        assert_same(places, vehicle.waypoints)
        for row, point in zip(own, vehicle.waypoints, strict=True):
            assert row["id"] in (point.name, f"'{point.name}")
            assert row["id"][:1] not in ("=", "+", "-", "@", "\t", "\r")


@FEW
@given(mission=missions())
def test_missions_of_neptus_are_chains(mission: Mission) -> None:
    files = written("neptus", mission)
    plans = ElementTree.fromstring(files["mission.nmis"]).findall("body/plan")
    for vehicle, plan in zip(mission.vehicles, plans, strict=True):
        gotos = plan.findall(".//Goto//point")
        assert_same([_neptus_place(point) for point in gotos], vehicle.waypoints)
        stays = plan.findall(".//StationKeeping")
        holds = [point.hold for point in vehicle.waypoints if point.hold]
        assert all(int(s.findtext("duration", "")) >= h for s, h in zip(stays, holds, strict=True))
    marks = ElementTree.fromstring(files["maps/map.nmap"]).findall("features/mark")
    assert len(marks) == len(mission.nodes)


def _neptus_place(point: ElementTree.Element) -> tuple[float, float, float]:
    return (
        float(point.findtext("coordinate/longitude", "")),
        float(point.findtext("coordinate/latitude", "")),
        float(point.findtext("z", "")),
    )


@FEW
@given(mission=missions())
def test_missions_of_cola2_are_xml(mission: Mission) -> None:
    for vehicle, text in zip(mission.vehicles, written("cola2", mission).values(), strict=True):
        steps = ElementTree.fromstring(text).findall("mission_step/maneuver[@type='goto']")
        tags = ("final_longitude", "final_latitude", "final_depth")
        seen = [tuple(float(step.findtext(tag, "")) for tag in tags) for step in steps]
        assert_same(seen, moved(vehicle))  # type: ignore[arg-type]


def _minutes(text: str) -> float:
    value = abs(float(text))
    return float(np.copysign(value // 100.0 + value % 100.0 / 60.0, float(text)))


@FEW
@given(mission=missions())
def test_files_of_the_slocum_follow_each_other(mission: Mission) -> None:
    files = written("slocum", mission)
    for vehicle in mission.vehicles:
        own = [text for name, text in files.items() if name.startswith(f"{vehicle.name}/")]
        lists = [_between(text, "<start:waypoints>", "<end:waypoints>") for text in own]
        assert all(len(rows) <= 7 for rows in lists)
        places = [(_minutes(lon), _minutes(lat)) for rows in lists for lon, lat in rows]
        depths = [point.depth for point in moved(vehicle)]  # the format has no place for them
        seen = [(*place, depth) for place, depth in zip(places, depths, strict=True)]
        assert_same(seen, moved(vehicle), 0.15)


def _between(text: str, begin: str, end: str) -> list[list[str]]:
    inside = re.search(rf"^{begin}\n(.*?)^{end}$", text, re.MULTILINE | re.DOTALL)
    assert inside
    lines = [line.partition("#")[0].split() for line in inside[1].splitlines()]
    return [line for line in lines if line]


@FEW
@given(mission=missions())
def test_stages_of_moos_lead_along_the_way(mission: Mission) -> None:
    files = written("moos", mission)
    zone = min(int((mission.origin.lon + 180.0) // 6.0), 59) + 1
    grid = pyproj.Proj(proj="utm", zone=zone, datum="WGS84")
    east, north = grid(mission.origin.lon, mission.origin.lat)
    for vehicle in mission.vehicles:
        text = files[f"{vehicle.name}.bhv"]
        assert "BHV_Evil" not in re.sub("(?m)^//.*$", "", text)
        blocks = re.findall(r"^  (points|depth) = (.*)$", text, re.MULTILINE)
        stays = re.findall(r"^  station_pt = (.*)$", text, re.MULTILINE)
        assert len(stays) == sum(point.hold > 0.0 for point in vehicle.waypoints)
        seen: Seen = []
        for (kind, value), (_, depth) in itertools.pairwise(blocks):
            if kind == "points":
                for spot in value.split(" : "):
                    x, y = map(float, spot.split(","))
                    lon, lat = grid(east + x, north + y, inverse=True)
                    seen.append((lon, lat, float(depth)))
        assert_same(seen, moved(vehicle))


def test_imc_bytes_of_a_mission_come_back(mission: Mission) -> None:
    """The places that Neptus would send to a vehicle, through the protocol it speaks."""
    imcpy: Any = pytest.importorskip("imcpy")
    plan = ElementTree.fromstring(written("neptus", mission)["mission.nmis"]).findall("body/plan")
    for vehicle, document in zip(mission.vehicles, plan, strict=True):
        for place, point in zip(
            map(_neptus_place, document.findall(".//Goto//point")), vehicle.waypoints, strict=True
        ):
            goto = imcpy.Goto()
            goto.lon, goto.lat = np.radians(place[:2])
            goto.z = place[2]
            back = imcpy.Packet.deserialize(imcpy.Packet.serialize(goto))
            assert_same([(*np.degrees([back.lon, back.lat]), back.z)], (point,))


@pytest.mark.parametrize("name", VEHICLE_FORMATS)
def test_the_same_mission_gives_the_same_files(name: str, mission: Mission) -> None:
    assert written(name, mission) == written(name, mission)
