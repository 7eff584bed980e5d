"""Children are tours, and all that the population knows of them is true."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.tour.crossover import crossover, start_population
from fiveroute.heuristics.tour.diversity import count_edges, multiplicity
from fiveroute.heuristics.tour.graph import giant_graph, tour_cost
from fiveroute.heuristics.tour.greedy import greedy_tour
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.randomness import random_state


@settings(deadline=None, max_examples=40)
@given(st.integers(6, 50), st.booleans(), st.booleans(), st.integers(0, 10**6))
def test_books_are_kept(n: int, asymmetric: bool, block: bool, seed: int) -> None:
    rng = np.random.default_rng(seed)
    travel = rng.uniform(0.0, 10.0, (n + 2, n + 2))
    rest = np.zeros(n + 2)
    times = travel if asymmetric else travel + travel.T
    graph = giant_graph(TeamOrienteering(times, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    orders = np.array([greedy_tour(graph, 5.0, rng) for _ in range(6)])
    population = start_population(graph, orders)
    before, state = population.lengths.copy(), random_state(rng)
    gains = np.zeros(6)
    for _ in range(3):
        for a in range(6):
            gains[a] += crossover(graph, population, a, (a + 1) % 6, block, 1e-9, state)
    assert population.lengths.tolist() == pytest.approx((before - gains).tolist())
    assert (gains >= 0.0).all()
    counted = count_edges(population.orders)
    for order, position, length in zip(
        population.orders, population.positions, population.lengths, strict=True
    ):
        assert sorted(order.tolist()) == list(range(graph.size))
        assert (position[order] == np.arange(graph.size)).all()
        assert tour_cost(graph, order) == pytest.approx(length)  # finite: no forbidden edge
        ahead, behind, mates = np.roll(order, -1), np.roll(order, 1), graph.mate[order]
        assert ((mates < 0) | (mates == ahead) | (mates == behind)).all()
        for u, v in zip(order.tolist(), ahead.tolist(), strict=True):
            assert multiplicity(population.edges, u, v) == multiplicity(counted, u, v)


def test_a_tour_learns_nothing_from_itself() -> None:
    travel = np.abs(np.subtract.outer(np.arange(20.0), np.arange(20.0))) ** 2
    rest = np.zeros(20)
    graph = giant_graph(TeamOrienteering(travel, rest, rest, [1.0]), Limits().start())
    assert graph is not None
    population = start_population(graph, np.array([np.arange(20), np.arange(20)]))
    state = random_state(np.random.default_rng(1))
    assert crossover(graph, population, 0, 1, False, 1e-9, state) == 0.0
