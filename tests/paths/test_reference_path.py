import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import Barriers, no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import (
    Current,
    DoubleGyre,
    LambVortices,
    Superposition,
    UniformCurrent,
)
from fiveroute.paths.grid_search import stencil
from fiveroute.paths.legs import track_clearance, track_time
from fiveroute.paths.reference_path import grid_path, grid_paths
from fiveroute.paths.waters import Waters
from fiveroute.paths.zermelo import uniform_flow_time, zermelo_path

SQUARE = Region(-500.0, -500.0, 5500.0, 5500.0)


def waters(current: Current, barriers: Barriers | None = None, duration: float = 0.0) -> Waters:
    grid = grid_current(current, SQUARE, duration=duration)
    return Waters(grid, barriers or no_barriers(SQUARE), speed=1.0)


def vortices(seed: int, count: int = 8, strength: float = 900.0) -> LambVortices:
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(0.0, 5000.0, (2, count))
    return LambVortices(x, y, rng.normal(0.0, strength, count), rng.uniform(300.0, 700.0, count))


STILL = waters(UniformCurrent(0.0, 0.0))
CIRCLES = no_barriers(SQUARE)._replace(
    circles=np.array([[2500.0, 2500.0, 700.0], [3500.0, 1200.0, 400.0], [1500.0, 3800.0, 500.0]])
)


def test_a_stencil_has_one_move_in_every_direction() -> None:
    moves = stencil(6)
    assert len(moves) == 96
    assert len(np.unique(np.arctan2(moves[:, 0], moves[:, 1]).round(12))) == 96


def test_still_water_is_crossed_in_a_straight_line() -> None:
    path = grid_path(STILL, (312.3, 77.7), (4711.1, 3999.9))
    assert path.duration == math.hypot(4711.1 - 312.3, 3999.9 - 77.7)
    assert path.track.tolist() == [[312.3, 77.7], [4711.1, 3999.9]]


@settings(deadline=None, max_examples=15)
@given(
    heading=st.floats(0.0, math.tau),
    flow=st.floats(0.0, 0.8),
    bearing=st.floats(0.0, math.tau),
)
def test_uniform_flow_takes_its_closed_form(heading: float, flow: float, bearing: float) -> None:
    u, v = flow * math.cos(heading), flow * math.sin(heading)
    goal = np.array([2500.0 + 1700.0 * math.cos(bearing), 2500.0 + 1700.0 * math.sin(bearing)])
    path = grid_path(waters(UniformCurrent(u, v)), (2500.0, 2500.0), goal, step=300.0)
    east, north = goal - 2500.0
    exact = uniform_flow_time(u, v, east, north, 1.0)
    assert path.duration == pytest.approx(exact, rel=1e-9)


def test_nobody_gets_upstream_of_too_strong_a_current() -> None:
    path = grid_path(waters(UniformCurrent(1.2, 0.0)), (2500.0, 2500.0), (1000.0, 2500.0), step=300)
    assert path.duration == math.inf
    assert path.track.shape == (0, 2)


def test_a_jet_too_strong_to_be_sailed_against_is_passed_round() -> None:
    """Two vortices drive a jet eastward between them."""
    centres, strength, radius = np.array([1500.0, 3500.0]), 4000.0, np.full(2, 500.0)
    pair = LambVortices(np.full(2, 2500.0), centres, np.array([-strength, strength]), radius)
    water = waters(pair)
    start, goal = np.array([3400.0, 2500.0]), np.array([1600.0, 2500.0])
    assert math.isinf(track_time(water.grid, np.array([start, goal]), 0.0, 1.0))
    against = grid_path(water, start, goal)
    assert math.isfinite(against.duration)
    assert against.duration > 2.0 * grid_path(water, goal, start).duration


@pytest.mark.parametrize("seed", range(4))
def test_the_search_converges_to_zermelos_path(seed: int) -> None:
    water = waters(vortices(seed))
    start, goal = (300.0, 1000.0 + 900.0 * seed), (4700.0, 4000.0 - 700.0 * seed)
    exact = zermelo_path(water, start, goal).duration
    gaps = {}
    for cells in (50, 100):
        for straight in (False, True):
            path = grid_path(water, start, goal, step=6000.0 / cells, straight=straight)
            gaps[cells, straight] = path.duration / exact - 1.0
    assert all(gap > -1e-5 for gap in gaps.values())
    assert gaps[100, False] < 4e-3
    assert gaps[50, True] < 5e-4
    assert gaps[100, True] < 1e-4
    assert gaps[100, True] <= gaps[100, False]


def test_a_round_obstacle_is_passed_along_its_tangents() -> None:
    radius, half = 800.0, 2000.0
    round_one = no_barriers(SQUARE)._replace(circles=np.array([[2500.0, 2500.0, radius]]))
    water = waters(UniformCurrent(0.0, 0.0), round_one)
    path = grid_path(water, (2500.0 - half, 2500.0), (2500.0 + half, 2500.0))
    tangent = math.sqrt(half**2 - radius**2)
    exact = 2.0 * tangent + radius * (math.pi - 2.0 * math.acos(radius / half))
    assert exact <= path.duration < exact * 1.0005
    assert track_clearance(round_one, path.track) >= 0.0


