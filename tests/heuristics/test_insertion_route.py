"""Routes by insertion: all nodes, short, and different for every order."""

import itertools

import numpy as np
import pytest

from fiveroute.heuristics.insertion_route import insertion_route, various_routes
from fiveroute.problem import TeamOrienteering


def random_problem(n: int, seed: int) -> TeamOrienteering:
    """Asymmetric times."""
    travel = np.random.default_rng(seed).random((n + 2, n + 2))
    return TeamOrienteering(travel, np.zeros(n + 2), np.zeros(n + 2), [1.0])


def line(places: list[float]) -> TeamOrienteering:
    """Nodes on a line between start and destination."""
    at = np.array([0.0, *places, 100.0])
    return TeamOrienteering(np.abs(at[:, None] - at), at * 0.0, at * 0.0, [1.0])


def test_nodes_on_the_way_are_visited_on_the_way() -> None:
    problem = line([30.0, 10.0, 20.0, 40.0])
    for order in itertools.permutations(range(1, 5)):
        assert insertion_route(problem, order) == (2, 3, 1, 4)
    assert insertion_route(problem, (4, 2)) == (2, 4)
    assert insertion_route(problem, ()) == ()


@pytest.mark.parametrize("n", [0, 1, 2, 3, 10, 30])
def test_various_routes_are_different_and_sorted(n: int) -> None:
    problem = random_problem(n, n)
    routes = various_routes(problem, 6, np.random.default_rng(1))
    assert len(set(routes)) == len(routes) <= 6
    assert all(sorted(route) == list(range(1, n + 1)) for route in routes)
    durations = [problem.duration(route) for route in routes]
    assert durations == sorted(durations)
    if n >= 10:
        assert len(routes) == 6


def test_none_are_asked_for() -> None:
    assert various_routes(random_problem(5, 1), 0, np.random.default_rng(1)) == ()


def test_very_long_routes_are_complete() -> None:
    problem = line(np.random.default_rng(2).permutation(np.linspace(1.0, 99.0, 1200)).tolist())
    route = insertion_route(problem, range(1, 1201))
    assert problem.duration(route) == pytest.approx(100.0)
