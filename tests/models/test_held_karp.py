"""The Held-Karp bound: never above the optimum, and as high as the linear relaxation."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.limits import Limits
from fiveroute.models import held_karp as module
from fiveroute.models.giant_route import solve_giant_route
from fiveroute.models.held_karp import (
    giant_route_bound,
    has_symmetric_nodes,
    held_karp,
    useful_links,
)
from fiveroute.problem import TeamOrienteering


def of_times(travel: np.ndarray) -> TeamOrienteering:
    size = len(travel)
    return TeamOrienteering(travel, np.zeros(size), np.zeros(size), [1.0])


def square(n: int, seed: int) -> np.ndarray:
    points = np.random.default_rng(seed).random((n + 2, 2)) * 1e4
    times: np.ndarray = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    return times


@st.composite
def small_problems(draw: st.DrawFn) -> TeamOrienteering:
    """Up to six nodes: in the plane, asymmetric, or with many ties and zeros."""
    n = draw(st.integers(1, 6))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kind = draw(st.sampled_from(["plane", "asymmetric", "ties"]))
    if kind == "plane":
        return of_times(square(n, draw(st.integers(0, 99))))
    times = rng.random((n + 2, n + 2)) * 4.0
    return of_times(times if kind == "asymmetric" else np.floor(times))


@settings(deadline=None, max_examples=60)
@given(small_problems())
def test_no_route_is_below_the_bound_nor_uses_an_excluded_arc(problem: TeamOrienteering) -> None:
    relaxed = held_karp(problem, Limits().start())
    routes = list(itertools.permutations(range(1, problem.n + 1)))
    times = np.array([problem.duration(route) for route in routes])
    assert relaxed.bound <= times.min() + 1e-9
    upper = float(np.quantile(times, 0.3)) + 1e-9
    useful = useful_links(problem, relaxed, upper, most=100)
    assert useful is not None
    links = {tuple(link) for link in useful.T.tolist()}
    if has_symmetric_nodes(problem):
        links |= {(head, tail) for tail, head in links}
    for route, time in zip(routes, times, strict=True):
        if time < upper:
            assert set(itertools.pairwise((0, *route, problem.destination))) <= links


def test_too_many_useful_links_are_not_listed() -> None:
    problem = of_times(square(20, 5))
    relaxed = held_karp(problem, Limits().start())
    every = useful_links(problem, relaxed, 1e9, most=230)
    assert every is not None
    assert every.shape == (2, 20 * 19 // 2 + 2 * 20)
    assert useful_links(problem, relaxed, 1e9, most=229) is None


def test_a_single_node_has_no_choice() -> None:
    problem = of_times(np.array([[0.0, 2.0, 1.0], [9.0, 0.0, 4.0], [9.0, 9.0, 0.0]]))
    assert giant_route_bound(problem) == pytest.approx(6.0)


def test_without_nodes_it_is_the_direct_leg() -> None:
    direct = of_times(np.array([[0.0, 5.0], [1.0, 0.0]]))
    assert giant_route_bound(direct) == pytest.approx(5.0)


def test_services_count() -> None:
    problem = TeamOrienteering(np.ones((4, 4)), [0.0, 7.0, 8.0, 0.0], np.zeros(4), [1.0])
    assert giant_route_bound(problem) == pytest.approx(3.0 + 15.0)


@pytest.mark.parametrize("symmetric", [True, False])
def test_close_to_the_optimum(symmetric: bool) -> None:
    """Some 0.7 % below it for random points, less for random matrices."""
    travel = square(60, 1)
    if not symmetric:
        travel = np.random.default_rng(1).random((62, 62))
    problem = of_times(travel)
    optimum = solve_giant_route(problem).duration
    bound = giant_route_bound(problem)
    assert 0.98 * optimum <= bound <= optimum * (1.0 + 1e-9)


def test_sparse_graphs_prove_as_much_as_the_complete_one(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = of_times(square(300, 2))
    sparse = giant_route_bound(problem)
    monkeypatch.setattr(module, "_SPARSE_FROM", 10**9)
    assert sparse == pytest.approx(giant_route_bound(problem), rel=2e-3)


def test_sparse_graphs_serve_asymmetric_times() -> None:
    """One-way streets: each node's near links lead on, the way back is ten times longer."""
    travel = square(260, 3)
    travel[np.tril_indices(262)] *= 10.0
    problem = of_times(travel)
    forward = tuple(range(1, 261))
    assert 0.0 < giant_route_bound(problem) <= problem.duration(forward)


def test_stopped_at_once_it_is_still_a_bound() -> None:
    problem = of_times(square(60, 4))
    assert 0.0 < giant_route_bound(problem, Limits(time=0.0)) <= giant_route_bound(problem)


def test_whole_seconds_round_the_bound_up() -> None:
    """Distances rounded up to whole seconds make the shortest way a whole number."""
    rng = np.random.default_rng(5)
    points = rng.uniform(0.0, 100.0, (10, 2))
    travel = np.ceil(np.linalg.norm(points[:, None] - points[None, :], axis=2))
    problem = TeamOrienteering(travel, np.zeros(10), np.zeros(10), [1.0])
    bound = giant_route_bound(problem)
    assert abs(bound - round(bound)) < 1e-6
