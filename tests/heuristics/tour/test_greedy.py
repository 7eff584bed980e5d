"""Greedy tours contain every vertex once and every fixed edge."""

import numpy as np
import pytest

from fiveroute.heuristics.tour.graph import giant_graph
from fiveroute.heuristics.tour.greedy import greedy_tour
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering


@pytest.mark.parametrize("asymmetric", [False, True])
@pytest.mark.parametrize("n", [6, 13, 200])
def test_every_vertex_once_and_every_fixed_edge(n: int, asymmetric: bool) -> None:
    travel = np.random.default_rng(n).uniform(0.0, 1.0, (n + 2, n + 2))
    rest = np.zeros(n + 2)
    travel = travel if asymmetric else travel + travel.T
    graph = giant_graph(TeamOrienteering(travel, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    order = greedy_tour(graph, 1.0, np.random.default_rng(3))
    assert sorted(order.tolist()) == list(range(graph.size))
    edges = {
        frozenset(edge) for edge in zip(order.tolist(), np.roll(order, -1).tolist(), strict=True)
    }
    for u, v in enumerate(graph.mate.tolist()):
        assert v < 0 or frozenset((u, v)) in edges


def test_a_line_of_points_needs_no_search() -> None:
    """Without noise greedy lays a straight line end to end."""
    travel = np.abs(np.subtract.outer(np.arange(12.0), np.arange(12.0)))
    rest = np.zeros(12)
    graph = giant_graph(TeamOrienteering(travel, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    order = greedy_tour(graph, 0.0, np.random.default_rng(3)).tolist()
    assert {abs(u - v) for u, v in zip(order, order[1:] + order[:1], strict=True)} == {1, 11}
