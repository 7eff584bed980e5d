"""Clearances, against shapely's distances and the properties of a signed distance."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

from fiveroute.ocean.barriers import Barriers, boxed, clearance, leg_clearance, no_barriers
from fiveroute.ocean.current_grid import Region

Floats = NDArray[np.float64]
Leg = tuple[float, float, float, float]

SQUARE = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
PLACE = st.floats(-100.0, 100.0).map(lambda metres: round(metres, 6))  # shapely likes no less
LEG = st.tuples(PLACE, PLACE, PLACE, PLACE)
SEED = st.integers(0, 2**32)
FEW = settings(deadline=None, max_examples=100)


def barriers(
    circles: ArrayLike = (),
    polygons: Sequence[ArrayLike] = (),
    margin: float = 0.0,
    region: Region | None = None,
) -> Barriers:
    corners = [np.asarray(polygon, dtype=np.float64) for polygon in polygons]
    return no_barriers(region)._replace(
        circles=np.asarray(circles, dtype=np.float64).reshape(-1, 3),
        corners=np.concatenate([np.zeros((0, 2)), *corners]),
        first=np.cumsum([0, *map(len, corners)]),
        margin=margin,
    )


def star(rng: np.random.Generator) -> Floats:
    """A simple polygon, seldom convex, with corners in either sense of rotation."""
    corners = int(rng.integers(3, 12))
    angle = np.sort(rng.uniform(0.0, 2.0 * math.pi, corners))[:: rng.choice([-1, 1])]
    radius = rng.uniform(5.0, 60.0, corners)
    centre = rng.uniform(-60.0, 60.0, 2)
    return np.asarray(centre + np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))


def shapes(seed: int) -> tuple[Floats, list[Floats]]:
    """Random circles and simple polygons."""
    rng = np.random.default_rng(seed)
    circles = rng.uniform((-80.0, -80.0, 1.0), (80.0, 80.0, 30.0), (int(rng.integers(0, 4)), 3))
    polygons = [star(rng) for _ in range(rng.integers(1, 4))]
    return circles, [polygon for polygon in polygons if shapely.Polygon(polygon).is_valid]


def distance_to(shape: shapely.Geometry, circles: Floats, polygons: list[Floats]) -> float:
    """Distance of a point or a leg to all shapes, as shapely has it; infinite to none."""
    discs = [shapely.distance(shape, shapely.Point(x, y)) - radius for x, y, radius in circles]
    rest = [shapely.distance(shape, shapely.Polygon(polygon)) for polygon in polygons]
    return float(min([*discs, *rest], default=math.inf))


@given(seed=SEED, x=PLACE, y=PLACE)
@FEW
def test_clearance_of_a_point_is_the_signed_distance(seed: int, x: float, y: float) -> None:
    circles, polygons = shapes(seed)
    point = shapely.Point(x, y)
    signed = [math.hypot(x - a, y - b) - radius for a, b, radius in circles]
    for one in map(shapely.Polygon, polygons):
        size = one.exterior.distance(point)
        signed.append(-size if one.contains(point) else size)
    expected = min(signed, default=math.inf)
    assert clearance(barriers(circles, polygons), x, y) == pytest.approx(expected, abs=2e-6)


@given(seed=SEED, leg=LEG)
@FEW
def test_clearance_of_a_leg_is_exact_where_it_is_free(seed: int, leg: Leg) -> None:
    circles, polygons = shapes(seed)
    expected = distance_to(shapely.LineString([leg[:2], leg[2:]]), circles, polygons)
    found = leg_clearance(barriers(circles, polygons), *leg)
    if expected > 2e-6:
        assert found == pytest.approx(expected, rel=1e-9)
    else:
        assert found <= 2e-6


@given(seed=SEED, leg=LEG)
@FEW
def test_a_leg_through_a_barrier_is_never_free(seed: int, leg: Leg) -> None:
    circles, polygons = shapes(seed)
    line = shapely.LineString([leg[:2], leg[2:]])
    assume(distance_to(line, circles, polygons) <= 0.0)
    for margin in (0.0, 5.0):
        assert leg_clearance(barriers(circles, polygons, margin), *leg) < -margin


@pytest.mark.parametrize(
    "leg",
    [
        (-5.0, -5.0, 15.0, 15.0),  # through two corners
        (-1.0, 11.0, 11.0, -1.0),
        (-5.0, 3.0, 5.0, 3.0),  # in
        (5.0, 3.0, 15.0, 3.0),  # out again
        (2.0, 2.0, 8.0, 8.0),  # within
        (0.0, 0.0, 10.0, 10.0),  # from corner to corner
        (-5.0, 0.0, 15.0, 0.0),  # along an edge
        (2.0, 10.0, 8.0, 10.0),
        (-3.0, 5.0, 0.0, 5.0),  # ends on an edge
        (5.0, 15.0, 15.0, 5.0),  # touches a corner
        (10.0, 10.0, 10.0, 10.0),
        (5.0, 5.0, 5.0, 5.0),
    ],
)
@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1])
def test_a_leg_that_touches_a_polygon_is_not_free(leg: Leg, turn: float) -> None:
    """Nor is it with coordinates that are not exact, turned and far from the origin."""
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    shift = np.array([431_234.1, 6_712_345.7]) * (turn > 0.5)
    ends = np.reshape(leg, (2, 2)) @ rotation.T + shift
    square = barriers(polygons=[np.array(SQUARE) @ rotation.T + shift])
    assert leg_clearance(square, *ends.ravel().tolist()) < 0.0
    assert leg_clearance(square, *ends[::-1].ravel().tolist()) < 0.0


@given(seed=SEED, leg=LEG, margin=st.floats(0.0, 20.0))
@FEW
def test_clearance_changes_no_faster_than_the_place(seed: int, leg: Leg, margin: float) -> None:
    circles, polygons = shapes(seed)
    all_round = barriers(circles, polygons, margin, Region(-90.0, -90.0, 90.0, 90.0))
    x0, y0, x1, y1 = leg
    here, there = clearance(all_round, x0, y0), clearance(all_round, x1, y1)
    moved = math.hypot(x1 - x0, y1 - y0)
    assert abs(here - there) <= moved + 3e-6
    least = leg_clearance(all_round, *leg)
    assert least <= max(min(here, there), 0.0) + 1e-9
    if here > moved:  # a clearance of c metres frees all points within c
        assert least >= here - moved - 1e-9


@given(seed=SEED, leg=LEG, margin=st.floats(0.0, 50.0))
@FEW
def test_the_margin_is_taken_off(seed: int, leg: Leg, margin: float) -> None:
    circles, polygons = shapes(seed)
    bare, safe = barriers(circles, polygons), barriers(circles, polygons, margin)
    assert leg_clearance(safe, *leg) == pytest.approx(leg_clearance(bare, *leg) - margin)


def test_the_edge_of_the_region_is_a_barrier_without_margin() -> None:
    pool = barriers(margin=7.0, region=Region(-50.0, -20.0, 50.0, 20.0))
    assert pool.is_open
    assert clearance(pool, 0.0, 0.0) == 20.0
    assert clearance(pool, 45.0, 2.0) == 5.0
    assert clearance(pool, 53.0, 0.0) == -3.0
    assert leg_clearance(pool, -10.0, 0.0, 30.0, 18.0) == 2.0
    assert leg_clearance(pool, 0.0, 0.0, 0.0, -26.0) == -6.0


def test_open_water_is_free_for_ever() -> None:
    assert no_barriers().is_open
    assert clearance(no_barriers(), 1e9, -1e9) == math.inf
    assert not barriers(circles=[(0.0, 0.0, 1.0)]).is_open
    assert not barriers(polygons=[SQUARE]).is_open


@FEW
@given(seed=SEED, corners=st.integers(3, 300))
def test_boxes_change_nothing(seed: int, corners: int) -> None:
    """To the last bit, for legs of all lengths, in, out of and across polygons of many corners."""
    rng = np.random.default_rng(seed)
    coasts = []
    for count in (corners, 5):
        angle = np.sort(rng.uniform(0.0, 2.0 * math.pi, count))
        radius = rng.uniform(20.0, 60.0) * (1.0 + 0.3 * rng.uniform(-1.0, 1.0, count))
        ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
        coasts.append((ring + rng.uniform(-60.0, 60.0, 2)).round(int(rng.integers(0, 3))))
    plain = barriers(polygons=coasts, margin=2.0)
    quick = boxed(plain)
    assert len(quick.boxes) == -(-corners // 32) + 1
    places = rng.uniform(-120.0, 120.0, (40, 2))
    for x, y in (*places, *coasts[0][:5]):
        east, north = rng.uniform(-1.0, 1.0, 2) * rng.choice([0.0, 1.0, 30.0, 200.0])
        leg = float(x), float(y), float(x + east), float(y + north)
        assert leg_clearance(quick, *leg) == leg_clearance(plain, *leg)


def test_corners_given_twice_change_nothing() -> None:
    closed = barriers(polygons=[[*SQUARE, SQUARE[0]]])
    doubled = barriers(polygons=[[corner for corner in SQUARE for _ in range(2)]])
    for x, y in np.random.default_rng(1).uniform(-20.0, 30.0, (100, 2)):
        expected = clearance(barriers(polygons=[SQUARE]), x, y)
        assert clearance(closed, x, y) == clearance(doubled, x, y) == expected


def slope(west: float = -100.0, south: float = -50.0, step: float = 10.0) -> Barriers:
    """Distances of a mask that rise to the east, 3 m at each column, and 1 m at each row."""
    rows, columns = np.indices((11, 21))
    return no_barriers()._replace(
        land=np.add(3.0 * columns, rows) - 20.0, land_west=west, land_south=south, land_step=step
    )


def test_distances_of_a_mask_are_interpolated() -> None:
    mask = slope()
    assert not mask.is_open
    for x, y in np.random.default_rng(2).uniform((-100.0, -50.0), (100.0, 50.0), (50, 2)):
        expected = 0.3 * (x + 100.0) + 0.1 * (y + 50.0) - 20.0
        assert clearance(mask, x, y) == pytest.approx(expected)
        assert clearance(mask._replace(margin=4.0), x, y) == pytest.approx(expected - 4.0)


def test_beyond_a_mask_its_edge_counts() -> None:
    mask = slope()
    for far, near in (((500.0, 0.0), (100.0, 0.0)), ((-101.0, -99.0), (-100.0, -50.0))):
        assert clearance(mask, *far) == pytest.approx(clearance(mask, *near))


@given(seed=SEED, leg=LEG)
@FEW
def test_a_leg_near_a_mask_is_looked_at_all_along(seed: int, leg: Leg) -> None:
    """At least at every quarter of a cell, so that little can hide in between."""
    distance = np.random.default_rng(seed).uniform(-10.0, 30.0, (21, 21))
    mask = no_barriers()._replace(
        land=distance, land_west=-100.0, land_south=-100.0, land_step=10.0
    )
    x0, y0, x1, y1 = leg
    shares = np.linspace(0.0, 1.0, 2001)
    dense = min(clearance(mask, x0 + s * (x1 - x0), y0 + s * (y1 - y0)) for s in shares)
    found = leg_clearance(mask, *leg)
    steepest = 40.0 / 10.0 * math.sqrt(2.0)  # metres a metre, of any bilinear cell
    assert found <= dense + steepest * 10.0 / 8.0 + 1e-9
    assert found <= min(clearance(mask, x0, y0), clearance(mask, x1, y1)) + 1e-9
