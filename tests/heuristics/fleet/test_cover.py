from itertools import product

import numpy as np
import pytest

from fiveroute.heuristics.fleet.cover import improve_cover
from fiveroute.randomness import random_state


def collected(profit: np.ndarray, routes: list[list[int]]) -> float:
    return float(profit[sorted({node for route in routes for node in route})].sum())


@pytest.mark.parametrize("seed", range(10))
def test_few_routes_are_combined_as_well_as_can_be(seed: int) -> None:
    """Every combination that keeps the limits, one by one, collects no more."""
    rng = np.random.default_rng(seed)
    pool = [sorted(rng.choice(12, rng.integers(1, 6), replace=False).tolist()) for _ in range(10)]
    pool[0] = []
    time = np.array([float(len(route)) for route in pool])
    profit, limit = rng.random(12), np.array([3.0, 4.0, 5.0])
    chosen = np.zeros(3, np.int64)
    first = np.cumsum([0, *map(len, pool)])
    nodes = np.array([node for route in pool for node in route], np.int64)
    improve_cover(first, nodes, time, profit, limit, 0.0, chosen, 100, random_state(rng))
    assert (time[chosen] <= limit).all()
    best = max(
        collected(profit, [pool[route] for route in combination])
        for combination in product(range(10), repeat=3)
        if (time[list(combination)] <= limit).all()
    )
    assert collected(profit, [pool[route] for route in chosen]) == pytest.approx(best)


def test_of_equal_routes_the_faster_ones_are_taken() -> None:
    first, nodes = np.array([0, 2, 4]), np.array([0, 1, 1, 0])
    chosen = np.zeros(1, np.int64)
    state = random_state(np.random.default_rng(1))
    time = np.array([3.0, 2.0])
    improve_cover(first, nodes, time, np.ones(2), np.array([9.0]), 0.1, chosen, 0, state)
    assert chosen.tolist() == [1]
