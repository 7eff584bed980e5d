"""Barriers of an instance, and points where no AUV can be."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.instance import Circle, Fleet, Instance, Node, Ocean, Point, Polygon
from fiveroute.ocean.barriers import clearance
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.land_mask import LandDistance, land_distance
from fiveroute.ocean.obstacles import barriers_of, refuse_points_inside

REGION = Region(-1000.0, -1000.0, 1000.0, 1000.0)
OCEAN = Ocean(
    obstacles=(
        Circle(0.0, 0.0, 100.0),
        Polygon(((200.0, 0.0), (300.0, 0.0), (300.0, 100.0))),
        Circle(-500.0, 0.0, 50.0),
    ),
    land=(Polygon(((0.0, 500.0), (0.0, 700.0), (400.0, 700.0), (400.0, 500.0))),),
)
BOW_TIE = Polygon(((0.0, 0.0), (10.0, 10.0), (10.0, 0.0), (0.0, 10.0)))
CLEAR = Point(-900.0, -900.0)


def coast() -> LandDistance:
    """Land of a mask to the east of 750 m."""
    mask = np.zeros((20, 20), dtype=np.bool_)
    mask[:, 17:] = True
    return land_distance(mask, -900.0, -900.0, 100.0)


def instance(start: Point = CLEAR, destination: Point = CLEAR, *nodes: Node) -> Instance:
    return Instance("sea", nodes, start, destination, Fleet(1, 1.0, None), ocean=OCEAN)


def test_barriers_know_every_zone() -> None:
    barriers = barriers_of(OCEAN, REGION)
    assert len(barriers.circles) == 2
    np.testing.assert_array_equal(barriers.first, [0, 3, 7])
    for x, y, expected in (
        (0.0, 0.0, -100.0),
        (-430.0, 0.0, 20.0),
        (300.0, -30.0, 30.0),
        (270.0, 20.0, -20.0),
        (200.0, 600.0, -100.0),
        (0.0, 300.0, 200.0),
        (-980.0, 900.0, 20.0),
    ):
        assert clearance(barriers, x, y) == pytest.approx(expected)


def test_margin_and_mask_are_passed_on() -> None:
    barriers = barriers_of(OCEAN, None, margin=25.0, land=coast())
    assert clearance(barriers, 0.0, 200.0) == pytest.approx(75.0)
    assert clearance(barriers, 700.0, 0.0) == pytest.approx(25.0)
    assert clearance(barriers, -5000.0, 0.0) > 0.0  # nobody named a region


def test_an_empty_ocean_is_open() -> None:
    assert barriers_of(Ocean(), REGION).is_open
    assert barriers_of(Ocean()).is_open


def test_the_sense_of_rotation_does_not_matter() -> None:
    turned = tuple(replace(zone, polygon=zone.polygon[::-1]) for zone in OCEAN.land)
    here, there = barriers_of(OCEAN), barriers_of(replace(OCEAN, land=turned))
    for x, y in np.random.default_rng(1).uniform(-1000.0, 1000.0, (50, 2)):
        assert clearance(here, x, y) == pytest.approx(clearance(there, x, y))


@pytest.mark.parametrize(
    "polygon",
    [
        BOW_TIE,
        Polygon(((0.0, 0.0), (1.0, 1.0), (2.0, 2.0))),  # no area
        Polygon(((0.0, 0.0), (0.0, 0.0), (0.0, 0.0))),
    ],
)
def test_a_polygon_must_be_simple(polygon: Polygon) -> None:
    circle = Circle(0.0, 0.0, 1.0)
    with pytest.raises(InputError, match=r"^ocean.obstacles\[1\]: .*no simple polygon \(see"):
        barriers_of(Ocean(obstacles=(circle, polygon)), REGION)
    with pytest.raises(InputError, match=r"^ocean.land\[0\]: .*no simple polygon"):
        barriers_of(Ocean(land=(polygon,)), REGION)


@pytest.mark.parametrize("margin", [-1.0, math.nan, math.inf])
def test_a_margin_must_be_a_distance(margin: float) -> None:
    with pytest.raises(InputError, match=r"^margin: .*: a safety margin must be"):
        barriers_of(OCEAN, REGION, margin=margin)


def test_points_in_open_water_pass() -> None:
    nodes = [Node("a", 150.0, 0.0, 1.0), Node("b", 100.0, 0.0, 1.0)]  # b on the very edge
    refuse_points_inside(instance(CLEAR, CLEAR, *nodes), barriers_of(OCEAN, REGION))


@pytest.mark.parametrize(
    ("start", "destination", "node", "sentence"),
    [
        (
            Point(10.0, 0.0),
            CLEAR,
            CLEAR,
            r"start: \(10.0, 0.0\): lies 90.0 m inside ocean.obstacles\[0\]",
        ),
        (
            CLEAR,
            Point(270.0, 20.0),
            CLEAR,
            r"destination: .* lies 20.0 m inside ocean.obstacles\[1\]",
        ),
        (
            CLEAR,
            CLEAR,
            Point(-510.0, 0.0),
            r"nodes\[1\]: 'b': lies 40.0 m inside ocean.obstacles\[2\]",
        ),
        (
            CLEAR,
            CLEAR,
            Point(100.0, 600.0),
            r"nodes\[1\]: 'b': lies 100.0 m inside ocean.land\[0\]",
        ),
        (Point(800.0, 0.0), CLEAR, CLEAR, r"start: .*: lies 50.0 m inside the land of the mask"),
        (CLEAR, Point(0.0, -1200.0), CLEAR, r"destination: .*: lies 200.0 m outside the region"),
    ],
)
def test_a_point_where_no_auv_can_be_is_refused(
    start: Point, destination: Point, node: Point, sentence: str
) -> None:
    nodes = Node("a", 0.0, -500.0, 1.0), Node("b", node.x, node.y, 1.0)
    barriers = barriers_of(OCEAN, REGION, land=coast())
    with pytest.raises(InputError, match=rf"^{sentence}.*; move"):
        refuse_points_inside(instance(start, destination, *nodes), barriers)


def test_the_margin_counts_and_is_named() -> None:
    near = instance(Point(120.0, 0.0))
    refuse_points_inside(near, barriers_of(OCEAN, REGION, margin=20.0))
    with pytest.raises(
        InputError,
        match=r"lies 10.0 m inside ocean.obstacles\[0\], counting the margin of 30 m; move",
    ):
        refuse_points_inside(near, barriers_of(OCEAN, REGION, margin=30.0))
