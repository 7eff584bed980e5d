"""A route and its tour have the same length, whatever the times are like."""

from itertools import permutations

import numpy as np
import pytest

from fiveroute.heuristics.tour.graph import edge_cost, giant_graph, route_of, tour_cost
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering


def problem_of(travel: np.ndarray) -> TeamOrienteering:
    rest = np.zeros(len(travel))
    return TeamOrienteering(travel, rest, rest, [1.0])


def random_problem(n: int, asymmetric: bool, seed: int = 1) -> TeamOrienteering:
    travel = np.random.default_rng(seed).uniform(1.0, 9.0, (n + 2, n + 2))
    return problem_of(travel if asymmetric else travel + travel.T)


def tour_of(route: tuple[int, ...], n: int, asymmetric: bool) -> np.ndarray:
    """The tour that stands for a route, written down by hand."""
    if not asymmetric:
        return np.array([0, *route, n + 1])
    copies = [copy for node in route for copy in (n + node, node)]
    return np.array([0, *copies, 2 * n + 1])


@pytest.mark.parametrize("asymmetric", [False, True])
def test_tour_and_route_stand_for_each_other(asymmetric: bool) -> None:
    problem = random_problem(4, asymmetric)
    graph = giant_graph(problem, Limits().start())
    assert graph is not None
    for route in permutations(range(1, 5)):
        tour = tour_of(route, 4, asymmetric)
        assert tour_cost(graph, tour) - problem.travel[0, -1] == pytest.approx(
            problem.duration(route)
        )
        for turned in (tour, np.roll(tour, 3), tour[::-1].copy(), np.roll(tour[::-1], 2)):
            assert route_of(graph, turned) == route


@pytest.mark.parametrize("asymmetric", [False, True])
def test_neighbours_are_the_nearest_without_the_mate(asymmetric: bool) -> None:
    graph = giant_graph(random_problem(30, asymmetric), Limits().start())
    assert graph is not None
    for u in range(graph.size):
        costs = sorted(
            cost
            for v in range(graph.size)
            if v not in (u, graph.mate[u]) and np.isfinite(cost := edge_cost(graph, u, v))
        )
        assert graph.near_cost[u].tolist() == costs[: graph.near.shape[1]]
        assert graph.near_cost[u].tolist() == [edge_cost(graph, u, int(v)) for v in graph.near[u]]
        assert len(set(graph.near[u].tolist())) == graph.near.shape[1]


def test_mates_are_mutual() -> None:
    graph = giant_graph(random_problem(7, asymmetric=True), Limits().start())
    assert graph is not None
    assert (graph.mate[graph.mate] == np.arange(graph.size)).all()


def test_two_entries_are_infinitely_far_apart() -> None:
    graph = giant_graph(random_problem(6, asymmetric=True), Limits().start())
    assert graph is not None
    assert edge_cost(graph, 8, 9) == np.inf
    assert edge_cost(graph, 1, 2) == np.inf


def test_no_graph_without_time() -> None:
    assert giant_graph(random_problem(6, asymmetric=False), Limits(time=0.0).start()) is None
