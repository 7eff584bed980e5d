"""Waypoints: legs are left behind in order, and the last waypoint is closed in on."""

import math

import numpy as np

from fiveroute.vehicle.dynamics import State
from fiveroute.vehicle.waypoints import Headway, Waypoints, made_good

CORNER = Waypoints.of(np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 50.0]]), 5.0)
BEGIN = Headway(0, False, math.inf, 0.0)


def at(x: float, y: float) -> State:
    return State(x, y, 0.0, 1.0, 0.0, 0.0)


def test_the_way_left_is_that_along_the_track() -> None:
    assert CORNER.left.tolist() == [150.0, 50.0, 0.0]


def test_a_vehicle_knows_its_place_on_a_leg() -> None:
    way, place = made_good(CORNER, at(40.0, 3.0), BEGIN, 7.0, np.full(3, math.inf))
    assert (place.bearing, place.error, place.left) == (0.0, 3.0, 60.0)
    assert (way.leg, way.best, way.progressed) == (0, 110.0, 7.0)


def test_the_next_leg_begins_shortly_before_the_waypoint() -> None:
    arrivals = np.full(3, math.inf)
    assert made_good(CORNER, at(94.0, 0.0), BEGIN, 8.0, arrivals)[0].leg == 0
    way, place = made_good(CORNER, at(96.0, 0.0), BEGIN, 9.0, arrivals)
    assert way.leg == 1
    assert place.bearing == math.pi / 2.0
    assert arrivals.tolist() == [math.inf, 9.0, math.inf]


def test_abeam_of_the_last_waypoint_the_vehicle_closes_in_on_it() -> None:
    beyond = at(96.0, 53.0)
    way, place = made_good(CORNER, beyond, Headway(1, False, 1.0, 0.0), 9.0, np.zeros(3))
    assert way.homing
    assert place.left == 5.0
    assert place.bearing == math.atan2(-3.0, 4.0)


def test_less_than_a_metre_is_no_progress() -> None:
    way = made_good(CORNER, at(40.5, 0.0), Headway(0, False, 110.0, 7.0), 8.0, np.zeros(3))[0]
    assert (way.best, way.progressed) == (110.0, 7.0)