@pytest.mark.parametrize("seed", range(3))
def test_paths_keep_clear_and_last_what_they_say(seed: int) -> None:
    water = waters(vortices(seed, strength=1500.0), CIRCLES)
    goals = np.array([[4700.0, 3000.0], [2500.0, 3300.0], [100.0, 4900.0]])
    for path, goal in zip(grid_paths(water, (300.0, 900.0), goals), goals, strict=True):
        assert path.track[0].tolist() == [300.0, 900.0]
        assert path.track[-1].tolist() == goal.tolist()
        assert track_clearance(CIRCLES, path.track) >= 0.0
        assert path.duration == track_time(water.grid, path.track, 0.0, 1.0)


def test_one_run_for_many_goals_agrees_with_a_run_for_each() -> None:
    water = waters(vortices(7), CIRCLES)
    goals = np.random.default_rng(7).uniform(0.0, 1000.0, (12, 2))
    goals[6:] += 4000.0
    together = [p.duration for p in grid_paths(water, (700.0, 2500.0), goals, straight=False)]
    alone = [grid_path(water, (700.0, 2500.0), goal, straight=False).duration for goal in goals]
    assert together == pytest.approx(alone, rel=1e-5)


def test_the_way_back_takes_another_time() -> None:
    water = waters(vortices(3))
    there = grid_path(water, (300.0, 2500.0), (4700.0, 2500.0)).duration
    back = grid_path(water, (4700.0, 2500.0), (300.0, 2500.0)).duration
    assert abs(there / back - 1.0) > 0.01


def test_obstacles_in_the_way_of_all_paths_leave_no_path() -> None:
    ring = np.linspace(0.0, math.tau, 40, endpoint=False)
    circles = np.column_stack(
        [3000.0 + 900.0 * np.cos(ring), 3000.0 + 900.0 * np.sin(ring), np.full(40, 100.0)]
    )
    water = waters(UniformCurrent(0.1, 0.0), no_barriers(SQUARE)._replace(circles=circles))
    goals = [(3000.0, 3000.0), (5000.0, 5000.0)]
    times = [path.duration for path in grid_paths(water, (500.0, 500.0), goals)]
    assert math.isinf(times[0])
    assert math.isfinite(times[1])


def test_a_start_inside_an_obstacle_reaches_nothing() -> None:
    water = waters(UniformCurrent(0.0, 0.0), CIRCLES)
    assert math.isinf(grid_path(water, (2500.0, 2400.0), (300.0, 300.0)).duration)
    assert math.isinf(grid_path(water, (300.0, 300.0), (2500.0, 2400.0)).duration)


def test_a_polygon_is_passed_at_its_corner() -> None:
    wall = np.array([[2000.0, -600.0], [3000.0, -600.0], [3000.0, 3000.0], [2000.0, 4000.0]])
    barriers = no_barriers(SQUARE)._replace(corners=wall, first=np.array([0, 4], dtype=np.int64))
    path = grid_path(waters(UniformCurrent(0.0, 0.0), barriers), (500.0, 2500.0), (4500.0, 2500.0))
    exact = math.hypot(1500.0, 1500.0) + math.hypot(2500.0, 1500.0)
    assert exact - 1e-6 <= path.duration < exact * 1.001


def test_paths_keep_within_the_region() -> None:
    """A current beyond the border would help, but must not be used."""
    strip = no_barriers(Region(-500.0, 2000.0, 5500.0, 3000.0))
    water = waters(vortices(1, strength=2500.0), strip)
    path = grid_path(water, (300.0, 2500.0), (4700.0, 2500.0))
    assert path.track[:, 1].min() >= 2000.0
    assert path.track[:, 1].max() <= 3000.0
    assert (
        path.duration
        > grid_path(
            waters(vortices(1, strength=2500.0)), (300.0, 2500.0), (4700.0, 2500.0)
        ).duration
    )


def test_a_varying_current_makes_the_begin_matter() -> None:
    gyre = Superposition((DoubleGyre(0.4, 2500.0, 0.3, math.tau / 4000.0, y0=1000.0),))
    water = waters(gyre, duration=12000.0)
    times = []
    for begin in (0.0, 2000.0):
        path = grid_path(water, (300.0, 2000.0), (4700.0, 2500.0), begin=begin)
        exact = zermelo_path(water, (300.0, 2000.0), (4700.0, 2500.0), begin=begin)
        assert path.duration == pytest.approx(exact.duration, rel=5e-4)
        assert path.duration == track_time(water.grid, path.track, begin, 1.0)
        times.append(path.duration)
    assert abs(times[0] / times[1] - 1.0) > 0.01


def test_a_path_to_the_start_takes_no_time() -> None:
    assert grid_path(STILL, (300.0, 400.0), (300.0, 400.0)).duration == 0.0


def test_open_water_needs_no_rectangle() -> None:
    water = Waters(waters(vortices(2)).grid, no_barriers(), 1.0)
    inside = grid_path(waters(vortices(2)), (1500.0, 1000.0), (4000.0, 3000.0)).duration
    assert grid_path(water, (1500.0, 1000.0), (4000.0, 3000.0)).duration == pytest.approx(
        inside, rel=2e-4
    )


def test_a_lattice_needs_a_spacing_and_a_reach() -> None:
    with pytest.raises(InputError, match="spacing"):
        grid_path(STILL, (0.0, 0.0), (1.0, 1.0), step=0.0)
    with pytest.raises(InputError, match="one cell"):
        grid_path(STILL, (0.0, 0.0), (1.0, 1.0), radius=0)
    with pytest.raises(InputError, match="finite"):
        grid_path(STILL, (0.0, math.nan), (1.0, 1.0))
