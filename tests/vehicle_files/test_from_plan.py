"""What a vehicle gets is what was planned, and never anything unsafe."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import (
    Circle,
    Currents,
    Fleet,
    Instance,
    Node,
    Ocean,
    Point,
    Polygon,
    Service,
    Uniform,
    Vortex,
)
from fiveroute.ocean.obstacles import barriers_of
from fiveroute.paths.legs import track_clearance
from fiveroute.result import Status
from fiveroute.vehicle_files.from_plan import Choices, mission_of
from fiveroute.vehicle_files.mission import Mission
from fiveroute.verdict import judge

ROCK = Circle(500.0, 0.0, 100.0)
BAY = Instance(
    name="bay",
    nodes=(Node("a", 1000.0, 0.0, 1.0, depth=40.0), Node("b", 1000.0, 800.0, 2.0)),
    start=Point(0.0, 0.0),
    destination=Point(0.0, 800.0),
    fleet=Fleet(1, 2.0, 2000.0, depth=15.0, depth_rating=50.0),
    service=Service(10.0, 5.0),
    ocean=Ocean(obstacles=(ROCK,)),
    crs="+proj=aeqd +lat_0=63 +lon_0=10",
)
ROUND = ((0.0, 0.0), (450.0, 120.0), (500.0, 119.5), (550.0, 120.0), (1000.0, 0.0))
PATHS = ((ROUND, ((1000.0, 0.0), (1000.0, 800.0)), ((1000.0, 800.0), (0.0, 800.0))),)


def filed(instance: Instance = BAY, paths: Any = PATHS, **more: Any) -> PlanFile:
    values: dict[str, Any] = {
        "instance": instance,
        "routes": (("a", "b"),),
        "durations": (0.0,) * len(more.get("routes", (0,))),
        "objective": 3.0,
        "status": Status.FEASIBLE,
        "bound": None,
        "method": "by hand",
        "seed": None,
        "version": "",
        "paths": paths,
    }
    plan = PlanFile(**(values | more))
    if "durations" in more or plan.paths is None:
        return plan
    return replace(plan, durations=judge(plan.instance, plan).durations)


def mission(plan: PlanFile, **choices: Any) -> Mission:
    return mission_of(plan, Path(), Choices(**choices))


def refused(plan: PlanFile, *words: str, **choices: Any) -> None:
    with pytest.raises(InputError) as error:
        mission(plan, **choices)
    for word in words:
        assert word in str(error.value)


def test_waypoints_follow_the_path_with_depths_stays_and_times() -> None:
    (vehicle,) = mission(filed()).vehicles
    told = [(p.kind, p.name, p.depth, p.hold) for p in vehicle.waypoints]
    assert told == [
        ("start", "start", 0.0, 0.0),
        ("bend", "", 15.0, 0.0),
        ("bend", "", 15.0, 0.0),
        ("node", "a", 40.0, 15.0),
        ("node", "b", 15.0, 20.0),
        ("destination", "destination", 0.0, 0.0),
    ]
    way = np.hypot(450.0, 120.0) + 50.0  # 2 m/s, half of the length
    assert vehicle.waypoints[3].arrival == pytest.approx(way, abs=0.1)
    assert vehicle.waypoints[4].arrival == pytest.approx(way + 15.0 + 400.0, abs=0.1)
    assert vehicle.waypoints[5].arrival == pytest.approx(way + 35.0 + 900.0, abs=0.1)


def test_positions_are_those_of_the_plane() -> None:
    import pyproj

    plan = mission(filed())
    geod = pyproj.Geod(ellps="WGS84")
    for point in plan.vehicles[0].waypoints:
        azimuth, _, distance = geod.inv(10.0, 63.0, point.place.lon, point.place.lat)
        x, y = distance * np.sin(np.radians(azimuth)), distance * np.cos(np.radians(azimuth))
        assert (x, y) == (pytest.approx(point.x, abs=1e-3), pytest.approx(point.y, abs=1e-3))


def test_a_plan_without_paths_sails_straight() -> None:
    still = replace(BAY, ocean=Ocean())
    points = mission(filed(still, None, durations=(1435.0,))).vehicles[0].waypoints
    assert [p.kind for p in points] == ["start", "node", "node", "destination"]


def test_a_leg_that_would_cut_a_corner_keeps_its_waypoints() -> None:
    hugging = ((0.0, 0.0), (449.0, 101.0), (500.0, 101.2), (551.0, 101.0), (1000.0, 0.0))
    wall = Polygon(((440.0, -100.0), (560.0, -100.0), (560.0, 80.0), (500.0, 101.1), (440.0, 80.0)))
    coast = replace(BAY, ocean=Ocean(land=(wall,)))
    points = mission(filed(coast, ((hugging, *PATHS[0][1:]),))).vehicles[0].waypoints
    assert [(p.x, p.y) for p in points[1:4]] == list(hugging[1:4])


@pytest.mark.parametrize("margin", [0.0, 15.0])
def test_only_the_cape_keeps_many_waypoints(margin: float) -> None:
    """A long wavy way that touches a rock: off the rock it is thinned as if there were none."""
    x = np.arange(0.0, 1001.0, 5.0)
    bow = 100.1 + margin - (x - 500.0) ** 2 / 600.0
    wavy = np.column_stack((x, np.maximum(bow, 3.0 * np.sin(x / 20.0))))
    wavy[[0, -1]] = (0.0, 0.0), (1000.0, 0.0)
    sea = replace(BAY, ocean=Ocean(obstacles=(ROCK,), margin=margin))
    plan = filed(sea, ((tuple(map(tuple, wavy.tolist())), *PATHS[0][1:]),))
    points = mission(plan, tolerance=20.0).vehicles[0].waypoints
    leg = np.array([(p.x, p.y) for p in points[: [p.kind for p in points].index("node") + 1]])
    far = np.abs(leg[:, 0] - 500.0) > 100.0
    assert far.sum() <= 6
    assert far.sum() < len(leg) <= 20
    barriers = barriers_of(sea.ocean, margin=margin)
    assert track_clearance(barriers, leg) >= min(0.0, track_clearance(barriers, wavy))


def test_an_auv_that_would_come_home_too_late_keeps_its_waypoints() -> None:
    """The vortex carries it along the bow, and holds it back on the chord."""
    vortex = Currents(vortices=(Vortex(500.0, 300.0, -2500.0, 150.0),))
    angles = np.linspace(np.pi, 0.0, 19)
    bow = np.column_stack((500.0 + 500.0 * np.cos(angles), 480.0 * np.sin(angles)))
    bow[[0, -1]] = (0.0, 0.0), (1000.0, 0.0)
    sea = replace(BAY, ocean=Ocean(vortex), nodes=BAY.nodes[:1], destination=Point(1000.0, 0.0))
    paths = ((tuple(map(tuple, bow.tolist())), ((1000.0, 0.0), (1000.0, 0.0))),)
    plan = filed(sea, paths, routes=(("a",),), objective=1.0)
    assert len(mission(plan, tolerance=1000.0).vehicles[0].waypoints) == 3
    slow = mission(plan, tolerance=1000.0).vehicles[0].waypoints[-1].arrival
    assert slow > plan.durations[0] + 1.0
    tight = replace(sea, fleet=replace(sea.fleet, endurance=plan.durations[0] + 1.0))
    kept = mission(replace(plan, instance=tight), tolerance=1000.0).vehicles[0].waypoints
    assert len(kept) == 20
    assert kept[-1].arrival == pytest.approx(plan.durations[0], abs=0.5)


def test_unsafe_plans_are_refused() -> None:
    straight = ((0.0, 0.0), (1000.0, 0.0))
    refused(filed(paths=((straight, *PATHS[0][1:]),)), "'a'", "200.0 m", "obstacle")
    refused(filed(paths=None), "obstacle")
    island = Ocean(land=(Polygon(((900.0, 300.0), (1100.0, 300.0), (1000.0, 500.0))),))
    refused(filed(replace(BAY, ocean=island)), "'b'", "land")
    refused(filed(replace(BAY, fleet=replace(BAY.fleet, endurance=1000.0))), "AUV 1", "endurance")
    refused(filed(routes=(("a", "b", "a"),), paths=None), "unsafe")
    refused(filed(routes=(("a", "b"), ()), durations=(1.0, 1.0), paths=None), "unsafe")
    strong = Ocean(currents=Currents(uniform=Uniform(0.0, 3.0)))
    refused(filed(replace(BAY, ocean=strong)), "current is too strong")
    refused(filed(paths=(PATHS[0][:2],), durations=(1.0,)), "legs are missing")
    refused(filed(durations=(1000.0,)), "AUV 1", "more than it takes")
    refused(filed(objective=4.0), "+1 data more")


def test_depths_beyond_the_rating_are_refused() -> None:
    refused(filed(), "depth", "60", "50 m", depth=60.0)
    deep = replace(BAY, nodes=(replace(BAY.nodes[0], depth=50.5), BAY.nodes[1]))
    refused(filed(deep), "depth at a", "50.5", "50 m")
    unrated = replace(deep, fleet=replace(BAY.fleet, depth_rating=None))
    assert mission(filed(unrated)).vehicles[0].waypoints[3].depth == 50.5


def test_what_the_plan_leaves_open_must_be_told() -> None:
    nowhere = replace(BAY, crs=None, fleet=replace(BAY.fleet, depth=None))
    refused(filed(nowhere), "crs", "--origin", depth=5.0)
    refused(filed(nowhere), "depth", "--depth", origin=(10.0, 63.0))
    told = mission(filed(nowhere), depth=5.0, origin=(10.0, 63.0))
    assert told.vehicles[0].waypoints[1].depth == 5.0
    refused(filed(), "--origin", "contradicts", origin=(11.0, 63.0))
    refused(filed(replace(BAY, metric="EUC_2D")), "metric")


def test_vehicles_are_chosen_and_named() -> None:
    two = filed(
        replace(BAY, fleet=replace(BAY.fleet, size=2)),
        (*PATHS, (((0.0, 0.0), (0.0, 800.0)),)),
        routes=(("a", "b"), ()),
    )
    assert [v.name for v in mission(two).vehicles] == ["auv-1", "auv-2"]
    only = mission(two, auv=2, names=("north", "south.1"))
    assert [(v.name, len(v.waypoints)) for v in only.vehicles] == [("south.1", 2)]
    assert [node.vehicle for node in only.nodes] == ["north", "north"]
    refused(two, "--auv", "3", "2", auv=3)
    refused(two, "--vehicle", "2 times", names=("one",))
    for names in (("a b", "c"), ("../x", "c"), ("x", "x"), ("", "c"), (".hidden", "c")):
        refused(two, "--vehicle", names=names)


def test_strangers_on_a_route_are_refused() -> None:
    refused(filed(routes=(("a", "ghost"),)), "ghost")


@pytest.mark.parametrize(
    "departure",
    [
        datetime(999, 1, 1),
        datetime(9999, 12, 31),
        datetime(1, 1, 1, tzinfo=timezone(timedelta(hours=14))),
    ],
)
def test_departures_have_a_year_of_four_digits(departure: datetime) -> None:
    refused(filed(), "departure", departure=departure)


def test_zones_and_departure_come_along() -> None:
    coast = Polygon(((5000.0, 0.0), (5000.0, 900.0), (6000.0, 0.0)))
    sea = replace(
        BAY,
        ocean=Ocean(Currents(begin="2026-06-01T06:00"), obstacles=(ROCK,), land=(coast,)),
    )
    plan = mission(filed(sea))
    assert plan.moment(90.0) == "2026-06-01T06:01:30Z"
    assert [zone.kind for zone in plan.zones] == ["obstacle", "land"]
    assert plan.zones[0].radius == 100.0
    lon, lat = np.array([(c.lon, c.lat) for c in plan.zones[1].corners]).T
    assert lon @ np.roll(lat, -1) - lat @ np.roll(lon, -1) > 0.0
    later = mission(filed(sea), departure=datetime(2027, 1, 1))
    assert later.moment(0.0) == "2027-01-01T00:00:00Z"
    with pytest.raises(InputError, match="beyond the calendar"):
        later.moment(1e12)
    assert mission(filed()).moment(0.0) is None
