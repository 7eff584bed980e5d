"""Metres within shapes, against closed forms and against another library's geometry."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.crossings import metres_within
from fiveroute.instance import Circle, Polygon

SQUARE = Polygon(((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)))


def track(*points: tuple[float, float]) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    return np.array(points, dtype=np.float64)


def test_a_chord_of_a_circle() -> None:
    across = track((-100.0, 3.0), (100.0, 3.0))
    assert metres_within(across, [Circle(0.0, 0.0, 5.0)]) == pytest.approx(8.0)
    assert metres_within(across, [Circle(0.0, 0.0, 3.0)]) == 0.0  # it only touches


def test_a_leg_that_begins_or_ends_inside() -> None:
    assert metres_within(track((0.0, 0.0), (9.0, 0.0)), [Circle(0.0, 0.0, 5.0)]) == pytest.approx(5)
    assert metres_within(track((5.0, 5.0), (5.0, 25.0)), [SQUARE]) == pytest.approx(5.0)
    assert metres_within(track((1.0, 1.0), (4.0, 5.0)), [SQUARE]) == pytest.approx(5.0)


def test_what_several_shapes_cover_counts_once() -> None:
    through = track((-10.0, 5.0), (20.0, 5.0))
    assert metres_within(through, [SQUARE, Circle(5.0, 5.0, 2.0), SQUARE]) == pytest.approx(10.0)


def test_a_way_through_a_corner_and_along_an_edge() -> None:
    assert metres_within(track((-5.0, 5.0), (5.0, -5.0)), [SQUARE]) == 0.0
    assert metres_within(track((0.0, 0.0), (10.0, 10.0)), [SQUARE]) == pytest.approx(
        10.0 * math.sqrt(2.0)
    )


def test_a_track_that_stands_still() -> None:
    assert metres_within(track((5.0, 5.0), (5.0, 5.0)), [SQUARE, Circle(5.0, 5.0, 1.0)]) == 0.0
    assert metres_within(track((5.0, 5.0)), [SQUARE]) == 0.0


@given(seed=st.integers(0, 10**6))
def test_it_agrees_with_another_geometry(seed: int) -> None:
    rng = np.random.default_rng(seed)
    star = rng.uniform(3.0, 30.0, 9)
    angles = np.linspace(0.0, 2.0 * np.pi, 9, endpoint=False)
    corners = np.column_stack([star * np.cos(angles), star * np.sin(angles)])
    x, y, radius = rng.uniform((-20.0, -20.0, 1.0), (20.0, 20.0, 15.0)).tolist()
    polygon = Polygon(tuple((float(east), float(north)) for east, north in corners))
    way = rng.uniform(-40.0, 40.0, (6, 2))
    circle = shapely.Point(x, y).buffer(radius, quad_segs=512)
    both = shapely.union(shapely.Polygon(corners), circle)
    legs = shapely.linestrings(np.stack([way[:-1], way[1:]], axis=1))
    expected = shapely.length(shapely.intersection(legs, both)).sum()
    assert metres_within(way, [polygon, Circle(x, y, radius)]) == pytest.approx(
        expected, rel=1e-4, abs=0.05
    )
