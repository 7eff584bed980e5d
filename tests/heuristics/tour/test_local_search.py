"""Local search keeps tours valid and only ever shortens them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.tour.graph import Graph, giant_graph, tour_cost
from fiveroute.heuristics.tour.greedy import greedy_tour
from fiveroute.heuristics.tour.local_search import improve, start_search
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering


def random_graph(n: int, asymmetric: bool, seed: int) -> Graph:
    travel = np.random.default_rng(seed).integers(0, 50, (n + 2, n + 2)).astype(float)
    rest = np.zeros(n + 2)
    times = travel if asymmetric else travel + travel.T
    graph = giant_graph(TeamOrienteering(times, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    return graph


@settings(deadline=None, max_examples=40)
@given(st.integers(6, 60), st.booleans(), st.integers(0, 10**6))
def test_shorter_and_still_a_tour(n: int, asymmetric: bool, seed: int) -> None:
    graph = random_graph(n, asymmetric, seed)
    start = greedy_tour(graph, 5.0, np.random.default_rng(seed))
    search = start_search(start)
    assert improve(graph, search, 10**9, 1e-9)
    order = search.tour.order
    assert sorted(order.tolist()) == list(range(graph.size))
    assert (search.tour.position[order] == np.arange(graph.size)).all()
    assert tour_cost(graph, order) <= tour_cost(graph, start)  # finite: no forbidden edge
    ahead, behind = np.roll(order, -1), np.roll(order, 1)
    mates = graph.mate[order]
    assert ((mates < 0) | (mates == ahead) | (mates == behind)).all()


@pytest.mark.parametrize("asymmetric", [False, True])
def test_slices_do_not_change_the_result(asymmetric: bool) -> None:
    graph = random_graph(80, asymmetric, 4)
    start = greedy_tour(graph, 1.0, np.random.default_rng(4))
    whole, sliced = start_search(start), start_search(start)
    assert improve(graph, whole, 10**9, 1e-9)
    while not improve(graph, sliced, 3, 1e-9):
        pass
    assert whole.tour.order.tolist() == sliced.tour.order.tolist()


def test_one_segment_in_the_wrong_place_is_moved() -> None:
    """On directed times only a move that turns nothing round can help: an or-exchange."""
    n = 20
    travel = np.full((n + 2, n + 2), 100.0)
    travel[np.arange(n + 1), np.arange(1, n + 2)] = 1.0
    rest = np.zeros(n + 2)
    graph = giant_graph(TeamOrienteering(travel, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    route = [*range(1, 5), *range(8, 15), *range(5, 8), *range(15, n + 1)]
    copies = [copy for node in route for copy in (n + node, node)]
    search = start_search(np.array([0, *copies, 2 * n + 1]))
    assert improve(graph, search, 10**9, 1e-9)
    assert tour_cost(graph, search.tour.order) == n + 1 + travel[0, -1]
