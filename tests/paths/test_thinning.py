"""Fewer waypoints, and never farther off than allowed."""

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.paths.thinning import thinned


def test_waypoints_on_a_line_are_left_out() -> None:
    line = np.column_stack([np.linspace(0.0, 9.0, 10), np.zeros(10)])
    assert thinned(line, 0.1).tolist() == [[0.0, 0.0], [9.0, 0.0]]


def test_a_corner_is_kept() -> None:
    corner = np.array([[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    assert thinned(corner, 0.1).tolist() == [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]


def test_a_loop_back_to_its_beginning_stays() -> None:
    loop = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 0.0]])
    assert len(thinned(loop, 0.1)) == 4


def test_a_chord_that_is_not_clear_is_divided() -> None:
    """Nothing may pass below a roof over the middle, so that its ridge stays and no more."""
    roof = np.array([[0.0, 0.0], [3.0, 0.1], [4.0, 0.2], [5.0, 0.3], [6.0, 0.2], [10.0, 0.0]])

    def is_clear(chord: np.ndarray, _: np.ndarray) -> bool:
        return float(np.interp(5.0, *chord.T)) >= 0.3

    assert thinned(roof, 1.0, is_clear).tolist() == [[0.0, 0.0], [5.0, 0.3], [10.0, 0.0]]


@given(seed=st.integers(0, 10**6), off=st.floats(0.1, 20.0))
def test_it_agrees_with_another_library(seed: int, off: float) -> None:
    walk = np.cumsum(np.random.default_rng(seed).normal(0.0, 5.0, (40, 2)), axis=0)
    few = thinned(walk, off)
    left_out = shapely.points(walk)
    assert (shapely.distance(left_out, shapely.LineString(few)) <= off + 1e-9).all()
    assert (few[[0, -1]] == walk[[0, -1]]).all()
    assert len(few) <= len(walk)
