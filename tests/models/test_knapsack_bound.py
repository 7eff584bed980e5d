"""The knapsack bound: by hand, and against brute force."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from fiveroute.models.knapsack_bound import fractional_knapsack, knapsack_bound
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering


def test_parts_of_items() -> None:
    profit, weight = np.array([6.0, 10.0, 12.0]), np.array([1.0, 2.0, 3.0])
    assert fractional_knapsack(profit, weight, 5.0) == pytest.approx(24.0)
    assert fractional_knapsack(profit, weight, 0.0) == pytest.approx(0.0)
    assert fractional_knapsack(profit, weight, 99.0) == pytest.approx(28.0)


def test_weightless_items_are_free() -> None:
    assert fractional_knapsack(np.array([1.0, 2.0]), np.zeros(2), 0.0) == pytest.approx(3.0)


def test_weights_next_to_nothing_overflow_nothing() -> None:
    profit, weight = np.array([1e9, 3e9]), np.array([1e-308, 0.0])
    assert fractional_knapsack(profit, weight, 0.0) == pytest.approx(3e9)
    assert fractional_knapsack(profit, weight, 5e-309) == pytest.approx(3.5e9)


def test_shares_by_hand() -> None:
    """All legs take 1 s: the ends take 1 s of every route, and every node 1 s of the rest."""
    problem = TeamOrienteering(np.ones((7, 7)), np.zeros(7), [0, 1, 1, 1, 1, 1, 0], [2.5, 3.5])
    assert knapsack_bound(Network.of(problem)) == pytest.approx(4.0)


@pytest.mark.parametrize("seed", range(80))
def test_bounds_the_optimum(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    if truth.optimum is not None:
        assert knapsack_bound(Network.of(truth.problem)) >= truth.optimum
