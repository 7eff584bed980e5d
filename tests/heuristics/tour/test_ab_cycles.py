"""AB-cycles use up the difference of two tours, each edge once."""

from collections import Counter

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.tour.ab_cycles import ab_cycles
from fiveroute.heuristics.tour.exchange import Tour
from fiveroute.randomness import random_state


def edges_of(order: np.ndarray) -> set[frozenset[int]]:
    return {
        frozenset(edge) for edge in zip(order.tolist(), np.roll(order, -1).tolist(), strict=True)
    }


@settings(deadline=None, max_examples=100)
@given(st.integers(5, 40), st.integers(0, 10**6))
def test_every_differing_edge_once(size: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = rng.permutation(size), rng.permutation(size)
    cycles = ab_cycles(Tour(a, np.argsort(a)), Tour(b, np.argsort(b)), random_state(rng))
    removed: Counter[frozenset[int]] = Counter()
    added: Counter[frozenset[int]] = Counter()
    for first, end in zip(cycles.starts[:-1], cycles.starts[1:], strict=True):
        w = cycles.vertices[first:end].tolist()
        assert len(w) >= 4
        assert len(w) % 2 == 0
        removed.update(frozenset(w[i : i + 2]) for i in range(0, len(w), 2))
        added.update(frozenset((w[i], w[(i + 1) % len(w)])) for i in range(1, len(w), 2))
    assert removed == Counter(edges_of(a) - edges_of(b))
    assert added == Counter(edges_of(b) - edges_of(a))


def test_equal_tours_have_none() -> None:
    a = np.arange(9)
    b = np.roll(a, 4)[::-1].copy()
    state = random_state(np.random.default_rng(1))
    cycles = ab_cycles(Tour(a, np.argsort(a)), Tour(b, np.argsort(b)), state)
    assert cycles.starts.tolist() == [0]
