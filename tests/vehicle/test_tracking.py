"""Whole voyages in open water: how they end, when waypoints are reached, that all do end."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.vehicle.dynamics import Vehicle
from fiveroute.vehicle.guidance import Guidance
from fiveroute.vehicle.sailed_track import Outcome
from fiveroute.vehicle.tracking import sail_track

Water = Callable[[float, float], CurrentGrid]
LEG = np.array([[0.0, 0.0], [1000.0, 0.0]])
SLOW = Vehicle(1.0)


def test_a_straight_leg_takes_its_length_over_the_speed(water: Water) -> None:
    sailed = sail_track(water(0.0, 0.0), LEG, SLOW)
    assert sailed.outcome is Outcome.ARRIVED
    assert sailed.duration == pytest.approx(1000.0, abs=0.5)
    assert sailed.arrivals == pytest.approx([0.0, 1000.0], abs=0.5)
    assert sailed.cross_track == pytest.approx(0.0, abs=1e-9)
    assert (sailed.manoeuvres, sailed.manoeuvring) == (0, 0.0)
    assert sailed.least_clearance == math.inf


def test_in_a_cross_current_it_makes_good_what_is_left_of_its_speed(water: Water) -> None:
    sailed = sail_track(water(0.2, 0.5), 3.0 * LEG, SLOW)
    made_good = 0.2 + math.sqrt(1.0 - 0.25)
    assert sailed.duration == pytest.approx(3000.0 / made_good, rel=5e-3)
    assert np.abs(sailed.cross_track[-400:]).max() < 0.1


def test_waypoints_are_reached_in_turn(water: Water) -> None:
    square = np.array([[0.0, 0.0], [500.0, 0.0], [500.0, 500.0], [0.0, 500.0], [0.0, 0.0]])
    sailed = sail_track(water(0.1, 0.1), square, SLOW, begin=700.0)
    assert sailed.outcome is Outcome.ARRIVED
    assert sailed.arrivals[0] == sailed.times[0] == 700.0
    assert (np.diff(sailed.arrivals) > 300.0).all()
    for place, time in zip(square[1:], sailed.arrivals[1:], strict=True):
        there = sailed.positions[np.searchsorted(sailed.times, time)]
        assert math.dist(there, place) <= 20.0
    rates = np.diff(sailed.headings) / np.diff(sailed.times)
    assert np.abs(rates).max() <= SLOW.yaw_rate_limit


def test_points_of_a_bent_path_may_be_close_and_may_coincide(water: Water) -> None:
    angle = np.linspace(0.0, math.pi, 40)
    bend = 200.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    bend = np.repeat(bend, 2, axis=0)
    sailed = sail_track(water(0.0, 0.2), bend, SLOW)
    assert sailed.outcome is Outcome.ARRIVED
    assert np.abs(np.hypot(*sailed.positions.T) - 200.0).max() < 10.0


@pytest.mark.parametrize("current", [(-1.2, 0.0), (0.0, 1.1), (-0.99999, 0.0)])
def test_too_strong_a_current_is_reported(current: tuple[float, float], water: Water) -> None:
    sailed = sail_track(water(*current), LEG, SLOW)
    assert sailed.outcome is Outcome.SWEPT
    assert sailed.duration < 2.0 * 1800.0
    assert sailed.arrivals[-1] == math.inf


def test_a_voyage_is_broken_off_in_time(water: Water) -> None:
    sailed = sail_track(water(0.0, 0.0), LEG, SLOW, longest=100.0)
    assert sailed.outcome is Outcome.LATE
    assert sailed.duration == 100.0


def test_heading_hold_misses_and_turns_back_to_the_end(water: Water) -> None:
    sailed = sail_track(water(0.0, 0.3), LEG, SLOW, guidance=Guidance("hold"))
    assert np.abs(sailed.cross_track).max() == pytest.approx(300.0, rel=0.01)
    assert sailed.outcome is Outcome.ARRIVED
    assert math.dist(sailed.positions[-1], LEG[-1]) <= 20.0


def test_it_may_set_off_on_any_heading(water: Water) -> None:
    back = sail_track(water(0.0, 0.0), LEG, SLOW, heading=math.pi)
    assert back.headings[0] == math.pi
    assert back.outcome is Outcome.ARRIVED
    assert back.duration > 1020.0


def test_the_same_voyage_twice_is_the_same(water: Water) -> None:
    one, two = (sail_track(water(0.1, 0.3), LEG, SLOW) for _ in range(2))
    assert np.array_equal(one.positions, two.positions)


def test_the_time_does_not_depend_on_the_step(water: Water) -> None:
    coarse = sail_track(water(0.1, 0.3), LEG, SLOW)
    fine = sail_track(water(0.1, 0.3), LEG, SLOW, step=0.1)
    assert coarse.duration == pytest.approx(fine.duration, abs=1.0)
    assert coarse.positions[1000] == pytest.approx(fine.positions[5000], abs=0.3)


@pytest.mark.parametrize("track", [[(0.0, 0.0)], [0.0, 1.0], [(0.0, 0.0), (math.nan, 1.0)]])
def test_a_bad_track_is_refused(track: list[tuple[float, float]], water: Water) -> None:
    with pytest.raises(InputError, match="track"):
        sail_track(water(0.0, 0.0), track, SLOW)


@pytest.mark.parametrize("name", ["step", "patience", "longest", "switch", "reach"])
def test_numbers_must_be_positive(name: str, water: Water) -> None:
    with pytest.raises(InputError, match=name):
        sail_track(water(0.0, 0.0), LEG, SLOW, **{name: 0.0})  # type: ignore[arg-type]
