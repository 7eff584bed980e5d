"""Sub-tours are found, and joined at the cost that is said."""

import numpy as np
import pytest

from fiveroute.heuristics.tour.exchange import (
    Cycles,
    Tour,
    alternate,
    apply_exchange,
    is_single_tour,
    new_exchange,
)
from fiveroute.heuristics.tour.graph import Graph, giant_graph, tour_cost
from fiveroute.heuristics.tour.subtours import label_segments, segment_at, unite
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering

SIZE = 30


def ring_graph() -> Graph:
    angle = 2.0 * np.pi * np.arange(SIZE) / SIZE
    points = np.column_stack((np.cos(angle), np.sin(angle)))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    travel = (travel + travel.T) / 2.0
    rest = np.zeros(SIZE)
    graph = giant_graph(TeamOrienteering(travel, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    return graph


def closed_loops(tour: Tour, breaks: list[int]) -> tuple[Cycles, int]:
    """Every stretch between two breaks of the tour closed upon itself."""
    walk: list[int] = []
    for p in breaks:
        walk += [int(tour.order[(p + 1) % SIZE]), int(tour.order[p])]
    return Cycles(np.array(walk), np.array([0, len(walk)])), len(breaks)


def test_loops_are_told_apart_and_joined() -> None:
    graph = ring_graph()
    tour = Tour(np.arange(SIZE), np.arange(SIZE))
    cycles, k = closed_loops(tour, [24, 14, 4])
    exchange = new_exchange(3 * k)
    alternate(tour, cycles, 1, exchange, np.empty(2 * k, dtype=np.int64))
    assert exchange.cut[:k].tolist() == [4, 14, 24]
    label, vertices = np.empty(k, dtype=np.int64), np.empty(k, dtype=np.int64)
    tours = label_segments(tour, exchange, k, label, vertices)
    assert (tours, vertices[:tours].tolist()) == (3, [10, 10, 10])
    assert [segment_at(exchange, k, p) for p in (4, 5, 14, 15, 25, 0)] == [2, 0, 0, 1, 2, 2]

    before = tour_cost(graph, tour.order)
    removed = sum(graph.travel[p, p + 1] for p in (4, 14, 24))
    added = graph.travel[5, 14] + graph.travel[15, 24] + graph.travel[25, 4]
    k, extra = unite(graph, tour, exchange, k, np.inf)
    assert is_single_tour(exchange, k)
    apply_exchange(tour, exchange, k, np.empty(SIZE, dtype=np.int64))
    assert sorted(tour.order.tolist()) == list(range(SIZE))
    after = tour_cost(graph, tour.order)
    assert after - before == pytest.approx(added - removed + extra)
    assert after == pytest.approx(before)  # joining them back on a ring costs nothing in all
    at = tour.position[[0, SIZE - 1]]
    assert abs(at[0] - at[1]) in (1, SIZE - 1)  # the fixed edge is still there


def test_too_dear_is_given_up() -> None:
    graph = ring_graph()
    tour = Tour(np.arange(SIZE), np.arange(SIZE))
    cycles, k = closed_loops(tour, [24, 14, 4])
    exchange = new_exchange(3 * k)
    alternate(tour, cycles, 1, exchange, np.empty(2 * k, dtype=np.int64))
    assert unite(graph, tour, exchange, k, -1e9)[0] == 0
