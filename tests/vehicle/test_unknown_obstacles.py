"""Strewn discs: how many there are, what they leave free, and which of them lie near a track."""

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import clearance, leg_clearance, no_barriers
from fiveroute.vehicle.unknown_obstacles import near_track, strewn_about, strewn_discs

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


LOW, HIGH = np.array([0.0, 0.0]), np.array([4000.0, 3000.0])


def test_a_whole_sea_leaves_passages_and_room_at_the_stops() -> None:
    known = no_barriers()._replace(circles=np.array([[2000.0, 1500.0, 300.0]]))
    stops = np.array([[500.0, 500.0], [3500.0, 2500.0]])
    for seed in range(5):
        rng = np.random.default_rng(seed)
        sea = strewn_about(known, stops, LOW, HIGH, 12.0, (10.0, 40.0), rng, passage=80.0)
        assert (sea.circles[0] == known.circles[0]).all()
        assert len(sea.circles) > 40
        assert min(clearance(sea, x, y) for x, y in stops) > 60.0
        apart = np.hypot(*(sea.circles[:, None, :2] - sea.circles[None, :, :2]).T)
        water = apart - np.add.outer(sea.circles[:, 2], sea.circles[:, 2])
        assert water[~np.eye(len(water), dtype=bool)].min() > 80.0


def test_near_a_track_is_what_a_clearance_says() -> None:
    rng = np.random.default_rng(5)
    circles = strewn_about(
        no_barriers(), TRACK, LOW, HIGH, 12.0, (10.0, 40.0), rng, passage=0.0
    ).circles

    def clear(circle: NDArray[np.float64]) -> float:
        alone = no_barriers()._replace(circles=circle[None, :])
        return min(leg_clearance(alone, *TRACK[k], *TRACK[k + 1]) for k in range(2))

    near = near_track(circles, TRACK, 200.0)
    assert 0 < len(near) < len(circles)
    assert near.tolist() == [circle.tolist() for circle in circles if clear(circle) < 200.0]
