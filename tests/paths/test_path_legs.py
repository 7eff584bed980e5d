"""Times of straight legs, against closed forms, quadrature and an ODE."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import quad, solve_ivp

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import CurrentGrid, Region, grid_current, velocity
from fiveroute.ocean.currents import Current, LambVortices, Shear, UniformCurrent
from fiveroute.paths.legs import (
    ground_speed,
    leg_time,
    track_clearance,
    track_time,
)

Floats = NDArray[np.float64]
Leg = tuple[float, float, float, float]

REGION = Region(-5000.0, -5000.0, 5000.0, 5000.0)
PLACE = st.floats(-4000.0, 4000.0)
LEG = st.tuples(PLACE, PLACE, PLACE, PLACE)
FEW = settings(deadline=None, max_examples=60)


def on_grid(current: Current, duration: float = 0.0) -> CurrentGrid:
    return grid_current(current, REGION, duration=duration, tolerance=1e-4)


STILL = on_grid(UniformCurrent(0.0, 0.0))
VORTICES = on_grid(
    LambVortices(
        np.array([-1000.0, 1500.0, 0.0]),
        np.array([500.0, -700.0, 2500.0]),
        np.array([1500.0, -1800.0, 1000.0]),
        np.array([700.0, 900.0, 600.0]),
    )
)


def pace(grid: CurrentGrid, leg: Leg, speed: float, s: float, t: float = 0.0) -> float:
    """Speed over ground at the share s of a leg, (11), with the crab angle told by its sine."""
    x0, y0, x1, y1 = leg
    heading = math.atan2(y1 - y0, x1 - x0)
    u, v = velocity(grid, x0 + s * (x1 - x0), y0 + s * (y1 - y0), t)
    crab = math.asin((u * math.sin(heading) - v * math.cos(heading)) / speed)
    return u * math.cos(heading) + v * math.sin(heading) + speed * math.cos(crab)


@given(leg=LEG, speed=st.floats(0.2, 5.0))
@FEW
def test_still_water_takes_length_over_speed(leg: Leg, speed: float) -> None:
    length = math.hypot(leg[2] - leg[0], leg[3] - leg[1])
    assert leg_time(STILL, *leg, 0.0, speed) == pytest.approx(length / speed, rel=1e-12)


@given(leg=LEG, heading=st.floats(0.0, 6.3), drift=st.floats(0.0, 0.9), t=st.floats(0.0, 1e5))
@FEW
def test_a_uniform_current_has_a_closed_form(
    leg: Leg, heading: float, drift: float, t: float
) -> None:
    """The water carries the AUV: it sails |leg - c T| = V T, a quadratic equation in T."""
    u, v, speed = drift * math.cos(heading), drift * math.sin(heading), 1.1
    east, north = leg[2] - leg[0], leg[3] - leg[1]
    a, b = speed**2 - u**2 - v**2, u * east + v * north
    expected = (math.sqrt(b**2 + a * (east**2 + north**2)) - b) / a
    found = leg_time(on_grid(UniformCurrent(u, v)), *leg, t, speed)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_the_crab_angle_cancels_the_drift() -> None:
    """Abeam of 0.6 m/s a speed of 1 m/s makes good 0.8 m/s; ahead and astern they add up."""
    assert ground_speed(0.0, 0.6, 1.0, 0.0, 1.0) == pytest.approx(0.8)
    assert ground_speed(0.6, 0.0, 0.0, -1.0, 1.0) == pytest.approx(0.8)
    assert ground_speed(0.6, 0.0, 1.0, 0.0, 1.0) == pytest.approx(1.6)
    assert ground_speed(0.6, 0.0, -1.0, 0.0, 1.0) == pytest.approx(0.4)


@given(
    u=st.floats(-2.0, 2.0),
    v=st.floats(-2.0, 2.0),
    course=st.floats(0.0, 6.3),
    speed=st.floats(0.5, 2),
)
@FEW
def test_water_speed_and_current_add_up_to_the_ground_speed(
    u: float, v: float, course: float, speed: float
) -> None:
    east, north = math.cos(course), math.sin(course)
    made_good = ground_speed(u, v, east, north, speed)
    if made_good > 0.0:
        assert math.hypot(made_good * east - u, made_good * north - v) == pytest.approx(speed)
    else:
        across = abs(v * east - u * north)
        ahead = math.sqrt(max(speed**2 - across**2, 0.0))
        assert across >= speed or u * east + v * north + ahead <= 1e-3


@pytest.mark.parametrize(
    ("u", "v"),
    [
        (0.0, 1.0),  # abeam, as fast as the AUV
        (0.9, -1.2),  # abeam, though it helps along
        (-1.0, 0.0),  # ahead, as fast as the AUV
        (-1.5, 0.0),
        (-0.8, 0.61),  # makes good 0.79 m/s against 0.8 m/s
        (-0.9995, 0.0),  # as good as standing still
    ],
)
def test_a_leg_against_too_strong_a_current_takes_for_ever(u: float, v: float) -> None:
    grid = on_grid(UniformCurrent(u, v))
    assert leg_time(grid, 0.0, 0.0, 1000.0, 0.0, 0.0, 1.0) == math.inf
    track = np.array([[0.0, 10.0], [0.0, 0.0], [1000.0, 0.0], [1000.0, 10.0]])
    assert track_time(grid, track, 0.0, 1.0) == math.inf


def test_a_current_helps_one_way_and_hinders_the_other() -> None:
    grid = on_grid(UniformCurrent(-1.5, 0.0))
    assert leg_time(grid, 0.0, 0.0, -1000.0, 0.0, 0.0, 1.0) == pytest.approx(400.0)
    assert leg_time(grid, -1000.0, 0.0, 0.0, 0.0, 0.0, 1.0) == math.inf


def test_too_strong_a_current_on_the_way_is_found() -> None:
    """The water runs to the west faster and faster to the north: 1 m/s at 2 km."""
    grid = on_grid(Shear(-5e-4))
    for y, passable in ((1900.0, True), (2100.0, False)):
        assert (leg_time(grid, 0.0, y, 3000.0, y, 0.0, 1.0) < math.inf) == passable
    assert leg_time(grid, 0.0, 0.0, 100.0, 3000.0, 0.0, 1.0) == math.inf  # abeam at last


@given(leg=LEG)
@FEW
def test_gauss_and_legendre_agree_with_adaptive_quadrature(leg: Leg) -> None:
    length = math.hypot(leg[2] - leg[0], leg[3] - leg[1])
    expected, _ = quad(
        lambda s: length / pace(VORTICES, leg, 1.0, s) if length else 0.0,
        0.0,
        1.0,
        limit=500,
        epsrel=1e-6,
    )
    assert leg_time(VORTICES, *leg, 0.0, 1.0) == pytest.approx(expected, rel=5e-6, abs=1e-9)


@dataclass(frozen=True)
class Tide:
    """A uniform current that comes and goes."""

    strength: float
    period: float
    is_steady: bool = False
    length_scale: float = 1000.0

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        u = self.strength * np.sin(2.0 * math.pi * np.asarray(t) / self.period)
        u = u + np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))
        return u, 0.5 * u


@pytest.mark.parametrize("begin", [0.0, 4000.0, 9000.0])
@pytest.mark.parametrize("heading", [0.0, 1.0, 2.5, 4.0])
def test_a_tide_is_met_at_its_time(begin: float, heading: float) -> None:
    """Against ds / dt = g(t), solved to nine digits, until the leg is done."""
    tide = Tide(0.4, 12_000.0)
    grid = on_grid(tide, duration=16_000.0)
    length, speed = 4000.0, 1.0
    leg = (0.0, 0.0, length * math.cos(heading), length * math.sin(heading))

    def arrived(t: float, s: Floats) -> float:
        return float(s[0]) - length

    arrived.terminal = True  # type: ignore[attr-defined]
    solved = solve_ivp(
        lambda t, s: [pace(grid, leg, speed, 0.5, t)],
        (begin, begin + 20_000.0),
        [0.0],
        events=arrived,
        rtol=1e-9,
        atol=1e-9,
        max_step=100.0,
    )
    assert solved.t_events is not None
    expected = float(solved.t_events[0][0]) - begin
    assert leg_time(grid, *leg, begin, speed) == pytest.approx(expected, rel=2e-4)


def test_no_way_takes_no_time() -> None:
    assert leg_time(VORTICES, 5.0, 5.0, 5.0, 5.0, 0.0, 1.0) == 0.0
    assert track_time(VORTICES, np.array([[5.0, 5.0]]), 0.0, 1.0) == 0.0


def test_a_track_takes_the_times_of_its_legs_one_after_the_other() -> None:
    grid = on_grid(Tide(0.4, 12_000.0), duration=16_000.0)
    track = np.array([[0.0, 0.0], [800.0, 300.0], [1500.0, -900.0], [2900.0, -1000.0]])
    t = 3000.0
    for (x0, y0), (x1, y1) in pairwise(track):
        t += leg_time(grid, x0, y0, x1, y1, t, 1.2)
    assert track_time(grid, track, 3000.0, 1.2) == pytest.approx(t - 3000.0)


def test_a_track_is_as_clear_as_its_worst_leg() -> None:
    pillar = no_barriers()._replace(circles=np.array([[50.0, 40.0, 10.0]]))
    track = np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [50.0, 100.0]])
    assert track_clearance(pillar, track) == pytest.approx(30.0)
    assert track_clearance(pillar, track[:1]) == math.inf
    through = np.array([[0.0, 0.0], [50.0, 0.0], [50.0, 100.0]])
    assert track_clearance(pillar, through) == pytest.approx(-10.0)
