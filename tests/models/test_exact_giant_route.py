"""The giant route against permutations, against subset dynamic programming, against TSPLIB."""

import itertools
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats import read_instance
from fiveroute.limits import Limits, Progress
from fiveroute.models.giant_route import solve_giant_route
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status

Rng = np.random.Generator


def of_times(travel: np.ndarray, service: float = 0.0) -> TeamOrienteering:
    size = len(travel)
    services = np.array([0.0, *[service] * (size - 2), 0.0])
    return TeamOrienteering(travel, services, np.zeros(size), [1.0])


def plane(points: np.ndarray) -> np.ndarray:
    times: np.ndarray = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    return times


def drifting(points: np.ndarray, current: float) -> np.ndarray:
    """Times at unit speed in a uniform current to the east: longer against it."""
    away = points[None] - points[:, None]
    length = np.hypot(away[..., 0], away[..., 1]) + 1e-12
    along = current * away[..., 0] / length
    times: np.ndarray = length / (along + np.sqrt(1.0 - current**2 + along**2))
    return times


def in_square(rng: Rng, n: int) -> np.ndarray:
    return rng.random((n + 2, 2)) * 1e4


def closed(rng: Rng, n: int) -> np.ndarray:
    points = in_square(rng, n)
    points[-1] = points[0]
    return plane(points)


TIMES: dict[str, Callable[[Rng, int], np.ndarray]] = {
    "path in the plane": lambda rng, n: plane(in_square(rng, n)),
    "tour in the plane": closed,
    "tour in whole seconds": lambda rng, n: np.round(closed(rng, n) / 2000.0),
    "in a current": lambda rng, n: drifting(in_square(rng, n), 0.6),
    "without the triangle inequality": lambda rng, n: rng.random((n + 2, n + 2)),
    "nothing but ties": lambda rng, n: np.floor(rng.random((n + 2, n + 2)) * 3.0),
    "mostly zero": lambda rng, n: (rng.random((n + 2, n + 2)) < 0.2) * 1.0,
    "in years": lambda rng, n: plane(in_square(rng, n)) * 1e8,
    "in microseconds": lambda rng, n: plane(in_square(rng, n)) * 1e-8,
}


def shortest(problem: TeamOrienteering) -> float:
    """The truth, over all permutations."""
    nodes = range(1, problem.n + 1)
    return min(problem.duration(route) for route in itertools.permutations(nodes))


@pytest.mark.parametrize("kind", list(TIMES))
@settings(deadline=None, max_examples=12)
@given(seed=st.integers(0, 2**32 - 1), n=st.integers(0, 7))
@example(seed=70, n=5)  # the links left take no time at all
@example(seed=20, n=4)
def test_no_permutation_is_shorter(kind: str, seed: int, n: int) -> None:
    problem = of_times(TIMES[kind](np.random.default_rng(seed), n), service=3.0)
    result = solve_giant_route(problem)
    assert result.status is Status.OPTIMAL
    assert sorted(result.order) == list(range(1, n + 1))
    assert result.duration == problem.duration(result.order)
    assert result.duration == pytest.approx(shortest(problem), rel=1e-9)
    assert result.bound is not None
    assert result.bound == pytest.approx(result.duration, rel=1e-6)


def shortest_by_subsets(travel: np.ndarray) -> float:
    """Held and Karp's dynamic programme, set by set: a truth for a dozen nodes."""
    n = len(travel) - 2
    table = np.full((1 << n, n), np.inf)
    table[1 << np.arange(n), np.arange(n)] = travel[0, 1:-1]
    for visited in range(1 << n):
        for last in range(n):
            reached = table[visited, last]
            if reached < math.inf:
                for node in range(n):
                    if not visited >> node & 1:
                        wider = visited | 1 << node
                        time = reached + travel[last + 1, node + 1]
                        table[wider, node] = min(table[wider, node], time)
    return float((table[-1] + travel[1:-1, -1]).min())


