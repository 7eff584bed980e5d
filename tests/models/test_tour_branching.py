"""What it takes to beat a route, and the search on its own."""

import itertools

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.tour_branching import BranchAndCut, Incumbent
from fiveroute.models.tour_relaxation import Links
from fiveroute.problem import TeamOrienteering


def problem_of(travel: np.ndarray, service: float = 0.0) -> TeamOrienteering:
    size = len(travel)
    services = np.array([0.0, *[service] * (size - 2), 0.0])
    return TeamOrienteering(travel, services, np.zeros(size), [1.0])


def test_whole_seconds_round_the_bound_up() -> None:
    """Legs of 2 s and services of 0.25 s: travel times are whole, durations are not."""
    incumbent = Incumbent(problem_of(np.full((5, 5), 2.0), service=0.25), (1, 2, 3))
    assert incumbent.duration == 8.75
    assert incumbent.cutoff == pytest.approx(7.0)
    assert incumbent.proved(7.0 + 1e-6) == 8.75
    assert incumbent.proved(7.0 + 1e-12) == 7.75  # that may be rounding
    assert incumbent.proved(6.5) == 7.75


def test_real_seconds_do_not() -> None:
    incumbent = Incumbent(problem_of(np.full((5, 5), 2.5)), (1, 2, 3))
    assert incumbent.cutoff == pytest.approx(10.0, rel=1e-6)
    assert incumbent.cutoff < 10.0
    assert incumbent.proved(9.2) == pytest.approx(9.2)
    assert incumbent.proved(9.2) < 9.2


def test_no_bound_exceeds_the_route() -> None:
    incumbent = Incumbent(problem_of(np.full((4, 4), 1.5)), (1, 2))
    assert incumbent.proved(float("inf")) == pytest.approx(4.5)
    assert incumbent.proved(float("inf")) <= incumbent.duration


def test_a_gap_lowers_the_cutoff() -> None:
    incumbent = Incumbent(problem_of(np.full((4, 4), 1.5)), (1, 2), gap=0.1)
    assert incumbent.cutoff == pytest.approx(4.05)


def test_only_shorter_routes_are_taken() -> None:
    incumbent = Incumbent(problem_of(np.triu(np.full((4, 4), 1.0)) + 1.0), (2, 1))
    incumbent.offer((1, 2))
    assert incumbent.route == (2, 1)
    incumbent = Incumbent(problem_of(np.tril(np.full((4, 4), 1.0), -1) + 1.0), (2, 1))
    incumbent.offer((1, 2))
    assert incumbent.route == (1, 2)


@pytest.mark.parametrize("seed", range(4))
def test_search_without_any_preparation(seed: int) -> None:
    """All arcs, a poor route, no bound: branch and cut alone finds and proves the optimum."""
    n = 6
    travel = np.random.default_rng(seed).random((n + 2, n + 2))
    arcs = [(0, j) for j in range(1, n + 1)] + [(i, n + 1) for i in range(1, n + 1)]
    arcs += itertools.permutations(range(1, n + 1), 2)
    tails, heads = np.array(arcs).T
    problem = problem_of(travel)
    nodes = range(1, n + 1)
    worst = max(itertools.permutations(nodes), key=problem.duration)
    incumbent = Incumbent(problem, worst)
    bounds: list[float] = []
    links = Links(tails, heads, problem.travel[tails, heads], n, symmetric=False)
    search = BranchAndCut(links, incumbent, 0.0, Limits().start(), bounds.append)
    search.run()
    assert incumbent.duration == min(problem.duration(r) for r in itertools.permutations(nodes))
    assert incumbent.proved(search.bound) == pytest.approx(incumbent.duration, rel=1e-6)
    assert bounds
