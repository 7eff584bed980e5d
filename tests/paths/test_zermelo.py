import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import CurrentGrid, Region, grid_current
from fiveroute.ocean.currents import DoubleGyre, LambVortices, Shear, UniformCurrent
from fiveroute.paths.legs import leg_time, track_time
from fiveroute.paths.waters import Waters
from fiveroute.paths.zermelo import _Task, extremal, uniform_flow_time, zermelo_path

SQUARE = Region(-500.0, -500.0, 5500.0, 5500.0)
SHEAR = grid_current(Shear(2e-4, 2500.0), SQUARE)

flows = st.floats(-3.0, 3.0)
places = st.floats(-1000.0, 1000.0).filter(lambda metres: abs(metres) > 1e-3)


def task(grid: CurrentGrid) -> _Task:
    return _Task(grid, np.array([1000.0, 1000.0]), np.zeros(2), 0.0, 1.0, 1.0)


def vortices(seed: int) -> CurrentGrid:
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(0.0, 5000.0, (2, 8))
    lamb = LambVortices(x, y, rng.normal(0.0, 900.0, 8), rng.uniform(300.0, 700.0, 8))
    return grid_current(lamb, SQUARE)


def test_in_shear_the_tangent_of_the_heading_falls_with_time() -> None:
    """With u = a (y - y0), d theta/dt = -a cos^2(theta), so tan(theta) = tan(theta0) - a t."""
    track = extremal(task(SHEAR), 0.5, 2500.0, 400)
    last = track[-1] - track[-2]
    y, middle = (track[-1, 1] + track[-2, 1]) / 2.0, 2500.0 * (399.5 / 400.0)
    heading = math.atan2(last[1], last[0] - 2e-4 * (y - 2500.0) * 2500.0 / 400.0)
    assert math.tan(heading) == pytest.approx(math.tan(0.5) - 2e-4 * middle, abs=1e-6)


def test_the_integration_is_of_fourth_order() -> None:
    exact = extremal(task(SHEAR), 0.5, 2500.0, 4096)[-1]
    errors = [np.hypot(*(extremal(task(SHEAR), 0.5, 2500.0, n)[-1] - exact)) for n in (2, 4, 8)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (np.abs(orders - 4.0) < 0.4).all()


@settings(deadline=None, max_examples=15)
@given(heading=st.floats(0.0, math.tau), flow=st.floats(0.0, 0.8), bearing=st.floats(0.0, math.tau))
def test_uniform_flow_takes_its_closed_form(heading: float, flow: float, bearing: float) -> None:
    u, v = flow * math.cos(heading), flow * math.sin(heading)
    waters = Waters(grid_current(UniformCurrent(u, v), SQUARE), no_barriers(), 1.0)
    east, north = 1700.0 * math.cos(bearing), 1700.0 * math.sin(bearing)
    path = zermelo_path(waters, (2500.0, 2500.0), (2500.0 + east, 2500.0 + north))
    assert path.duration == pytest.approx(uniform_flow_time(u, v, east, north, 1.0), rel=1e-8)
    assert track_time(waters.grid, path.track, 0.0, 1.0) == pytest.approx(path.duration, rel=1e-8)


def test_too_strong_a_current_leaves_no_extremal() -> None:
    waters = Waters(grid_current(UniformCurrent(1.2, 0.0), SQUARE), no_barriers(), 1.0)
    path = zermelo_path(waters, (3000.0, 2500.0), (2000.0, 2500.0))
    assert path.duration == math.inf
    assert path.track.shape == (0, 2)


@pytest.mark.parametrize("seed", range(5))
def test_no_path_nearby_is_faster(seed: int) -> None:
    """The track keeps its time when sailed leg by leg, and bending it either way loses time."""
    waters = Waters(vortices(seed), no_barriers(), 1.0)
    path = zermelo_path(waters, (300.0, 1500.0), (4700.0, 3500.0))
    assert path.track[0].tolist() == [300.0, 1500.0]
    assert path.track[-1].tolist() == [4700.0, 3500.0]
    sailed = track_time(waters.grid, path.track, 0.0, 1.0)
    assert sailed == pytest.approx(path.duration, rel=1e-4)
    share = np.linspace(0.0, 1.0, len(path.track))
    for waves in (1, 2, 3):
        for size in (-100.0, 100.0):
            bent = path.track.copy()
            bent[:, 1] += size * np.sin(waves * math.pi * share)
            assert track_time(waters.grid, bent, 0.0, 1.0) > sailed


def test_a_path_that_began_later_does_not_arrive_earlier() -> None:
    gyre = DoubleGyre(0.4, 2500.0, 0.3, math.tau / 4000.0, y0=1000.0)
    waters = Waters(grid_current(gyre, SQUARE, duration=12000.0), no_barriers(), 1.0)
    arrivals = []
    for begin in (0.0, 500.0, 1000.0, 1500.0):
        path = zermelo_path(waters, (300.0, 2000.0), (4700.0, 2500.0), begin=begin)
        assert track_time(waters.grid, path.track, begin, 1.0) == pytest.approx(
            path.duration, rel=1e-4
        )
        arrivals.append(begin + path.duration)
    assert (np.diff(arrivals) > 0.0).all()


def test_a_shorter_horizon_finds_nothing() -> None:
    waters = Waters(vortices(1), no_barriers(), 1.0)
    duration = zermelo_path(waters, (300.0, 1500.0), (4700.0, 3500.0)).duration
    late = zermelo_path(waters, (300.0, 1500.0), (4700.0, 3500.0), horizon=0.9 * duration)
    assert late.duration == math.inf


def test_a_path_to_the_start_takes_no_time() -> None:
    waters = Waters(vortices(1), no_barriers(), 1.0)
    assert zermelo_path(waters, (300.0, 400.0), (300.0, 400.0)).duration == 0.0


@given(u=flows, v=flows, east=places, north=places)
def test_uniform_flow_solves_its_quadratic(u: float, v: float, east: float, north: float) -> None:
    time = uniform_flow_time(u, v, east, north, 1.0)
    if math.isfinite(time):
        missed = math.hypot(east - u * time, north - v * time)
        assert missed == pytest.approx(time, rel=1e-6, abs=1e-6)


@given(u=flows, v=flows, east=places, north=places)
def test_uniform_flow_agrees_with_the_straight_leg(
    u: float, v: float, east: float, north: float
) -> None:
    grid = grid_current(UniformCurrent(u, v), SQUARE, step=1000.0)
    leg = leg_time(grid, 0.0, 0.0, east, north, 0.0, 1.0)
    if math.isfinite(leg):
        assert uniform_flow_time(u, v, east, north, 1.0) == pytest.approx(leg, rel=1e-6)


@pytest.mark.parametrize(
    ("flow", "east", "north", "time"),
    [
        (0.5, 300.0, 0.0, 200.0),
        (-0.5, 300.0, 0.0, 600.0),
        (-0.6, 0.0, 80.0, 100.0),
        (2.0, 300.0, 0.0, 100.0),
        (2.0, -300.0, 0.0, math.inf),
        (2.0, 0.0, 300.0, math.inf),
        (2.0, math.sqrt(3.0), 1.01, math.inf),
        (1.0, 300.0, 0.0, 150.0),
        (1.0, -300.0, 0.0, math.inf),
        (1.0, 0.0, 300.0, math.inf),
        (3.0, 0.0, 0.0, 0.0),
    ],
)
def test_closed_form(flow: float, east: float, north: float, time: float) -> None:
    assert uniform_flow_time(flow, 0.0, east, north, 1.0) == pytest.approx(time, rel=1e-12)
