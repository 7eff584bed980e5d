"""The grid of the data, and bounds rounded down to it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fiveroute.models.common_divisor import common_divisor, rounded_down


@pytest.mark.parametrize(
    ("profit", "divisor"),
    [
        ([0.0, 10.0, 25.0, 0.0], 5.0),
        ([3.0], 3.0),
        ([0.5, 1.25], 0.25),
        ([0.1, 0.2, 0.3], 0.1),
        ([1.0, math.pi], None),
        ([0.0, 0.0], None),
        ([], None),
        ([1e12, 1.0], None),
    ],
)
def test_common_divisor(profit: list[float], divisor: float | None) -> None:
    assert common_divisor(np.array(profit)) == pytest.approx(divisor)


def test_bounds_fall_to_the_grid_and_never_below_a_value_on_it() -> None:
    profit = np.array([0.0, 10.0, 25.0])
    assert rounded_down(564.9, profit) == 560.0 + 0.0
    assert rounded_down(565.0, profit) == 565.0
    assert rounded_down(565.0 - 1e-10, profit) == 565.0
    for tenths in range(100):
        value = sum([0.1] * tenths)
        assert rounded_down(value, np.array([0.1, 0.7])) == pytest.approx(value)


def test_without_a_grid_bounds_stay_as_they_are() -> None:
    assert rounded_down(3.5, np.array([math.e])) == 3.5
    assert rounded_down(math.inf, np.array([1.0])) == math.inf


def test_less_than_any_node_holds_is_nothing() -> None:
    profit = np.array([0.0, 3e-7, math.pi, 0.0])
    assert rounded_down(2.9e-7, profit) == 0.0
    assert rounded_down(3e-7 * (1.0 - 1e-12), profit) > 0.0
    assert rounded_down(1e-300, np.zeros(3)) == 0.0
