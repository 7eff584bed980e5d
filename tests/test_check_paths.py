"""The judge of paths: its times against closed forms, and every kind of fault."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from fiveroute.check_paths import _metres_within, check_paths, sailing_time, times_of_paths
from fiveroute.instance import Circle, Fleet, Instance, Node, Ocean, Point, Polygon
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import LambVortices, Shear, Superposition, UniformCurrent
from fiveroute.paths.legs import track_time
from fiveroute.routes import Plan

STILL = Superposition(())
LINE = np.array([[0.0, 0.0], [1000.0, 0.0]])


def mission(ocean: Ocean) -> Instance:
    """From the west to the east, one node halfway."""
    return Instance(
        "line",
        (Node("a", 500.0, 0.0, 1.0),),
        Point(0.0, 0.0),
        Point(1000.0, 0.0),
        Fleet(1, 1.0, 5000.0),
        ocean=ocean,
    )


def straight() -> list[list[np.ndarray]]:
    return [[np.array([[0.0, 0.0], [500.0, 0.0]]), np.array([[500.0, 0.0], [1000.0, 0.0]])]]


def test_still_water() -> None:
    assert sailing_time(LINE, STILL, 2.0) == pytest.approx(500.0)


@pytest.mark.parametrize(("u", "v"), [(0.3, 0.0), (-0.3, 0.0), (0.0, 0.6), (0.2, -0.5)])
def test_uniform_current_with_the_crab_angle(u: float, v: float) -> None:
    made_good = u + math.sqrt(1.0 - v**2)
    assert sailing_time(LINE, UniformCurrent(u, v), 1.0) == pytest.approx(1000.0 / made_good)


@pytest.mark.parametrize(("u", "v"), [(-1.1, 0.0), (0.0, 1.0), (-0.8, 0.7)])
def test_too_strong_a_current(u: float, v: float) -> None:
    assert sailing_time(LINE, UniformCurrent(u, v), 1.0) == math.inf


def test_a_shear_by_quadrature() -> None:
    up = np.array([[0.0, 0.0], [0.0, 1000.0]])
    exact, _ = quad(lambda y: 1.0 / math.sqrt(1.0 - (5e-4 * y) ** 2), 0.0, 1000.0)
    assert sailing_time(up, Shear(5e-4), 1.0) == pytest.approx(exact, rel=1e-8)


def test_agrees_with_the_planners_in_a_field_of_vortices() -> None:
    """Two quadratures, one on the formula and one on a grid."""
    rng = np.random.default_rng(5)
    vortices = LambVortices(
        rng.uniform(0, 5e3, 8), rng.uniform(0, 5e3, 8), rng.normal(0, 900, 8), np.full(8, 500.0)
    )
    grid = grid_current(vortices, Region(-500.0, -500.0, 5500.0, 5500.0), tolerance=2e-4)
    for _ in range(10):
        track = np.cumsum(rng.uniform(0.0, 500.0, (9, 2)), axis=0)
        exact = sailing_time(track, vortices, 1.0)
        assert track_time(grid, track, 0.0, 1.0) == pytest.approx(exact, rel=1e-4)


def test_waypoints_twice_in_one_place() -> None:
    assert sailing_time(np.zeros((3, 2)), STILL, 1.0) == 0.0
    track = np.array([[0.0, 0.0], [0.0, 0.0], [3.0, 4.0]])
    assert sailing_time(track, STILL, 1.0) == pytest.approx(5.0)


def test_nothing_wrong() -> None:
    instance = mission(Ocean(obstacles=(Circle(500.0, 300.0, 299.0),)))
    plan = Plan.of([[1]])
    assert check_paths(instance, plan, straight(), STILL) == []
    times = times_of_paths(instance, plan, straight(), STILL)
    assert times[0, 1] == pytest.approx(500.0)
    assert math.isinf(times[0, 2])


def test_of_several_paths_for_one_leg_the_slowest_counts() -> None:
    """Two AUVs sail the direct leg, one of them round a corner."""
    corner = np.array([[0.0, 0.0], [1000.0, 500.0], [1000.0, 0.0]])
    slow = math.hypot(1000.0, 500.0) + 500.0
    for tracks in ([[LINE], [corner]], [[corner], [LINE]]):
        times = times_of_paths(mission(Ocean()), Plan.of([[], []]), tracks, STILL)
        assert times[0, 2] == pytest.approx(slow)


@pytest.mark.parametrize(
    ("ocean", "inside"),
    [
        (Ocean(obstacles=(Circle(250.0, 0.0, 50.0),)), 100.0),
        (Ocean(land=(Polygon(((100.0, -9.0), (200.0, -9.0), (200.0, 9.0), (100.0, 9.0))),)), 100.0),
    ],
)
def test_a_collision_and_how_long_it_lasts(ocean: Ocean, inside: float) -> None:
    violations = check_paths(mission(ocean), Plan.of([[1]]), straight(), STILL)
    assert [(v.kind, v.auv, v.node) for v in violations] == [("collision", 0, 1)]
    assert violations[0].amount == pytest.approx(inside, rel=1e-3)


def test_a_path_that_misses_its_node() -> None:
    tracks = straight()
    tracks[0][0] = np.array([[0.0, 0.0], [500.0, 30.0]])
    violations = check_paths(mission(Ocean()), Plan.of([[1]]), tracks, STILL)
    assert [(v.kind, v.node, v.amount) for v in violations] == [("path", 1, 30.0)]


def test_a_missing_leg() -> None:
    violations = check_paths(mission(Ocean()), Plan.of([[1]]), [straight()[0][:1]], STILL)
    assert [(v.kind, v.amount) for v in violations] == [("path", -1.0)]


def test_a_leg_against_too_strong_a_current() -> None:
    current = UniformCurrent(-2.0, 0.0)
    kinds = {v.kind for v in check_paths(mission(Ocean()), Plan.of([[1]]), straight(), current)}
    assert kinds == {"impassable"}


def test_metres_over_closed_cells() -> None:
    """Cells of 100 m about 0, 100, 200: the middle column is closed from 50 to 150 m."""
    cells = np.array([[False, True, False]] * 2)
    across = np.array([[0.0, 0.0], [200.0, 0.0]])
    assert _metres_within(across, cells, 0.0, 0.0, 100.0) == pytest.approx(100.0, abs=7.0)
    along = np.array([[20.0, 0.0], [20.0, 100.0]])
    assert _metres_within(along, cells, 0.0, 0.0, 100.0) == 0.0
