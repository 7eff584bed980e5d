import math

import numpy as np
import pytest

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import DoubleGyre, UniformCurrent
from fiveroute.paths.legs import track_clearance, track_time
from fiveroute.paths.straighten import straighten

SQUARE = Region(0.0, 0.0, 4000.0, 4000.0)
STILL = grid_current(UniformCurrent(0.0, 0.0), SQUARE)
STAIRS = np.array(
    [[x, y] for k in range(9) for x, y in ((400.0 * k, 400.0 * k), (400.0 * k + 400.0, 400.0 * k))]
)


def test_stairs_in_still_water_become_a_straight_line() -> None:
    before = STAIRS.copy()
    track = straighten(STILL, no_barriers(), STAIRS, 0.0, 1.0, 500.0)
    assert (before == STAIRS).all()
    exact = math.dist(STAIRS[0], STAIRS[-1])
    assert track_time(STILL, track, 0.0, 1.0) == pytest.approx(exact, rel=1e-12)
    assert np.hypot(*np.diff(track, axis=0).T).max() <= 500.0


def test_an_obstacle_is_rounded_as_close_as_may_be() -> None:
    """Along two tangents and an arc."""
    pillar = no_barriers()._replace(circles=np.array([[2000.0, 2000.0, 600.0]]))
    bearings = np.linspace(math.pi, 0.0, 9)[1:-1]
    arc = 2000.0 + 800.0 * np.column_stack([np.cos(bearings), np.sin(bearings)])
    rough = np.vstack([[0.0, 2000.0], arc, [4000.0, 2000.0]])
    track = straighten(STILL, pillar, rough, 0.0, 1.0, 50.0)
    assert track_clearance(pillar, track) >= 0.0
    exact = 2.0 * math.sqrt(2000.0**2 - 600.0**2) + 600.0 * (math.pi - 2.0 * math.acos(0.3))
    assert exact <= track_time(STILL, track, 0.0, 1.0) < exact * 1.001


@pytest.mark.parametrize("longest", [100.0, 400.0])
def test_nobody_arrives_later_in_a_varying_current(longest: float) -> None:
    grid = grid_current(DoubleGyre(0.5, 2000.0, 0.3, math.tau / 2000.0), SQUARE, duration=9000.0)
    track = straighten(grid, no_barriers(), STAIRS, 500.0, 1.0, longest)
    assert track[[0, -1]].tolist() == STAIRS[[0, -1]].tolist()
    assert track_time(grid, track, 500.0, 1.0) < 0.9 * track_time(grid, STAIRS, 500.0, 1.0)
