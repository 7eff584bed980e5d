import math
import threading

import numpy as np
import pytest
import shapely

from fiveroute.errors import InputError
from fiveroute.limits import Limits
from fiveroute.ocean.barriers import Barriers, no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import Current, LambVortices, UniformCurrent
from fiveroute.paths.differential_evolution import Variant
from fiveroute.paths.evolved_path import THOROUGH, DifferentialEvolution, evolve_path
from fiveroute.paths.legs import track_time
from fiveroute.paths.path import PathStatus
from fiveroute.paths.waters import Waters

REGION = Region(-1000.0, -2500.0, 5000.0, 2500.0)
START, GOAL = (0.0, 0.0), (4000.0, 0.0)
STILL = UniformCurrent(0.0, 0.0)
VORTICES = LambVortices(
    np.array([1200.0, 2700.0]),
    np.array([300.0, -200.0]),
    np.array([1500.0, -1200.0]),
    np.array([600.0, 500.0]),
)
POLYGON = np.array([[1600.0, -500.0], [2400.0, -300.0], [2300.0, 600.0], [1500.0, 300.0]])


def waters(current: Current, barriers: Barriers | None = None, radius: float = 0.0) -> Waters:
    return Waters(grid_current(current, REGION), barriers or no_barriers(), 1.0, radius)


def circles(*circles: tuple[float, float, float]) -> Barriers:
    return no_barriers()._replace(circles=np.array(circles).reshape(-1, 3))


def polygons(*parts: np.ndarray) -> Barriers:
    first = np.cumsum([0, *(len(part) for part in parts)], dtype=np.int64)
    return no_barriers()._replace(corners=np.concatenate(parts), first=first)


def test_still_water_is_crossed_in_a_straight_line_to_machine_precision() -> None:
    goal = np.array([3100.0, -1700.0])
    path = evolve_path(waters(STILL), START, goal)
    assert path.duration == pytest.approx(math.hypot(*goal), rel=1e-14)
    across = path.waypoints @ np.array([1700.0, 3100.0]) / math.hypot(*goal)
    assert np.abs(across).max() < 1e-9
    assert path.max_curvature < 1e-12


@pytest.mark.parametrize(("u", "v"), [(0.4, 0.0), (-0.5, 0.3), (0.1, -0.8)])
def test_a_uniform_current_has_its_closed_form(u: float, v: float) -> None:
    path = evolve_path(waters(UniformCurrent(u, v)), START, GOAL)
    assert path.duration == pytest.approx(4000.0 / (u + math.sqrt(1.0 - v * v)), rel=1e-12)


def test_a_circle_in_still_water_is_passed_on_two_tangents_and_an_arc() -> None:
    radius = 600.0
    path = evolve_path(waters(STILL, circles((2000.0, 50.0, radius))), START, GOAL)
    to, beyond = math.hypot(2000.0, 50.0), math.asin(50.0 / math.hypot(2000.0, 50.0))
    arc = 2.0 * (math.asin(radius / to) - beyond) * radius  # on the side away from the centre
    exact = 2.0 * math.sqrt(to**2 - radius**2) + arc
    assert exact < path.duration < 1.0005 * exact
    assert path.waypoints[:, 1].min() < -500.0


def test_a_polygon_in_still_water_is_passed_by_its_corners() -> None:
    path = evolve_path(waters(STILL, polygons(POLYGON)), START, GOAL)
    by = [START, *POLYGON[:2].tolist(), GOAL]
    assert path.duration == pytest.approx(shapely.LineString(by).length, rel=1e-3)
    assert path.min_clearance > 0.0


def test_obstacles_are_avoided_as_another_library_sees_them() -> None:
    rng = np.random.default_rng(8)
    for _ in range(3):
        places = np.column_stack([rng.uniform(800, 3200, 4), rng.uniform(-700, 700, 4)])
        spread = rng.uniform(100, 350, 4)
        corners = POLYGON + np.array([-900.0, 500.0])
        barriers = polygons(corners)._replace(circles=np.column_stack([places, spread]))
        path = evolve_path(waters(VORTICES, barriers), START, GOAL)
        track = shapely.LineString(path.waypoints)
        solid = [shapely.Polygon(corners)]
        solid += [shapely.Point(p).buffer(r, 256) for p, r in zip(places, spread, strict=True)]
        assert track.distance(shapely.unary_union(solid)) > 0.0
        nearest = track.distance(shapely.unary_union(solid))
        assert path.min_clearance == pytest.approx(nearest, abs=0.02)


def test_the_path_has_its_ends_and_its_own_duration() -> None:
    for begin in (0.0, 500.0):
        water = waters(VORTICES)
        path = evolve_path(water, START, GOAL, begin=begin)
        assert path.waypoints[[0, -1]].tolist() == [list(START), list(GOAL)]
        assert path.duration == track_time(water.grid, path.waypoints, begin, 1.0)
        straight = track_time(water.grid, np.array([START, GOAL]), begin, 1.0)
        assert path.duration < 0.98 * straight


def test_there_is_better_than_back_again() -> None:
    """With the vortices one way, against them the other: legs are not symmetric."""
    there = evolve_path(waters(VORTICES), START, GOAL).duration
    back = evolve_path(waters(VORTICES), GOAL, START).duration
    assert abs(there - back) > 10.0


