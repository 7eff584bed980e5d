"""Strewn discs: how many there are, and what they leave free."""

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import clearance
from fiveroute.vehicle.unknown_obstacles import strewn_discs

TRACK = np.array([[0.0, 0.0], [2000.0, 500.0], [3000.0, 0.0]])


def test_there_are_as_many_as_the_density_says() -> None:
    rng = np.random.default_rng(1)
    numbers = [len(strewn_discs(TRACK, 20.0, (5.0, 10.0), rng).circles) for _ in range(200)]
    expected = 20.0 * 3.4 * 0.9  # square kilometres, less what is kept clear
    assert np.mean(numbers) == pytest.approx(expected, abs=4.0 * np.sqrt(expected / 200) + 1.0)


def test_both_ends_are_clear_and_radii_are_in_order() -> None:
    rng = np.random.default_rng(2)
    for _ in range(20):
        waters = strewn_discs(TRACK, 200.0, (5.0, 50.0), rng, clear=70.0)
        assert min(clearance(waters, x, y) for x, y in TRACK[[0, -1]]) > 70.0
        assert waters.circles[:, 2].min() >= 5.0
        assert waters.circles[:, 2].max() <= 50.0


def test_the_same_seed_gives_the_same_discs() -> None:
    one, two = (strewn_discs(TRACK, 9.0, (5, 9), np.random.default_rng(3)) for _ in range(2))
    assert np.array_equal(one.circles, two.circles)


def test_bad_numbers_are_named() -> None:
    rng = np.random.default_rng(4)
    with pytest.raises(InputError, match="radii"):
        strewn_discs(TRACK, 1.0, (9.0, 5.0), rng)
    with pytest.raises(InputError, match="per_km2"):
        strewn_discs(TRACK, -1.0, (5.0, 9.0), rng)
