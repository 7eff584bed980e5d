"""From a chart of nodes to a mission: what a chart says, what it does not, and where it lies."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pyproj
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats import native
from fiveroute.formats.survey import Area, Site, Survey, Terms
from fiveroute.instance import Circle, Polygon
from fiveroute.ocean.barriers import clearance, leg_clearance
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.obstacles import barriers_of

TERMS = Terms(start=(10.0, 63.0), destination=(10.1, 63.0), speed=1.5, endurance=3600.0)
CHART = Survey(
    True,
    (Site("a", (10.0, 63.05), 2.0, 60.0, 30.0), Site("", (10.05, 63.02))),
    (
        Area("land", ((10.2, 63.0), (10.3, 63.0), (10.3, 63.1))),
        Area("obstacle", ((10.02, 63.0),), 250.0),
    ),
)


def test_a_chart_becomes_a_mission() -> None:
    mission = CHART.instance("bay", replace(TERMS, fleet_size=3, depth=5.0, depth_rating=90.0))
    first, second = mission.nodes
    assert (first.id, first.data, first.service_time, first.depth) == ("a", 2.0, 60.0, 30.0)
    assert (second.id, second.data, second.service_time, second.depth) == ("2", 1.0, None, None)
    fleet = mission.fleet
    assert (fleet.size, fleet.speed, fleet.endurance, fleet.depth) == (3, 1.5, 3600.0, 5.0)
    assert fleet.depth_rating == 90.0
    circle, (land,) = mission.ocean.obstacles[0], mission.ocean.land
    assert isinstance(circle, Circle)
    assert circle.radius == 250.0
    assert isinstance(land, Polygon)
    assert native.read(native.write(mission), "") == mission


@settings(deadline=None, max_examples=30)
@given(
    st.floats(-180.0, 180.0),
    st.floats(-80.0, 80.0),
    st.lists(st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)), min_size=1, max_size=6),
)
def test_distances_are_those_on_earth(
    lon: float, lat: float, offsets: list[tuple[float, float]]
) -> None:
    """On either side of the 180th meridian too."""
    spots = [((lon + east + 180.0) % 360.0 - 180.0, lat + north) for east, north in offsets]
    chart = Survey(True, tuple(Site("", spot) for spot in spots))
    mission = chart.instance("x", replace(TERMS, start=(lon, lat), destination=(lon, lat)))
    points = mission.points
    for k, spot in enumerate(spots, start=1):
        *_, metres = pyproj.Geod(ellps="WGS84").inv(lon, lat, *spot)
        assert np.hypot(*(points[k] - points[0])) == pytest.approx(metres, rel=1e-3, abs=0.01)
    assert mission.origin is not None


def test_points_of_these_names_are_the_ends() -> None:
    chart = Survey(
        True,
        (
            Site("Start", (10.0, 63.0), end="start"),
            Site("a", (10.0, 63.1)),
            Site("destination", (10.2, 63.0), end="destination"),
        ),
    )
    terms = replace(TERMS, start=None, destination=None)
    mission = chart.instance("x", terms)
    assert [node.id for node in mission.nodes] == ["a"]
    assert mission.start.x < mission.destination.x
    moved = chart.instance("x", replace(terms, start=(10.2, 63.0)))
    assert moved.start == moved.destination


@pytest.mark.parametrize(
    ("missing", "words"),
    [
        ("start", ("--start", "LON,LAT", "released")),
        ("destination", ("--destination", "recovered")),
        ("speed", ("--speed", "m/s")),
        ("endurance", ("--endurance", "seconds")),
    ],
)
def test_what_is_missing_is_asked_for(missing: str, words: tuple[str, ...]) -> None:
    terms: Any = {missing: None}
    with pytest.raises(InputError) as error:
        CHART.instance("x", replace(TERMS, **terms))
    assert all(word in str(error.value) for word in words)


def test_local_metres_stay_as_they_are() -> None:
    chart = Survey(False, (Site("a", (100.0, 200.0)),))
    mission = chart.instance("x", replace(TERMS, start=(0.0, 0.0), destination=(1e6, 0.0)))
    assert mission.crs is None
    assert mission.points.tolist() == [[0.0, 0.0], [100.0, 200.0], [1e6, 0.0]]


def test_zones_of_another_chart_join() -> None:
    nodes = replace(CHART, areas=())
    mission = nodes.instance("x", TERMS, zones=CHART)
    assert len(mission.ocean.obstacles) == len(mission.ocean.land) == 1
    with pytest.raises(InputError, match="one kind"):
        replace(nodes, geographic=False).instance("x", TERMS, zones=CHART)


@pytest.mark.parametrize("spot", [(63.0, 10.0), (10.0, -63.0), (-170.0, 63.0)])
def test_points_far_off_are_refused(spot: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="longitude first"):
        replace(CHART, sites=(*CHART.sites, Site("far", spot))).instance("x", TERMS)


@pytest.mark.parametrize("start", [(400.0, 0.0), (10.0, 91.0)])
def test_ends_must_be_on_earth(start: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="--start"):
        CHART.instance("x", replace(TERMS, start=start))


def test_ends_at_several_places_must_be_told_apart() -> None:
    twice = [Site("start", (10.0, 63.0), end="start"), Site("start", (10.1, 63.0), end="start")]
    chart = replace(CHART, sites=(*CHART.sites, *twice))
    with pytest.raises(InputError, match="several places; pass --start"):
        chart.instance("x", replace(TERMS, start=None))
    same = replace(CHART, sites=(*CHART.sites, twice[0], twice[0]))
    assert same.instance("x", replace(TERMS, start=None)) == CHART.instance("x", TERMS)


ISLAND = ((10.2, 63.0), (10.3, 63.0), (10.3, 63.1), (10.2, 63.1))
LAGOON = ((10.22, 63.02), (10.24, 63.08), (10.28, 63.05))


def land(*rings: tuple[tuple[float, float], ...], stop: tuple[float, float] = (10.0, 63.0)) -> Any:
    """Land of one polygon, its holes after its rim, and the barriers around a mission."""
    zones = Survey(True, (), (Area("land", rings[0], holes=rings[1:], where="placemark 7"),))
    chart = Survey(True, (Site("a", stop),))
    mission = chart.instance("x", replace(TERMS, start=stop, destination=stop), zones)
    return barriers_of(mission.ocean), LocalPlane(*_origin(mission.crs))


def _origin(crs: str | None) -> tuple[float, float]:
    words = dict(word.split("=") for word in (crs or "").split())
    return float(words["+lon_0"]), float(words["+lat_0"])


def clear(of: Any, lon: float, lat: float) -> float:
    barriers, plane = of
    x, y = plane.project(np.array([lon]), np.array([lat]))
    return clearance(barriers, float(x[0]), float(y[0]))


@pytest.mark.parametrize("turn", [1, -1])
@pytest.mark.parametrize("hole_turn", [1, -1])
def test_a_lagoon_is_water(turn: int, hole_turn: int) -> None:
    """Whatever the sense of rotation; corners that are repeated count once."""
    coast = land((*ISLAND[::turn], ISLAND[::turn][-1]), LAGOON[::hole_turn])
    assert clear(coast, 10.245, 63.05) > 200.0
    assert clear(coast, 10.21, 63.05) < -300.0
    assert clear(coast, 10.29, 63.07) < -300.0
    assert clear(coast, 10.19, 63.05) > 400.0


@pytest.mark.parametrize("west", [(-179.9,) * 2, (180.1,) * 2, (-179.9, 180.1)])
def test_land_lies_across_the_180th_meridian(west: tuple[float, float]) -> None:
    coast = land(((179.9, -17.0), (west[0], -17.0), (west[1], -16.9)), stop=(179.7, -17.0))
    for lon in (179.99, 180.0, -180.0, -179.95):
        assert clear(coast, lon, -16.99) < -500.0
    assert clear(coast, -179.8, -17.0) > 10_000.0


def test_land_that_is_cut_at_the_180th_meridian_has_no_gap_there() -> None:
    """RFC 7946 asks for two parts; what they share is on the same line of either."""
    parts = (
        Area("land", ((179.9, -17.0), (180.0, -17.0), (180.0, -16.9), (179.9, -16.9))),
        Area("land", ((-180.0, -17.0), (-179.9, -17.0), (-179.9, -16.9), (-180.0, -16.9))),
    )
    ends = replace(TERMS, start=(179.8, -17.1), destination=(179.8, -17.1))
    mission = Survey(True, (Site("a", (179.8, -17.1)),), parts).instance("x", ends)
    x, y = LocalPlane(*_origin(mission.crs)).project(np.full(2, 180.0), np.array([-17.1, -16.8]))
    assert leg_clearance(barriers_of(mission.ocean), x[0], y[0], x[1], y[1]) < 0.0
    spots = [set(polygon.polygon) for polygon in mission.ocean.land]
    assert len(spots[0] & spots[1]) == 2


@pytest.mark.parametrize(
    "rings",
    [
        ((ISLAND[0], ISLAND[2], ISLAND[1], ISLAND[3]),),  # an hourglass
        ((*ISLAND, (10.25, 63.0)),),  # a corner on another edge
        ((*ISLAND[:2], (10.4, 63.05), ISLAND[1], *ISLAND[2:]),),  # a spike
    ],
)
def test_polygons_that_meet_themselves_are_refused(rings: Any) -> None:
    with pytest.raises(InputError, match=r"^--zones, placemark 7: is no simple polygon .*10\.[23]"):
        land(*rings)


@pytest.mark.parametrize("east", [0.05, 1.0])
def test_holes_lie_in_their_zone(east: float) -> None:
    with pytest.raises(InputError, match=r"^--zones, placemark 7: its holes must lie in the zone"):
        land(ISLAND, tuple((lon + east, lat) for lon, lat in LAGOON))
