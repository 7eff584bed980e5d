"""The rules of TSPLIB against values worked out by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.metric import Metric, distances

COORDINATE = st.integers(-1000, 1000)


def between(metric: Metric, first: tuple[float, float], second: tuple[float, float]) -> float:
    matrix = distances(metric, np.array([first, second], dtype=float))
    assert matrix[0, 0] == matrix[1, 1] == 0.0
    assert matrix[0, 1] == matrix[1, 0]
    return float(matrix[0, 1])


@pytest.mark.parametrize(
    ("metric", "first", "second", "expected"),
    [
        ("euclidean", (0, 0), (1, 1), math.sqrt(2)),
        ("EUC_2D", (0, 0), (1, 1), 1),  # 1.41
        ("EUC_2D", (0, 0), (1.5, 2), 3),  # 2.5 is rounded up
        ("CEIL_2D", (0, 0), (1, 1), 2),
        ("CEIL_2D", (0, 0), (3, 4), 5),
        ("ATT", (0, 0), (3, 1), 1),  # sqrt(10 / 10)
        ("ATT", (0, 0), (10, 10), 5),  # 4.47 would be rounded down to 4
        ("ATT", (0, 0), (4, 4), 2),  # 1.79
    ],
)
def test_rules(
    metric: Metric, first: tuple[float, float], second: tuple[float, float], expected: float
) -> None:
    assert between(metric, first, second) == expected


def test_geographical_distance_reads_degrees_and_minutes() -> None:
    """A degree of latitude on a sphere of 6378.388 km is 111.3 km, and one is added."""
    assert between("GEO", (48.00, 10.00), (49.00, 10.00)) == 112
    assert between("GEO", (48.00, 10.00), (48.30, 10.00)) == 56  # 30 minutes, half of it
    assert between("GEO", (-0.30, 0.00), (0.30, 0.00)) == 112
    assert between("GEO", (0.00, -179.59), (0.00, 179.59)) == 4  # across the date line


def test_geographical_distance_of_a_place_from_itself_is_zero() -> None:
    assert between("GEO", (48.23, 10.53), (48.23, 10.53)) == 0


@given(k=st.integers(1, 10_000))
@settings(deadline=None)
def test_whole_distances_are_not_rounded_up(k: int) -> None:
    assert between("ATT", (0, 0), (3 * k, k)) == k
    assert between("CEIL_2D", (0, 0), (3 * k, 4 * k)) == 5 * k
    assert between("EUC_2D", (0, 0), (3 * k, 4 * k)) == 5 * k


@given(first=st.tuples(COORDINATE, COORDINATE), second=st.tuples(COORDINATE, COORDINATE))
@settings(deadline=None)
def test_rounding_moves_a_distance_by_less_than_one(
    first: tuple[int, int], second: tuple[int, int]
) -> None:
    exact = math.dist(first, second)
    assert abs(between("EUC_2D", first, second) - exact) <= 0.5
    assert 0.0 <= between("CEIL_2D", first, second) - exact < 1.0
    assert 0.0 <= between("ATT", first, second) - exact / math.sqrt(10) < 1.0 + 1e-9


def test_explicit_distances_are_not_computed() -> None:
    with pytest.raises(ValueError, match="given"):
        distances("explicit", np.zeros((2, 2)))
