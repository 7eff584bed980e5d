"""Exchanges change exactly the edges that they name."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.tour.exchange import (
    Cycles,
    Tour,
    across,
    alternate,
    apply_exchange,
    beside,
    is_single_tour,
    new_exchange,
    segment_length,
    segment_of_port,
)


def new_tour(order: np.ndarray) -> Tour:
    return Tour(order.copy(), np.argsort(order))


def edges_of(order: np.ndarray) -> set[frozenset[int]]:
    return {
        frozenset(edge) for edge in zip(order.tolist(), np.roll(order, -1).tolist(), strict=True)
    }


def components(edges: set[frozenset[int]], size: int) -> int:
    """Number of connected parts of a graph, counted by merging."""
    part = list(range(size))
    for u, v in (tuple(edge) for edge in edges):
        old, new = part[u], part[v]
        part = [new if p == old else p for p in part]
    return len(set(part))


@settings(deadline=None, max_examples=150)
@given(st.integers(8, 40), st.integers(2, 6), st.integers(0, 10**6))
def test_alternating_cycle(size: int, k: int, seed: int) -> None:
    """Random edges removed and joined in random order: a tour, or sub-tours told as such."""
    rng = np.random.default_rng(seed)
    tour = new_tour(rng.permutation(size))
    before = edges_of(tour.order)
    walk: list[int] = []
    for p in rng.choice(size, k, replace=False):
        edge = [int(tour.order[p]), int(tour.order[(p + 1) % size])]
        walk += edge if rng.random() < 0.5 else edge[::-1]
    removed = {frozenset(walk[i : i + 2]) for i in range(0, 2 * k, 2)}
    added = [frozenset((walk[i], walk[(i + 1) % (2 * k)])) for i in range(1, 2 * k, 2)]
    after = before - removed | set(added)
    if len(after) != size or min(map(len, added)) < 2:
        return  # an added edge is a loop, or was there before
    exchange = new_exchange(k)
    cycles = Cycles(np.array(walk), np.array([0, 2 * k]))
    assert alternate(tour, cycles, 1, exchange, np.empty(2 * k, dtype=np.int64)) == k
    single = is_single_tour(exchange, k)
    assert single == (components(after, size) == 1)
    if single:
        apply_exchange(tour, exchange, k, np.empty(size, dtype=np.int64))
        assert edges_of(tour.order) == after
        assert (tour.order[tour.position] == np.arange(size)).all()


def test_two_opt_by_hand() -> None:
    """On 0 1 2 3 4 5, edges (1, 2) and (4, 5) for (1, 4) and (2, 5) turn 2 3 4 round."""
    tour = new_tour(np.arange(6))
    exchange = new_exchange(2)
    cycles = Cycles(np.array([2, 1, 4, 5]), np.array([0, 4]))
    k = alternate(tour, cycles, 1, exchange, np.empty(4, dtype=np.int64))
    assert exchange.cut.tolist() == [1, 4]
    assert [segment_length(tour, exchange, k, r) for r in range(k)] == [3, 3]
    assert is_single_tour(exchange, k)
    apply_exchange(tour, exchange, k, np.empty(6, dtype=np.int64))
    assert edges_of(tour.order) == edges_of(np.array([0, 1, 4, 3, 2, 5]))


def test_ports_of_one_segment() -> None:
    for k in (2, 3, 7):
        for port in range(2 * k):
            assert across(across(port, k), k) == port != across(port, k)
            assert segment_of_port(across(port, k), k) == segment_of_port(port, k)


def test_neighbours_wrap_round() -> None:
    tour = new_tour(np.array([3, 1, 2, 0]))
    assert (beside(tour, 3, 0), beside(tour, 0, 1), beside(tour, 1, 1)) == (0, 3, 2)
