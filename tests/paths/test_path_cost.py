import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import BSpline

from fiveroute.ocean.barriers import Barriers, no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import Current, LambVortices, Shear, UniformCurrent
from fiveroute.paths.path_cost import (
    PathProblem,
    collision,
    cost_between,
    path_cost,
    path_problem,
    shortfall,
)
from fiveroute.paths.spline import gauss_table, regular_table
from fiveroute.paths.waters import Waters

REGION = Region(-500.0, -2000.0, 4500.0, 2000.0)
START, GOAL = np.array([0.0, 0.0]), np.array([4000.0, 0.0])
VORTEX = LambVortices(np.array([1800.0]), np.array([400.0]), np.array([1200.0]), np.array([600.0]))


def waters(current: Current, *circles: tuple[float, float, float], radius: float = 0.0) -> Waters:
    barriers = no_barriers()._replace(circles=np.array(circles).reshape(-1, 3))
    return Waters(grid_current(current, REGION), barriers, 1.0, radius)


def problem(of: Waters, spans: int = 3, parts: int = 12) -> PathProblem:
    return path_problem(of, START, GOAL, spans=spans)._replace(nodes=gauss_table(spans, parts))


def bent(of: PathProblem, height: float) -> np.ndarray:
    control = of.straight.copy()
    control[1:-1, 1] += height
    return control


def test_the_time_is_the_integral_of_the_slowness_along_the_path() -> None:
    """(22) and (11) with the crab angle, by adaptive quadrature of the current itself."""
    of = problem(waters(VORTEX))
    control = bent(of, -300.0)
    knots = [0, 0, 0, 0, 1, 2, 3, 3, 3, 3]
    curve = BSpline(np.array(knots, dtype=float), control, 3)

    def slowness(w: float) -> float:
        (x, y), (dx, dy) = curve(w), curve(w, 1)
        pace = math.hypot(dx, dy)
        u, v = (float(part) for part in VORTEX(x, y))
        along, across = (u * dx + v * dy) / pace, (v * dx - u * dy) / pace
        return float(pace / (along + math.sqrt(1.0 - across**2)))

    exact, _ = quad(slowness, 0.0, 3.0, points=[1.0, 2.0], epsabs=1e-6, epsrel=1e-12)
    time, violation = path_cost(of, control)
    assert time == pytest.approx(exact, rel=2e-4)
    assert violation == 0.0


def test_the_quadrature_converges() -> None:
    times = [
        path_cost(problem(waters(VORTEX), parts=parts), bent(problem(waters(VORTEX)), 300.0))[0]
        for parts in (2, 6, 18)
    ]
    assert abs(times[1] - times[2]) < abs(times[0] - times[2]) / 20.0


def test_a_uniform_current_has_its_closed_form() -> None:
    of = problem(waters(UniformCurrent(0.3, 0.4)))
    time, violation = path_cost(of, of.straight)
    assert time == pytest.approx(4000.0 / (0.3 + math.sqrt(1.0 - 0.4**2)), rel=1e-13)
    assert violation == 0.0


def test_parts_of_a_path_add_up_in_a_steady_current() -> None:
    of = problem(waters(VORTEX))
    control = bent(of, 200.0)
    parts = [cost_between(of, control, k, k + 1)[0] for k in range(3)]
    assert sum(parts) == pytest.approx(path_cost(of, control)[0], rel=1e-13)


@pytest.mark.parametrize(("u", "v"), [(-1.2, 0.0), (0.0, 1.3), (-0.99999, 0.0)])
def test_too_strong_a_current_breaks_the_rules(u: float, v: float) -> None:
    of = problem(waters(UniformCurrent(u, v)))
    time, violation = path_cost(of, of.straight)
    assert math.isfinite(time)
    assert violation > 0.0


def test_more_is_missing_in_a_stronger_current() -> None:
    missing = [shortfall(-speed, 0.0, 1.0, 0.0, 1.0) for speed in (1.0, 1.1, 1.5)]
    assert missing == sorted(missing)
    assert 0.0 < missing[0] < missing[1] < missing[2]
    assert shortfall(0.0, 1.5, 1.0, 0.0, 1.0) > shortfall(0.0, 1.2, 1.0, 0.0, 1.0) > 0.0


