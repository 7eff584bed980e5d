"""Guidance in a cross current: who drifts away, who settles beside the leg, who keeps to it."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.vehicle.dynamics import Motion, State, Vehicle, advance
from fiveroute.vehicle.guidance import Guidance, Law, Steering, adapted, desired_heading

Water = Callable[[float, float], CurrentGrid]
STEP, STEPS = 0.5, 2400
CROSS = 0.5  # metres per second


@kernel
def follow(
    motion: Motion, steering: Steering, grid: CurrentGrid, state: State, errors: NDArray[np.float64]
) -> None:
    """Fill in the cross-track error along the x axis."""
    memory = 0.0
    for k in range(len(errors)):
        heading = desired_heading(steering, 0.0, state.y, memory)
        state = advance(motion, grid, state, heading, k * STEP, STEP)
        memory = adapted(steering, state.y, memory, STEP)
        errors[k] = state.y


def cross_track(
    law: Law, speed: float, grid: CurrentGrid, offset: float = 0.0
) -> NDArray[np.float64]:
    vehicle, errors = Vehicle(speed), np.empty(STEPS)
    state = vehicle.under_way(0.0, offset, 0.0)
    follow(vehicle.motion, Guidance(law).steering, grid, state, errors)
    return errors


@pytest.mark.parametrize("speed", [0.8, 1.0, 1.67])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("law", ["ilos", "alos"])
def test_the_error_vanishes(law: Law, side: float, speed: float, water: Water) -> None:
    errors = cross_track(law, speed, water(0.0, side * CROSS))
    assert np.abs(errors[-400:]).max() < 0.1  # metres in the last 200 seconds
    assert np.abs(errors).max() > 1.0


@pytest.mark.parametrize("speed", [0.8, 1.0, 1.67])
def test_plain_line_of_sight_keeps_an_offset(speed: float, water: Water) -> None:
    errors = cross_track("los", speed, water(0.0, CROSS))
    offset = Guidance().lookahead * CROSS / math.sqrt(speed**2 - CROSS**2)
    assert errors[-400:] == pytest.approx(offset, rel=1e-6)


def test_heading_hold_drifts_away(water: Water) -> None:
    errors = cross_track("hold", 1.0, water(0.0, CROSS))
    assert errors == pytest.approx(CROSS * STEP * np.arange(1, STEPS + 1))


@pytest.mark.parametrize("law", ["los", "ilos", "alos"])
@pytest.mark.parametrize("offset", [-300.0, 50.0])
def test_it_comes_back_from_afar(law: Law, offset: float, water: Water) -> None:
    errors = cross_track(law, 1.0, water(0.0, 0.0), offset)
    assert np.abs(errors[-400:]).max() < 0.1


def test_the_laws_are_those_published() -> None:
    ilos, alos = Guidance("ilos").steering, Guidance("alos").steering
    assert desired_heading(ilos, 1.0, 5.0, 10.0) == pytest.approx(1.0 - math.atan(7.0 / 20.0))
    assert desired_heading(alos, 1.0, 5.0, 0.1) == pytest.approx(0.9 - math.atan(0.25))
    assert adapted(ilos, 5.0, 10.0, 0.5) == pytest.approx(10.0 + 0.5 * 100.0 / 449.0)
    assert adapted(alos, 15.0, 0.1, 0.5) == pytest.approx(0.1 + 0.5 * 0.001 * 20.0 * 15.0 / 25.0)


def test_bad_numbers_are_named() -> None:
    with pytest.raises(InputError, match=r"lookahead.*positive"):
        Guidance(lookahead=0.0)
    with pytest.raises(InputError, match=r"law.*hold, los, ilos, alos"):
        Guidance("pursuit")  # type: ignore[arg-type]
