"""Windows and classes of the network, on lines whose times are plain."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from fiveroute.models.network import Network
from fiveroute.models.reach import usable_legs
from fiveroute.problem import TeamOrienteering


def line(budgets: list[float]) -> TeamOrienteering:
    """Start, three nodes and destination in a row, 1 s apart; node 2 takes 2 s to serve."""
    x = np.arange(5.0)
    return TeamOrienteering(abs(x[:, None] - x), [0, 0, 2, 0, 0], [0, 1, 1, 1, 0], budgets)


def test_earliest_and_remaining_times_skip_the_slow_node() -> None:
    network = Network.of(line([10.0]))
    assert network.earliest.tolist() == [0.0, 1.0, 4.0, 3.0, 4.0]
    assert network.remaining.tolist() == [4.0, 3.0, 2.0, 1.0, 0.0]


def test_a_budget_too_small_for_the_service_makes_a_node_unreachable() -> None:
    assert Network.of(line([6.0])).reachable.tolist() == [1, 2, 3]
    assert Network.of(line([5.9])).reachable.tolist() == [1, 3]


def test_a_shortcut_over_a_node_counts() -> None:
    """The direct leg takes 10 s, the way over node 1 takes 2 s."""
    times = [[0, 1, 10], [1, 0, 1], [10, 1, 0]]
    problem = TeamOrienteering(times, [0, 0, 0], [0, 1, 0], [2.0])
    network = Network.of(problem)
    assert not network.has_no_route
    assert network.usable(np.array([0, 1])).tolist() == [[False, True, False], [False, False, True]]
    assert Network.of(problem.with_budgets([1.9])).has_no_route


def test_equal_budgets_share_a_copy_of_the_destination() -> None:
    network = Network.of(line([7.0, 4.0, 7.0]))
    assert network.members == ((1,), (0, 2))
    assert network.routes.tolist() == [1.0, 2.0]
    assert network.size == 6
    assert network.latest[-2:].tolist() == network.budgets.tolist()
    usable = network.usable(np.arange(4))
    assert usable[2].tolist() == [False, False, False, True, False, True]  # 6 s for the others
    assert usable[0].tolist() == [False, True, True, True, True, True]


def test_no_leg_enters_the_start_or_stays_where_it_is() -> None:
    usable = Network.of(line([99.0])).usable(np.arange(4))
    assert not usable[:, 0].any()
    assert not usable[np.arange(4), np.arange(4)].any()


def bellman_ford(ways: NDArray[np.float64], origin: int) -> NDArray[np.float64]:
    length = np.full(len(ways), np.inf)
    length[origin] = 0.0
    for _ in ways:
        length = np.minimum(length, (length[:, None] + ways).min(axis=0))
    return length


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 7), st.integers(0, 2**32 - 1))
def test_agrees_with_an_independent_computation(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    travel = rng.uniform(0.0, 10.0, (n + 2, n + 2)) * (rng.random((n + 2, n + 2)) < 0.8)
    service = np.pad(rng.uniform(0.0, 3.0, n), 1)
    problem = TeamOrienteering(travel, service, np.pad(np.ones(n), 1), rng.uniform(1.0, 25.0, 3))
    network, legs = Network.of(problem), usable_legs(problem)
    ways = travel + service
    ways[:, 0] = ways[-1, :] = np.inf
    np.testing.assert_allclose(network.earliest, bellman_ford(ways, 0))
    np.testing.assert_allclose(network.remaining, bellman_ford(ways.T, n + 1))
    usable = network.usable(np.arange(n + 1))
    assert np.array_equal(usable[:, : n + 1], legs[:, : n + 1, : n + 1].any(axis=0))
    for c, auvs in enumerate(network.members):
        for auv in auvs:
            assert np.array_equal(usable[:, n + 1 + c], legs[auv, : n + 1, n + 1])
