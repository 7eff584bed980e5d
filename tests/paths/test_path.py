import math

import numpy as np
import pytest

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import UniformCurrent
from fiveroute.paths.path import Path, PathStatus, track_curvature, track_path
from fiveroute.paths.waters import Waters

CIRCLE = no_barriers()._replace(circles=np.array([[500.0, 0.0, 100.0]]))
STRAIGHT = np.array([[0.0, 0.0], [1000.0, 0.0]])


def waters(u: float = 0.0, v: float = 0.0, radius: float = 0.0, blocked: bool = False) -> Waters:
    grid = grid_current(UniformCurrent(u, v), Region(-100.0, -500.0, 1100.0, 500.0))
    return Waters(grid, CIRCLE if blocked else no_barriers(), 1.0, radius)


def test_a_path_tells_what_is_true_of_its_track() -> None:
    path = track_path(waters(0.25), STRAIGHT, 0.0)
    assert path.is_found
    assert path.duration == pytest.approx(800.0)
    assert path.max_curvature == 0.0
    assert path.min_clearance == math.inf


def test_a_track_that_is_none_says_why_and_has_no_figures() -> None:
    corner = np.array([[0.0, 0.0], [500.0, 200.0], [1000.0, 0.0]])
    asked = {
        PathStatus.BLOCKED: track_path(waters(blocked=True), STRAIGHT, 0.0),
        PathStatus.AGAINST_CURRENT: track_path(waters(-1.1), STRAIGHT, 0.0),
        PathStatus.TOO_TIGHT: track_path(waters(radius=900.0), corner, 0.0),
    }
    for status, path in asked.items():
        assert path.status is status
        assert not path.is_found
        assert path.duration == math.inf
        assert path.waypoints.shape == (0, 2)


def test_touching_is_not_passing() -> None:
    grazing = np.array([[0.0, 100.0], [1000.0, 100.0]])
    assert track_path(waters(blocked=True), grazing, 0.0).status is PathStatus.BLOCKED
    assert track_path(waters(blocked=True), grazing + np.array([0.0, 0.01]), 0.0).is_found


def test_the_curvature_of_a_track_is_that_of_the_circle_it_follows() -> None:
    angle = np.linspace(0.0, 2.0, 60)
    arc = 250.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    assert track_curvature(arc) == pytest.approx(1.0 / 250.0, rel=1e-3)
    assert track_curvature(np.repeat(arc, 2, axis=0)) == pytest.approx(1.0 / 250.0, rel=1e-3)
    assert track_curvature(STRAIGHT) == 0.0


def test_nothing_is_found_by_default_only_if_told() -> None:
    assert Path(status=PathStatus.BLOCKED).duration == math.inf
