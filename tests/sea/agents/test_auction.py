"""The auction: within min(M, J) epsilon of the best assignment, and it ends."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from fiveroute.errors import InputError
from fiveroute.sea.agents.auction import assign_by_auction


def value(psi: np.ndarray, won: np.ndarray) -> float:
    return float(sum(psi[m, j] for m, j in enumerate(won) if j >= 0))


@settings(deadline=None, max_examples=200)
@given(
    fleet=st.integers(1, 8),
    nodes=st.integers(1, 12),
    seed=st.integers(0, 2**32 - 1),
    epsilon=st.sampled_from([1e-4, 1e-2, 0.2]),
    whole=st.booleans(),
)
def test_value_is_within_epsilon_of_the_best(
    fleet: int, nodes: int, seed: int, epsilon: float, whole: bool
) -> None:
    rng = np.random.default_rng(seed)
    psi = rng.random((fleet, nodes)) * (rng.random((fleet, nodes)) < 0.7)
    if whole:
        psi = np.floor(psi * 4.0)
    won = assign_by_auction(psi, epsilon)
    taken = won[won >= 0]
    assert len(set(taken.tolist())) == len(taken)
    assert all(psi[m, j] > 0.0 for m, j in enumerate(won) if j >= 0)
    best = psi[linear_sum_assignment(psi, maximize=True)].sum()
    assert value(psi, won) >= best - min(fleet, nodes) * epsilon - 1e-12


def test_the_default_epsilon_costs_less_than_two_per_cent() -> None:
    rng = np.random.default_rng(5)
    shares = []
    for _ in range(1000):
        psi = rng.random((4, 5)) * (rng.random((4, 5)) < 0.6)
        best = psi[linear_sum_assignment(psi, maximize=True)].sum()
        shares.append(value(psi, assign_by_auction(psi)) / best if best else 1.0)
    assert np.mean(shares) > 0.999


def test_an_uncontested_node_is_awarded() -> None:
    assert assign_by_auction([[0.3]]).tolist() == [0]
    assert assign_by_auction([[0.0], [0.3]]).tolist() == [-1, 0]


def test_nothing_to_bid_for() -> None:
    assert assign_by_auction(np.zeros((3, 2))).tolist() == [-1, -1, -1]
    assert assign_by_auction(np.zeros((3, 0))).tolist() == [-1, -1, -1]


@pytest.mark.parametrize(("psi", "epsilon"), [([[np.inf]], None), ([[1.0]], 0.0)])
def test_what_makes_no_sense_is_refused(psi: list[list[float]], epsilon: float | None) -> None:
    with pytest.raises(InputError):
        assign_by_auction(psi, epsilon)
