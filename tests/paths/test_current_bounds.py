import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.ocean.current_grid import CurrentGrid, Region, grid_current, velocity
from fiveroute.ocean.currents import LambVortices, Shear, UniformCurrent
from fiveroute.paths.current_bounds import fastest_bound, gradient_bound, gradient_within

SQUARE = Region(0.0, 0.0, 1000.0, 1000.0)


def rough(seed: int) -> CurrentGrid:
    uv = np.random.default_rng(seed).normal(0.0, 1.0, (1, 6, 7, 2))
    return CurrentGrid(uv, 100.0, -200.0, 50.0, 0.0, 1.0)


def test_a_uniform_current_has_no_gradient() -> None:
    assert gradient_bound(grid_current(UniformCurrent(0.3, 0.4), SQUARE)) == 0.0


def test_the_bound_of_shear_is_near_its_rate() -> None:
    grid = grid_current(Shear(1e-3), SQUARE)
    assert 1e-3 <= gradient_within(grid, 0, 300.0, 300.0, 700.0, 700.0) < 1.3e-3


@settings(deadline=None, max_examples=50)
@given(seed=st.integers(0, 10**6))
def test_the_bounds_hold_in_the_roughest_current(seed: int) -> None:
    """Anywhere, off the grid too, along any short way."""
    grid, rng = rough(seed), np.random.default_rng(seed)
    fastest, steepest = fastest_bound(grid), gradient_bound(grid)
    for x, y in rng.uniform((0.0, -300.0), (500.0, 150.0), (200, 2)):
        bearing = rng.uniform(0.0, math.tau)
        here = velocity(grid, x, y, 0.0)
        there = velocity(grid, x + 0.5 * math.cos(bearing), y + 0.5 * math.sin(bearing), 0.0)
        assert math.hypot(*here) <= fastest
        assert math.dist(here, there) <= 0.5 * steepest


@pytest.mark.parametrize("seed", range(10))
def test_the_gradient_of_a_rectangle_holds_in_it(seed: int) -> None:
    grid, rng = rough(seed), np.random.default_rng(seed)
    west, south = rng.uniform((80.0, -220.0), (250.0, -50.0))
    bound = gradient_within(grid, 0, west, south, west + 120.0, south + 40.0)
    assert bound <= gradient_bound(grid)
    points = rng.uniform((west, south), (west + 120.0, south + 40.0), (100, 2))
    for (x0, y0), (x1, y1) in pairwise(points):
        change = math.dist(velocity(grid, x0, y0, 0.0), velocity(grid, x1, y1, 0.0))
        assert change <= bound * math.hypot(x1 - x0, y1 - y0)


def test_far_from_a_vortex_the_gradient_is_that_of_its_far_field() -> None:
    """Gamma / (2 pi r^2) along the radius and across it alike."""
    one = LambVortices(*(np.array([value]) for value in (0.0, 0.0, 900.0, 300.0)))
    grid = grid_current(one, Region(-500.0, -500.0, 4500.0, 4500.0))
    bound = gradient_within(grid, 0, 3900.0, -50.0, 4000.0, 50.0)
    exact = 900.0 / (math.tau * 3900.0**2)
    assert exact < bound < 2.5 * exact
