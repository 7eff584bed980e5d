"""Giant routes against enumeration, closed forms and the exact solver."""

import threading
from itertools import pairwise, permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.giant_route import ROUTES, giant_routes
from fiveroute.limits import Limits, Progress
from fiveroute.models.giant_route import solve_giant_route
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Route


def problem_of(travel: np.ndarray, service: np.ndarray | None = None) -> TeamOrienteering:
    rest = np.zeros(len(travel))
    return TeamOrienteering(travel, rest if service is None else service, rest, [1.0])


def planar(points: np.ndarray) -> TeamOrienteering:
    gaps = points[:, None] - points[None, :]
    return problem_of(np.hypot(gaps[..., 0], gaps[..., 1]))


def routes_of(problem: TeamOrienteering, seed: int = 1) -> tuple[Route, ...]:
    routes = giant_routes(problem, rng=np.random.default_rng(seed))
    assert 1 <= len(routes) == len(set(routes)) <= ROUTES
    for route in routes:
        assert sorted(route) == list(range(1, problem.n + 1))
    for better, worse in pairwise(map(problem.duration, routes)):
        assert better <= worse
    return routes


def test_no_node() -> None:
    assert routes_of(problem_of(np.ones((2, 2)))) == ((),)


def test_one_node() -> None:
    assert routes_of(problem_of(np.ones((3, 3)))) == ((1,),)


def test_two_nodes_the_shorter_way_first() -> None:
    travel = np.ones((4, 4))
    travel[0, 1] = 9.0
    assert routes_of(problem_of(travel)) == ((2, 1), (1, 2))


@settings(deadline=None, max_examples=30)
@given(
    st.integers(0, 7),
    st.sampled_from(["symmetric", "asymmetric", "zeros", "closed"]),
    st.integers(0, 10**6),
)
def test_enumeration_agrees(n: int, kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    travel = rng.uniform(0.0, 10.0, (n + 2, n + 2))
    if kind != "asymmetric":
        travel += travel.T
    if kind == "zeros":
        travel *= rng.random(travel.shape) < 0.5
    if kind == "closed":
        travel[-1, :], travel[:, -1] = travel[0, :], travel[:, 0]
        travel[0, -1] = travel[-1, 0] = 0.0
    problem = problem_of(travel)
    shortest = min(map(problem.duration, permutations(range(1, n + 1))))
    assert problem.duration(routes_of(problem, seed)[0]) == pytest.approx(shortest)


@pytest.mark.parametrize("asymmetry", [0.0, 0.3])
@pytest.mark.parametrize("closed", [False, True])
def test_proved_optimum_at_the_size_of_the_paper(asymmetry: float, closed: bool) -> None:
    rng = np.random.default_rng(5)
    points = rng.uniform(0.0, 10_000.0, (62, 2))
    if closed:
        points[-1] = points[0]
    travel = planar(points).travel * (1.0 + asymmetry * rng.random((62, 62)))
    service = np.concatenate(([0.0], rng.uniform(5.0, 25.0, 60), [0.0]))
    problem = problem_of(travel, service)
    exact = solve_giant_route(problem)
    assert exact.status is Status.OPTIMAL
    assert problem.duration(routes_of(problem)[0]) == pytest.approx(exact.duration)


def test_ring_of_points() -> None:
    """On a ring the shortest tour is the polygon: N sides of length 2 sin(pi / N)."""
    angle = 2.0 * np.pi * np.arange(101) / 100
    problem = planar(np.column_stack((np.cos(angle), np.sin(angle))))
    best = routes_of(problem)[0]
    assert problem.duration(best) == pytest.approx(100 * 2.0 * np.sin(np.pi / 100))


def test_grid() -> None:
    """A grid with an even number of points has a tour of unit steps only."""
    x, y = np.meshgrid(np.arange(10.0), np.arange(9.0))
    points = np.column_stack((x.ravel(), y.ravel()))
    problem = planar(np.concatenate((points, points[:1])))
    assert problem.duration(routes_of(problem)[0]) == pytest.approx(90.0)


def test_points_in_the_same_place() -> None:
    problem = planar(np.repeat([[0.0, 0.0], [3.0, 4.0]], 12, axis=0))
    assert problem.duration(routes_of(problem)[0]) == pytest.approx(5.0)


@pytest.mark.parametrize("asymmetric", [False, True])
def test_no_time_at_all_between_points(asymmetric: bool) -> None:
    travel = np.zeros((20, 20))
    travel[0, 5] = 1.0 if asymmetric else 0.0
    assert problem_of(travel).duration(routes_of(problem_of(travel))[0]) == 0.0


@pytest.mark.parametrize("asymmetry", [0.0, 0.5])
def test_same_seed_same_routes(asymmetry: float) -> None:
    rng = np.random.default_rng(8)
    travel = planar(rng.random((40, 2))).travel * (1.0 + asymmetry * rng.random((40, 40)))
    assert routes_of(problem_of(travel), 3) == routes_of(problem_of(travel), 3)


def test_times_of_any_scale() -> None:
    rng = np.random.default_rng(4)
    points = rng.random((30, 2))
    small, large = planar(points * 1e-6), planar(points * 1e9)
    assert large.duration(routes_of(small)[0]) == pytest.approx(large.duration(routes_of(large)[0]))


@pytest.mark.parametrize("asymmetric", [False, True])
def test_without_time_there_is_a_route_all_the_same(asymmetric: bool) -> None:
    travel = np.random.default_rng(1).random((50, 50))
    problem = problem_of(travel if asymmetric else travel + travel.T)
    (route,) = giant_routes(problem, Limits(time=0.0), rng=np.random.default_rng(1))
    assert sorted(route) == list(range(1, 49))


def test_an_interrupt_ends_the_search() -> None:
    """The first progress report asks for the end, and the best route so far comes back."""
    interrupt = threading.Event()
    told: list[Progress] = []

    def stop(snapshot: Progress) -> None:
        told.append(snapshot)
        interrupt.set()

    problem = planar(np.random.default_rng(1).random((120, 2)))
    limits = Limits(interrupt=interrupt)
    routes = giant_routes(problem, limits, rng=np.random.default_rng(1), progress=stop)
    assert sorted(routes[0]) == list(range(1, 119))
    assert len(told) < 5
    assert told[0].objective == pytest.approx(problem.duration(routes[0]))