@pytest.mark.parametrize("variant", ["l-shade", "rand/1/bin"])
def test_more_effort_finds_no_much_better_path(variant: Variant) -> None:
    barriers = circles((2000.0, -100.0, 300.0))
    quick = evolve_path(
        waters(VORTICES, barriers), START, GOAL, options=DifferentialEvolution(variant)
    )
    thorough = evolve_path(waters(VORTICES, barriers), START, GOAL, options=THOROUGH)
    assert thorough.duration <= quick.duration < 1.001 * thorough.duration


def test_the_same_seed_gives_the_same_path() -> None:
    water = waters(VORTICES, circles((2000.0, 0.0, 500.0)))
    one, two = (evolve_path(water, START, GOAL, rng=7) for _ in range(2))
    assert np.array_equal(one.waypoints, two.waypoints)


def test_a_guess_shows_the_way_through_a_maze() -> None:
    """Three walls with gaps at opposite ends; no straight line, arc or detour passes them."""
    walls = [
        np.array([[x, low], [x + 60.0, low], [x + 60.0, low + 4000.0], [x, low + 4000.0]])
        for x, low in ((1000.0, -3500.0), (2000.0, -500.0), (3000.0, -3500.0))
    ]
    guess = np.array(
        [START, (1030.0, 800.0), (2030.0, -800.0), (3030.0, 800.0), GOAL], dtype=np.float64
    )
    water = waters(STILL, polygons(*walls))
    path = evolve_path(water, START, GOAL, guesses=[guess])
    corners = [START, (1000, 500), (1060, 500), (2000, -500), (2060, -500), (3000, 500)]
    exact = shapely.LineString([*corners, (3060, 500), GOAL]).length
    assert exact < path.duration < 1.01 * exact
    assert path.duration < track_time(water.grid, guess, 0.0, 1.0)


def test_the_turning_radius_bounds_the_curvature() -> None:
    corner = polygons(np.array([[1700.0, -2000.0], [2300.0, -2000.0], [2000.0, 900.0]]))
    free = evolve_path(waters(STILL, corner), START, GOAL)
    bound = evolve_path(waters(STILL, corner, radius=500.0), START, GOAL)
    assert free.max_curvature > 1.0 / 500.0 >= bound.max_curvature > 0.0
    assert free.duration < bound.duration < 1.05 * free.duration


def test_what_cannot_be_reached_says_so() -> None:
    against = evolve_path(waters(UniformCurrent(-1.2, 0.0)), START, GOAL)
    assert against.status is PathStatus.AGAINST_CURRENT
    across = evolve_path(waters(UniformCurrent(0.0, 1.2)), START, GOAL)
    assert across.status is PathStatus.AGAINST_CURRENT
    ring = [
        POLYGON.mean(axis=0) + 900.0 * np.array([math.cos(a), math.sin(a)])
        for a in np.linspace(0.0, 2.0 * math.pi, 7)[:-1]
    ]
    walls = []
    for a, b in zip(ring, ring[1:] + ring[:1], strict=True):
        side = 30.0 * np.array([b[1] - a[1], a[0] - b[0]]) / math.hypot(*(b - a))
        along = 0.1 * (b - a)
        walls.append(np.stack([a - along, b + along, b + along + side, a - along + side]))
    enclosed = evolve_path(waters(STILL, polygons(*walls)), START, POLYGON.mean(axis=0))
    assert enclosed.status is PathStatus.BLOCKED
    assert not enclosed.is_found
    assert enclosed.duration == math.inf


def test_an_end_may_lie_close_to_an_obstacle() -> None:
    water = waters(VORTICES, circles((4000.0, -300.0, 299.95)))
    path, free = (evolve_path(each, START, GOAL) for each in (water, waters(VORTICES)))
    assert path.min_clearance <= 0.05 + 1e-9
    assert path.duration == pytest.approx(free.duration, rel=1e-4)


def test_ends_in_an_obstacle_are_named() -> None:
    water = waters(STILL, circles((4000.0, 100.0, 300.0)))
    with pytest.raises(InputError, match=r"^goal: .*200\.0 m inside"):
        evolve_path(water, START, GOAL)
    with pytest.raises(InputError, match=r"^start: "):
        evolve_path(water, GOAL, START)
    with pytest.raises(InputError, match="two finite numbers"):
        evolve_path(water, (0.0, math.nan), GOAL)


def test_no_way_takes_no_time() -> None:
    path = evolve_path(waters(VORTICES), START, START)
    assert path.is_found
    assert path.duration == 0.0


def test_an_interrupted_search_answers_at_once_with_a_path() -> None:
    interrupt = threading.Event()
    interrupt.set()
    clock = Limits(interrupt=interrupt).start()
    path = evolve_path(waters(VORTICES), START, GOAL, options=THOROUGH, clock=clock)
    assert path.is_found


@pytest.mark.parametrize(
    ("field", "value"),
    [("population", 3), ("evaluations", -1), ("spans", 0), ("halvings", -1), ("descents", 0)],
)
def test_options_are_checked(field: str, value: int) -> None:
    with pytest.raises(InputError, match=field):
        DifferentialEvolution(**{field: value})  # type: ignore[arg-type]
    with pytest.raises(InputError, match="variant"):
        DifferentialEvolution("simplex")  # type: ignore[arg-type]
