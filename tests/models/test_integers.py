"""Rounding to the safe side."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fiveroute.models.integers import ROUNDING, round_down, round_up, units_per_one


@pytest.mark.parametrize(
    ("values", "units"), [([3.0, 7.0], 1.0), ([0.1, 2.5], 10.0), ([0.125], 1000.0)]
)
def test_few_decimals_stay_exact(values: list[float], units: float) -> None:
    scaled = units_per_one(np.array(values), 10.0, 1e9) * np.array(values)
    np.testing.assert_array_equal(round_down(scaled), round_up(scaled))
    assert units_per_one(np.array(values), 10.0, 1e9) == units


def test_other_numbers_get_all_units_there_are() -> None:
    assert units_per_one(np.array([np.pi]), 4.0, 1e9) == 2.5e8
    assert units_per_one(np.array([1e-10, 0.0]), 1e-10, 1e6) == pytest.approx(1e16)
    assert np.isfinite(units_per_one(np.array([1e-310]), 1e-310, 1e9))


@given(values=arrays(np.float64, 4, elements=st.floats(0.0, 1e6)))
def test_rounding_keeps_its_side(values: np.ndarray) -> None:
    assert (round_down(values) <= values + ROUNDING).all()
    assert (round_up(values) >= values - ROUNDING).all()
