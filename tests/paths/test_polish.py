import math

import numpy as np
import pytest

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import Current, Shear, UniformCurrent
from fiveroute.paths.path_cost import PathProblem, path_cost, path_problem
from fiveroute.paths.polish import merit, polish
from fiveroute.paths.waters import Waters

REGION = Region(-500.0, -2500.0, 4500.0, 2500.0)
START, GOAL = np.array([0.0, 0.0]), np.array([4000.0, 0.0])


def problem(current: Current, *circles: tuple[float, float, float]) -> PathProblem:
    barriers = no_barriers()._replace(circles=np.array(circles).reshape(-1, 3))
    waters = Waters(grid_current(current, REGION), barriers, 1.0)
    return path_problem(waters, START, GOAL, spans=6)


def bent(of: PathProblem, height: float) -> np.ndarray:
    control = of.straight.copy()
    control[:, 1] += height * np.sin(control[:, 0] / 4000.0 * math.pi)
    return control


def test_a_bent_path_becomes_straight_in_still_water_within_a_few_steps() -> None:
    of = problem(UniformCurrent(0.0, 0.0))
    control = bent(of, 800.0)
    reached = polish(of, control, 0.02, 15)
    assert reached == pytest.approx(4000.0, rel=1e-6)
    assert np.abs(control[:, 1]).max() < 5.0


def test_the_descent_never_ascends_and_tells_the_merit() -> None:
    of = problem(Shear(1e-4), (2000.0, 100.0, 400.0))
    control = bent(of, -300.0)
    before = merit(of, control, 0.02)
    reached = polish(of, control, 0.02, 10)
    assert reached < before
    assert reached == merit(of, control, 0.02)


def test_a_straight_path_stays_as_it_is() -> None:
    of = problem(UniformCurrent(0.2, 0.1))
    control = of.straight.copy()
    polish(of, control, 0.02, 10)
    assert control == pytest.approx(of.straight, abs=0.05)


def test_the_path_round_a_circle_is_two_tangents_and_an_arc() -> None:
    radius = 500.0
    of = problem(UniformCurrent(0.0, 0.0), (2000.0, 0.0, radius))
    control = bent(of, 900.0)
    polish(of, control, 0.02, 60)
    tangent = math.sqrt(2000.0**2 - radius**2)
    exact = 2.0 * tangent + 2.0 * radius * math.asin(radius / 2000.0)
    time, _ = path_cost(of, control)
    assert time == pytest.approx(exact, rel=2e-3)


def test_a_shear_bends_the_optimal_path_into_the_faster_water() -> None:
    """Zermelo's shear: the descent beats the best of all parabolas."""
    of = problem(Shear(2e-4))
    control = of.straight.copy()
    reached = polish(of, control, 0.02, 30)
    share = of.straight[:, 0] / 4000.0

    def parabola(height: float) -> np.ndarray:
        bow = of.straight.copy()
        bow[:, 1] += 4.0 * height * share * (1.0 - share)
        return bow

    parabolas = [path_cost(of, parabola(height))[0] for height in np.linspace(0.0, 1500.0, 61)]
    assert reached <= min(parabolas) < path_cost(of, of.straight)[0]
    assert reached == pytest.approx(min(parabolas), rel=2e-3)
