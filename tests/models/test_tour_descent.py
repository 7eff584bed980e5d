"""The local search: never worse than its start, locally optimal, and the same every time."""

import itertools

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.tour_descent import descend, good_route, nearest_neighbours
from fiveroute.problem import TeamOrienteering


def problem_of(n: int, seed: int, *, symmetric: bool) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    points = rng.random((n + 2, 2))
    travel = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    if not symmetric:
        travel = travel * rng.uniform(1.0, 2.0, travel.shape)
    return TeamOrienteering(travel, np.zeros(n + 2), np.zeros(n + 2), [1.0])


def neighbours(route: tuple[int, ...]) -> set[tuple[int, ...]]:
    """Routes one reversal away, or one move of up to three nodes."""
    found = set()
    for i, j in itertools.combinations(range(len(route) + 1), 2):
        part = route[i:j]
        found.add(route[:i] + part[::-1] + route[j:])
        rest = route[:i] + route[j:]
        if len(part) <= 3:
            for k in range(len(rest) + 1):
                found |= {rest[:k] + part + rest[k:], rest[:k] + part[::-1] + rest[k:]}
    return found


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("seed", range(3))
def test_no_neighbour_is_shorter(seed: int, symmetric: bool) -> None:
    problem = problem_of(12, seed, symmetric=symmetric)
    stops = np.arange(14)
    descend(problem.travel, stops, 1, 0, 10**6)
    route = tuple(stops[1:-1].tolist())
    assert sorted(route) == list(range(1, 13))
    least = min(problem.duration(other) for other in neighbours(route))
    assert problem.duration(route) <= least + 1e-6


def test_the_warm_start_is_a_lower_end() -> None:
    problem = problem_of(25, 1, symmetric=False)
    route = good_route(problem, Limits().start())
    assert problem.duration(good_route(problem, Limits().start(), route)) <= problem.duration(route)
    stopped = good_route(problem, Limits(time=0.0).start(), tuple(range(1, 26)))
    assert stopped == tuple(range(1, 26))


def test_kicks_find_the_best_of_eight_nodes() -> None:
    problem = problem_of(8, 2, symmetric=True)
    best = min(problem.duration(r) for r in itertools.permutations(range(1, 9)))
    assert problem.duration(good_route(problem, Limits().start())) == pytest.approx(best)


@pytest.mark.parametrize("n", [0, 1, 2])
def test_tiny(n: int) -> None:
    route = good_route(problem_of(n, 0, symmetric=False), Limits().start())
    assert sorted(route) == list(range(1, n + 1))


def test_same_route_every_time() -> None:
    problem = problem_of(40, 3, symmetric=True)
    assert good_route(problem, Limits().start()) == good_route(problem, Limits().start())


def test_nearest_neighbours_by_hand() -> None:
    """On a line from 0: nodes at 3, 1, -1.5 and the destination far away."""
    at = np.array([0.0, 3.0, 1.0, -1.5, 9.0])
    travel = np.abs(at[:, None] - at)
    travel.setflags(write=False)
    assert nearest_neighbours(travel).tolist() == [2, 1, 3]
