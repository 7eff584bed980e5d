"""The vehicle's motion: closed forms of steady turns, the rate's limit, the order of the steps."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.vehicle.dynamics import State, Vehicle, advance, rudder_angle

Water = Callable[[float, float], CurrentGrid]
STILL = CurrentGrid(np.zeros((1, 4, 4, 2)), -1e5, -1e5, 1e5, 0.0, 1.0)
HARD = 3.0  # radians of heading error that call for all the rudder


def turning(vehicle: Vehicle, grid: CurrentGrid, steps: int, step: float, side: float) -> State:
    """After a hard turn to port (1) or starboard (-1)."""
    motion, state = vehicle.motion, vehicle.under_way(0.0, 0.0, 0.3)
    for k in range(steps):
        state = advance(motion, grid, state, state.heading + side * HARD, k * step, step)
    return state


@pytest.mark.parametrize("speed", [0.8, 1.5, 2.5])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("rudder", [4.0, 15.0, 25.0])
def test_a_steady_turn_is_that_of_the_closed_form(speed: float, side: float, rudder: float) -> None:
    vehicle = Vehicle(speed, rudder_limit=math.radians(rudder))
    state = turning(vehicle, STILL, 800, 0.5, side)
    turn = vehicle.steady_turn(side * vehicle.rudder_limit)
    assert state.yaw_rate == pytest.approx(turn.yaw_rate, rel=1e-9)
    assert math.hypot(state.surge, state.sway) == pytest.approx(turn.speed, rel=1e-9)
    assert -state.sway / state.surge == pytest.approx(side * math.tan(turn.drift), rel=1e-9)
    assert turn.radius == pytest.approx(turn.speed / abs(state.yaw_rate), rel=1e-9)


def test_the_circle_has_the_radius_of_the_closed_form() -> None:
    vehicle = Vehicle(1.0)
    motion, state = vehicle.motion, turning(vehicle, STILL, 400, 0.5, 1.0)
    places = []
    for _ in range(round(2.0 * math.pi / state.yaw_rate / 0.5)):
        state = advance(motion, STILL, state, state.heading + HARD, 0.0, 0.5)
        places.append((state.x, state.y))
    centre = np.mean(places, axis=0)
    radii = np.hypot(*(np.array(places) - centre).T)
    assert radii == pytest.approx(vehicle.turning_radius, rel=5e-3)


def test_the_turn_is_that_of_the_model_it_was_fitted_to() -> None:
    assert Vehicle(1.67).turning_radius == pytest.approx(20.3, abs=0.1)


def test_a_turn_that_the_rudder_allows_is_bounded_by_the_rate() -> None:
    fast = Vehicle(2.5)
    assert fast.steady_turn(fast.rudder_limit).yaw_rate == pytest.approx(fast.yaw_rate_limit)
    assert fast.turning_radius > Vehicle(1.0).turning_radius


@settings(deadline=None, max_examples=30)
@given(
    speed=st.floats(0.5, 2.5),
    commands=st.lists(st.floats(-10.0, 10.0), min_size=1, max_size=20),
    limit=st.floats(1.0, 5.0),
)
def test_the_yaw_rate_keeps_its_limit(speed: float, commands: list[float], limit: float) -> None:
    vehicle = Vehicle(speed, yaw_rate_limit=math.radians(limit))
    motion, state = vehicle.motion, vehicle.under_way(0.0, 0.0, 0.0)
    for command in commands:
        for _ in range(20):
            state = advance(motion, STILL, state, command, 0.0, 0.5)
            assert abs(state.yaw_rate) <= vehicle.yaw_rate_limit * (1.0 + 1e-9)


@pytest.mark.parametrize("speed", [0.6, 1.0, 2.0])
def test_straight_ahead_it_keeps_its_speed(speed: float) -> None:
    slow = Vehicle(speed).under_way(0.0, 0.0, 1.0)._replace(surge=0.5 * speed)
    motion, state = Vehicle(speed).motion, slow
    for _ in range(1000):
        state = advance(motion, STILL, state, 1.0, 0.0, 0.5)
    assert state.surge == pytest.approx(speed, rel=1e-9)
    assert (state.sway, state.yaw_rate) == (0.0, 0.0)


def test_the_water_carries_it(water: Water) -> None:
    still = turning(Vehicle(1.0), STILL, 100, 0.5, 1.0)
    moved = turning(Vehicle(1.0), water(0.3, -0.2), 100, 0.5, 1.0)
    assert (moved.x - still.x, moved.y - still.y) == pytest.approx((15.0, -10.0), abs=1e-9)
    assert moved[2:] == pytest.approx(still[2:], abs=1e-12)


def test_the_heading_settles_without_overshoot() -> None:
    motion, state = Vehicle(1.0).motion, Vehicle(1.0).under_way(0.0, 0.0, 0.0)
    headings = []
    for _ in range(400):
        state = advance(motion, STILL, state, 1.0, 0.0, 0.5)
        headings.append(state.heading)
    assert headings[-1] == pytest.approx(1.0, abs=1e-6)
    assert max(headings) < 1.05


def test_the_steps_are_of_fourth_order() -> None:
    """In a shear, which the grid interpolates exactly, and a turn without a bound that comes on."""
    uv = np.zeros((1, 8, 8, 2))
    uv[..., 0] = 2e-3 * np.arange(-400.0, 400.0, 100.0)[:, None]
    shear = CurrentGrid(uv, -400.0, -400.0, 100.0, 0.0, 1.0)
    vehicle = Vehicle(1.0)
    ends = {n: np.array(turning(vehicle, shear, n, 64.0 / n, 1.0)) for n in (32, 64, 128, 1024)}
    errors = [np.abs(ends[n] - ends[1024]).max() for n in (32, 64, 128)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(4.0, abs=0.4)
    assert errors[2] < 1e-5  # metres, at the half second that missions take


def test_the_autopilot_puts_the_rudder_against_the_error() -> None:
    motion = Vehicle(1.0).motion
    assert rudder_angle(motion, 0.01, 1.0, 0.0) > 0.0 > rudder_angle(motion, -0.01, 1.0, 0.0)
    assert rudder_angle(motion, 3.0, 1.0, 0.0) == motion.rudder_limit
    assert abs(rudder_angle(motion, 3.0, 0.0, 0.0)) <= motion.rudder_limit


@pytest.mark.parametrize("speed", [0.0, -1.0, math.inf, math.nan])
def test_a_vehicle_must_move(speed: float) -> None:
    with pytest.raises(InputError, match=r"speed.*positive"):
        Vehicle(speed)