def test_a_path_clear_of_all_obstacles_by_the_buffer_keeps_the_rules() -> None:
    still = UniformCurrent(0.0, 0.0)
    for spare, free in ((1.0, True), (-1.0, False), (-300.0, False)):
        of = problem(waters(still, (2000.0, 350.0, 350.0 - 0.4 - spare)))
        assert (path_cost(of, of.straight)[1] == 0.0) == free


def test_the_collision_is_the_integral_of_the_squared_depth() -> None:
    """Along the x axis under a circle that reaches 30 m below it, guarded densely."""
    of = problem(waters(UniformCurrent(0.0, 0.0), (2000.0, 370.0, 400.0)))
    of = of._replace(guards=regular_table(3, 2000), buffer=5.0)

    def depth(x: float) -> float:
        clear = math.hypot(x - 2000.0, 370.0) - 400.0
        return (max(0.0, of.buffer - clear) / of.buffer) ** 2

    exact, _ = quad(depth, 1500.0, 2500.0, epsabs=1e-9, limit=200)
    assert collision(of, of.straight, 0, 3) == pytest.approx(exact, rel=1e-4)


def test_skipping_free_water_loses_no_collision() -> None:
    rng = np.random.default_rng(3)
    circles = np.column_stack(
        [rng.uniform(500, 3500, 8), rng.uniform(-900, 900, 8), np.full(8, 90)]
    )
    of = problem(waters(UniformCurrent(0.0, 0.0), *map(tuple, circles.tolist())))
    for _ in range(30):
        control = bent(of, 0.0)
        control[1:-1] += rng.normal(0.0, 400.0, (4, 2))
        points = basis_points(of, control)
        clear = np.hypot(*(points[:, None, :] - circles[None, :, :2]).transpose(2, 0, 1)) - 90.0
        assert (collision(of, control, 0, 3) > 0.0) == bool((clear < of.buffer).any())


def basis_points(of: PathProblem, control: np.ndarray) -> np.ndarray:
    local = control[of.guards.first[:, None] + np.arange(4)]
    return np.asarray(np.einsum("ki,kix->kx", of.guards.value, local))


def test_a_bend_tighter_than_the_turning_radius_breaks_the_rules() -> None:
    for radius, free in ((100.0, True), (5000.0, False)):
        of = problem(waters(UniformCurrent(0.0, 0.0), radius=radius))
        assert (path_cost(of, bent(of, 500.0))[1] == 0.0) == free


def test_a_path_in_a_current_that_varies_meets_it_at_its_own_time() -> None:
    """The current sets in halfway through: u = rate t, g = 1 + rate t, x = t + rate t^2 / 2."""
    steady = grid_current(UniformCurrent(0.0, 0.0), REGION)
    uv = np.concatenate([steady.uv, steady.uv])
    rate = 1e-4
    uv[1, ..., 0] = rate * 10_000.0
    grid = steady._replace(uv=uv, every=10_000.0)
    of = problem(Waters(grid, no_barriers(), 1.0))
    exact = (math.sqrt(1.0 + 2.0 * rate * 4000.0) - 1.0) / rate
    assert path_cost(of, of.straight)[0] == pytest.approx(exact, rel=1e-4)


def test_a_shear_is_slower_against_than_with_it() -> None:
    of = problem(waters(Shear(2e-4)))
    assert path_cost(of, bent(of, 300.0))[0] < path_cost(of, bent(of, -300.0))[0]


def test_polygons_are_obstacles_too() -> None:
    corners = np.array([[1800.0, -50.0], [2200.0, -50.0], [2000.0, 300.0]])
    barriers: Barriers = no_barriers()._replace(corners=corners, first=np.array([0, 3]))
    of = problem(Waters(grid_current(UniformCurrent(0.0, 0.0), REGION), barriers, 1.0))
    assert path_cost(of, of.straight)[1] > 0.0
    assert path_cost(of, bent(of, -400.0))[1] == 0.0
