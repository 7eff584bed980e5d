"""Walks against all routes through distinct nodes."""

from itertools import pairwise, permutations

import numpy as np
import pytest

from fiveroute.models.branch_price.completion import complete, completion_bound, over_legs


def field(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Five nodes with asymmetric legs, some of no time, and values of either sign."""
    rng = np.random.default_rng(seed)
    leg = rng.uniform(0.0, 10.0, (7, 7)) * (rng.random((7, 7)) < 0.7)
    leg[:, 0] = leg[-1] = np.inf
    leg[rng.random((7, 7)) < 0.1] = np.inf
    np.fill_diagonal(leg, np.inf)
    gain = np.pad(rng.uniform(-1.0, 3.0, 5), 1)
    return leg, gain


def routes_to(leg: np.ndarray, end: int) -> list[tuple[float, tuple[int, ...]]]:
    """Times and nodes of all routes from the start to a vertex."""
    inner = [k for k in range(1, len(leg) - 1) if k != end]
    found = []
    for count in range(len(inner) + 1):
        for nodes in permutations(inner, count):
            time = sum(leg[i, j] for i, j in pairwise((0, *nodes, end)))
            if np.isfinite(time):
                found.append((time, (*nodes, end)))
    return found


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("memory", [0, 2, 4])
def test_no_route_is_worth_more_than_a_walk(seed: int, memory: int) -> None:
    leg, gain = field(seed)
    walks = complete(leg, gain, 0, 20.0, 40, memory)
    for end in range(1, 7):
        for time, nodes in routes_to(leg, end):
            if time > 20.0:
                continue
            value = gain[list(nodes)].sum()
            for known in range(1 << memory):
                near = {int(walks.nearest[end, b]) for b in range(memory) if known >> b & 1}
                if not near & set(nodes):
                    bound = completion_bound(walks.value, walks.step, time, end, known)
                    assert bound >= value - 1e-12


def test_walks_that_remember_all_are_routes() -> None:
    """Legs of whole steps and room for all other nodes leave no slack."""
    rng = np.random.default_rng(3)
    leg = rng.integers(1, 6, (6, 6)).astype(np.float64)
    leg[:, 0] = leg[-1] = np.inf
    np.fill_diagonal(leg, np.inf)
    gain = np.pad(rng.uniform(0.5, 2.0, 4), 1)
    walks = complete(leg, gain, 0, 12.0, 12, 3)
    best = max(gain[list(nodes)].sum() for time, nodes in routes_to(leg, 5) if time <= 12.0)
    assert walks.of_routes(np.array([12.0]), 5) == pytest.approx([best])


def test_more_memory_never_weakens_the_bound() -> None:
    leg, gain = field(5)
    limits = np.array([5.0, 11.0, 20.0])
    bounds = [complete(leg, gain, 0, 20.0, 400, q).of_routes(limits, 6) for q in range(5)]
    assert (np.diff(bounds, axis=0) <= 1e-12).all()


@pytest.mark.parametrize("seed", range(6))
def test_a_leg_is_worth_as_much_as_any_route_over_it(seed: int) -> None:
    leg, gain = field(seed)
    behind = complete(leg, gain, 0, 15.0, 60, 2)
    ahead = complete(leg.T, gain, 6, 15.0, 60, 2)
    most = over_legs(leg, behind.value, ahead.value, behind.step, 15.0, 0.0)
    for time, nodes in routes_to(leg, 6):
        if time <= 15.0:
            value = gain[list(nodes)].sum()
            assert all(most[i, j] >= value - 1e-12 for i, j in pairwise((0, *nodes)))


def test_walks_back_are_walks_over_reversed_legs() -> None:
    leg, gain = field(8)
    there = complete(leg, gain, 0, 20.0, 400, 3).of_routes(np.array([9.0, 20.0]), 6)
    back = complete(leg.T, gain, 6, 20.0, 400, 3).of_routes(np.array([9.0, 20.0]), 0)
    assert np.isfinite(there).all()
    np.testing.assert_allclose(there, back, atol=0.5 * gain.max())
