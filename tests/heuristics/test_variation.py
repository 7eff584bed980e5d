"""New individuals are permutations of different nodes, whatever they are made of."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.variation import crossover, mutate, random_route
from fiveroute.randomness import random_state


def random_legs(n: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).random((n + 2, n + 2))


def proper(stops: np.ndarray, length: int) -> bool:
    """Whether a route runs from start to destination through different nodes."""
    inner = stops[1 : length - 1].tolist()
    end = len(stops) - 1
    return bool(
        stops[0] == 0
        and stops[length - 1] == end
        and len(set(inner)) == len(inner)
        and all(0 < node < end for node in inner)
    )


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 12), st.integers(0, 2**32 - 1))
def test_all_operators_make_proper_routes(n: int, seed: int) -> None:
    legs = random_legs(n, seed)
    state = random_state(np.random.default_rng(seed))
    first, second, child = (np.zeros(n + 2, np.int64) for _ in range(3))
    one, two = random_route(legs, first, state), random_route(legs, second, state)
    assert proper(first, one)
    assert proper(second, two)
    for _ in range(5):
        length = crossover(first, one, second, two, child, state)
        assert proper(child, length)
        assert set(child[:length]) <= {*first[:one], *second[:two]}
        length = mutate(legs, child, length, state)
        assert proper(child, length)


def test_random_routes_are_of_any_size() -> None:
    legs = random_legs(4, 1)
    state = random_state(np.random.default_rng(1))
    stops = np.zeros(6, np.int64)
    assert {random_route(legs, stops, state) for _ in range(100)} == {2, 3, 4, 5, 6}


@pytest.mark.parametrize("seed", range(4))
def test_parents_meet_at_a_common_node(seed: int) -> None:
    first, second = np.array([0, 1, 2, 3, 6, 0, 0]), np.array([0, 4, 2, 5, 6, 0, 0])
    child = np.zeros(7, np.int64)
    length = crossover(first, 5, second, 5, child, random_state(np.random.default_rng(seed)))
    assert child[:length].tolist() == [0, 1, 2, 5, 6]


def test_equal_parents_have_the_same_child() -> None:
    parent, child = np.array([0, 3, 1, 2, 4]), np.zeros(5, np.int64)
    state = random_state(np.random.default_rng(1))
    for _ in range(10):
        assert crossover(parent, 5, parent, 5, child, state) == 5
        assert child.tolist() == parent.tolist()
