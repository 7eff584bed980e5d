"""Polygons whose edges meet, against another library's verdict."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.ocean import simple_polygon
from fiveroute.ocean.simple_polygon import first_conflict


@pytest.mark.parametrize(
    "corners",
    [
        [(0, 0), (1, 1), (1, 0), (0, 1)],  # a bow tie
        [(0, 0), (2, 0), (1, 0), (1, 1)],  # an edge that turns straight back
        [(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)],  # a corner on another edge
        [(0, 0), (1, 1), (2, 2)],  # no area
        [(0, 0), (0, 0), (0, 0)],
        [(0, 0), (2, 0), (2, 2), (1, 1), (0, 2), (1, 1)],  # the same corner twice
    ],
)
def test_edges_that_meet(corners: list[tuple[float, float]]) -> None:
    assert first_conflict(np.array(corners, dtype=np.float64)) is not None


@pytest.mark.parametrize(
    "corners",
    [
        [(0, 0), (1, 0), (0, 1)],
        [(0, 0), (1, 0), (2, 0), (2, 2)],  # a corner that is none
        [(0, 0), (0, 0), (1, 0), (1, 1), (0, 0)],  # repeated corners
        [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)],
    ],
)
def test_edges_that_keep_apart(corners: list[tuple[float, float]]) -> None:
    assert first_conflict(np.array(corners, dtype=np.float64)) is None


@given(
    corners=st.lists(
        st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=8, unique=True
    )
)
def test_it_agrees_with_another_verdict(corners: list[tuple[int, int]]) -> None:
    simple = bool(shapely.Polygon(corners).is_valid)
    assert (first_conflict(np.array(corners, dtype=np.float64)) is None) == simple


def test_many_edges_are_compared_in_portions(monkeypatch: pytest.MonkeyPatch) -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    ring = 100.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    monkeypatch.setattr(simple_polygon, "_PAIRS", 50)
    assert first_conflict(ring) is None
    ring[[120, 121]] = ring[[121, 120]]
    found = first_conflict(ring)
    assert found is not None
    assert np.hypot(*(ring[118:124] - found).T).min() == 0.0
