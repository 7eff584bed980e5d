import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import (
    Current,
    DoubleGyre,
    LambVortices,
    Shear,
    Superposition,
    UniformCurrent,
)
from fiveroute.paths.legs import track_time
from fiveroute.paths.reference_path import grid_path
from fiveroute.paths.straight_legs import are_straight, straight_gaps
from fiveroute.paths.waters import Waters
from fiveroute.paths.zermelo import zermelo_path

SQUARE = Region(-500.0, -500.0, 5500.0, 5500.0)


def waters(current: Current) -> Waters:
    return Waters(grid_current(current, SQUARE), no_barriers(), 1.0)


def straight_gap(water: Waters, start: ArrayLike, goal: ArrayLike) -> float:
    return float(straight_gaps(water, np.atleast_2d(start), np.atleast_2d(goal))[0])


def is_straight(water: Waters, start: ArrayLike, goal: ArrayLike) -> bool:
    return bool(are_straight(water, np.atleast_2d(start), np.atleast_2d(goal))[0])


def weak(seed: int, strength: float, flow: float = 0.0) -> Current:
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(0.0, 5000.0, (2, 8))
    lamb = LambVortices(x, y, rng.normal(0.0, strength, 8), rng.uniform(300.0, 700.0, 8))
    return Superposition((lamb, UniformCurrent(*rng.normal(0.0, flow, 2))))


@pytest.mark.parametrize("flow", [(0.0, 0.0), (0.3, -0.2), (-0.4, 0.3), (0.1, 0.6)])
def test_every_leg_in_uniform_flow_is_straight(flow: tuple[float, float]) -> None:
    assert straight_gap(waters(UniformCurrent(*flow)), (300.0, 900.0), (4000.0, 3000.0)) < 1e-12


@settings(deadline=None, max_examples=40)
@given(
    seed=st.integers(0, 10**6),
    strength=st.floats(-1.0, 2.5).map(lambda power: 10.0**power),
    flow=st.sampled_from([0.0, 0.2]),
    length=st.floats(100.0, 2000.0),
)
def test_the_proved_gap_holds(seed: int, strength: float, flow: float, length: float) -> None:
    water = waters(weak(seed, strength, flow))
    rng = np.random.default_rng(seed)
    start, bearing = rng.uniform(1000.0, 4000.0, 2), rng.uniform(0.0, math.tau)
    goal = start + length * np.array([math.cos(bearing), math.sin(bearing)])
    straight = track_time(water.grid, np.array([start, goal]), 0.0, 1.0)
    proved = straight_gap(water, start, goal)
    if math.isfinite(straight):
        best = min(
            zermelo_path(water, start, goal).duration,
            grid_path(water, start, goal, step=length / 20.0).duration,
        )
        assert straight <= (1.0 + proved) * best * (1.0 + 1e-8)


def test_the_proved_gap_is_of_second_order() -> None:
    gaps = [
        straight_gap(waters(weak(1, size)), (1000.0, 1000.0), (1400.0, 1300.0))
        for size in (1.0, 2.0)
    ]
    assert 0.0 < gaps[0] < 1e-5
    assert gaps[1] / gaps[0] == pytest.approx(4.0, rel=0.1)


def test_the_gain_of_bending_in_shear_is_within_the_proved_gap_and_not_far_below() -> None:
    """Across shear with rate a the gain is (a L / V)^2 / 24 to first order."""
    water = waters(Shear(1e-5, 2500.0))
    start, goal = (1000.0, 2500.0), (3000.0, 2500.0)
    straight = track_time(water.grid, np.array([start, goal]), 0.0, 1.0)
    gain = straight / zermelo_path(water, start, goal).duration - 1.0
    assert gain == pytest.approx((1e-5 * 2000.0) ** 2 / 24.0, rel=0.05)
    assert gain < straight_gap(water, start, goal) < 100.0 * gain


def test_near_strong_vortices_no_leg_is_taken_for_straight() -> None:
    water = waters(weak(3, 900.0))
    assert not is_straight(water, (300.0, 1000.0), (4700.0, 4000.0))


def test_a_leg_through_an_obstacle_is_not_straight() -> None:
    water = waters(UniformCurrent(0.1, 0.0))
    assert is_straight(water, (300.0, 1000.0), (4700.0, 4000.0))
    circles = no_barriers()._replace(circles=np.array([[2500.0, 2500.0, 100.0]]))
    blocked = Waters(water.grid, circles, 1.0)
    assert not is_straight(blocked, (300.0, 1000.0), (4700.0, 4000.0))
    assert is_straight(blocked, (300.0, 1000.0), (4700.0, 1000.0))


def test_nothing_is_proved_in_a_current_that_varies() -> None:
    gyre = DoubleGyre(0.01, 2500.0, 0.3, 1e-3)
    varying = Waters(grid_current(gyre, SQUARE, duration=1000.0), no_barriers(), 1.0)
    assert straight_gap(varying, (300.0, 400.0), (500.0, 600.0)) == math.inf


def test_nothing_is_proved_where_the_leg_cannot_be_sailed() -> None:
    water = waters(UniformCurrent(1.2, 0.0))
    assert straight_gap(water, (1000.0, 1000.0), (500.0, 1000.0)) == math.inf


def test_many_legs_are_judged_as_one_by_one() -> None:
    circles = no_barriers()._replace(circles=np.array([[2500.0, 2500.0, 600.0]]))
    water = Waters(waters(weak(1, 2.0)).grid, circles, 1.0)
    starts, goals = np.random.default_rng(1).uniform(1000.0, 4000.0, (2, 40, 2))
    together = are_straight(water, starts, goals)
    assert together.tolist() == [
        is_straight(water, start, goal) for start, goal in zip(starts, goals, strict=True)
    ]
    assert 5 < together.sum() < 35