@pytest.mark.parametrize("kind", ["path in the plane", "in a current", "nothing but ties"])
def test_a_dozen_nodes_against_subsets(kind: str) -> None:
    travel = TIMES[kind](np.random.default_rng(12), 12)
    result = solve_giant_route(of_times(travel))
    assert result.status is Status.OPTIMAL
    assert result.duration == pytest.approx(shortest_by_subsets(of_times(travel).travel), rel=1e-9)


@pytest.mark.parametrize("n", [4, 9, 40])
def test_round_a_circle(n: int) -> None:
    """From the circle's one point round to the same point: a regular polygon's circumference."""
    angle = 2.0 * np.pi * np.arange(n + 2) / (n + 1)
    result = solve_giant_route(of_times(plane(np.stack((np.cos(angle), np.sin(angle)), axis=1))))
    assert result.status is Status.OPTIMAL
    assert result.duration == pytest.approx(2.0 * (n + 1) * math.sin(math.pi / (n + 1)))


def test_a_current_that_needs_branching() -> None:
    """Sixty nodes in a current, whose relaxation with cuts stays below the optimum."""
    points = in_square(np.random.default_rng(2), 60)
    points[0], points[-1] = (3000.0, 5000.0), (7000.0, 5000.0)
    problem = of_times(drifting(points, 0.3))
    reports: list[Progress] = []
    result = solve_giant_route(problem, progress=reports.append)
    assert result.status is Status.OPTIMAL
    assert len(reports) > 3  # Held and Karp, the root, and at least two halves
    bounds = [report.bound or 0.0 for report in reports]
    assert bounds == sorted(bounds)
    assert bounds[0] < result.duration * (1.0 - 1e-3)


def test_a_warm_start_is_never_lost() -> None:
    problem = of_times(TIMES["in a current"](np.random.default_rng(3), 30))
    best = solve_giant_route(problem).order
    stopped = solve_giant_route(problem, Limits(time=0.0), warm_start=best)
    assert stopped.order == best
    assert stopped.bound is not None
    assert stopped.bound <= stopped.duration


@pytest.mark.parametrize("route", [(1, 2), (1, 2, 2), (1, 2, 3, 4)])
def test_a_warm_start_visits_every_node_once(route: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match="every node once"):
        solve_giant_route(of_times(np.ones((5, 5))), warm_start=route)


def test_stopped_at_once_the_bound_is_valid() -> None:
    problem = of_times(TIMES["path in the plane"](np.random.default_rng(8), 60))
    truth = solve_giant_route(problem).duration
    interrupted = Limits()
    interrupted.interrupt.set()
    for limits in (Limits(time=0.0), interrupted):
        result = solve_giant_route(problem, limits)
        assert result.status is Status.FEASIBLE
        assert sorted(result.order) == list(range(1, 61))
        assert result.bound is not None
        assert 0.0 < result.bound <= truth <= result.duration


def test_a_gap_is_enough() -> None:
    problem = of_times(TIMES["in a current"](np.random.default_rng(4), 40))
    result = solve_giant_route(problem, Limits(gap=0.2))
    assert result.gap is not None
    assert result.gap <= 0.2
    assert result.bound is not None
    assert result.bound <= solve_giant_route(problem).duration


def test_same_answer_every_time() -> None:
    problem = of_times(TIMES["path in the plane"](np.random.default_rng(5), 50))
    first, second = solve_giant_route(problem), solve_giant_route(problem)
    assert (first.order, first.bound) == (second.order, second.bound)


@pytest.mark.parametrize(
    ("name", "length"),
    [("bays29", 2020), ("att48", 10628), ("eil51", 426), ("st70", 675), ("gr96", 55209)],
)
def test_published_optima(name: str, length: int, public_file: Callable[[str], Path]) -> None:
    """G. Reinelt, TSPLIB 95: explicit, pseudo-Euclidean, rounded and great-circle distances."""
    file = public_file(f"benchmarks/tsplib/{name}.tsp")
    result = solve_giant_route(read_instance(file).problem(1))
    assert result.status is Status.OPTIMAL
    assert (result.duration, result.bound) == (length, length)
