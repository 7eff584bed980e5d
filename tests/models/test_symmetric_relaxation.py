"""The symmetric relaxation, its graph and its duality."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.network import Network
from fiveroute.models.symmetric_duality import SymmetricMultipliers, symmetric_bound
from fiveroute.models.symmetric_graph import SymmetricGraph
from fiveroute.models.symmetric_relaxation import SymmetricRelaxation
from fiveroute.problem import TeamOrienteering


@pytest.mark.parametrize("seed", range(80))
def test_bounds_the_optimum(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    network = Network.of(truth.problem)
    if truth.optimum is None or network.n == 0:
        return
    relaxation = SymmetricRelaxation(network, Limits().start())
    relaxation.solve()
    assert relaxation.bound >= truth.optimum


@pytest.mark.parametrize("seed", range(60))
def test_any_multipliers_bound_the_optimum(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    network = Network.of(truth.problem)
    if truth.optimum is None or network.n == 0:
        return
    rng = np.random.default_rng(seed)
    graph, size = SymmetricGraph.of(network), network.n + 2
    for _ in range(5):
        count = int(rng.integers(0, 4))
        sets = rng.random((count, size)) < 0.5
        sets[:, 0] = False
        served = rng.integers(1, network.n + 1, count)
        sets[np.arange(count), served] = True
        served[sets[:, -1]] = size - 1
        scale = rng.random() / max(network.horizon, 1.0)
        node, weight = rng.normal(0.0, 0.3, size), rng.normal(0.1, 0.3, count)
        multipliers = SymmetricMultipliers.of(node, rng.normal(scale), sets, served, weight)
        others = np.full(size, -np.inf)
        for vertices, times in graph.blocks():
            others[vertices] = multipliers.gains(vertices, times).max(axis=1)
        bound = symmetric_bound(network, multipliers, np.zeros(0), others)
        assert bound >= truth.optimum


def test_the_gain_of_an_edge_is_the_same_alone_and_in_a_block() -> None:
    rng = np.random.default_rng(1)
    problem = TeamOrienteering(
        rng.random((7, 7)), np.zeros(7), [0, 1, 1, 1, 1, 1, 0], budgets=[9.0]
    )
    graph = SymmetricGraph.of(Network.of(problem))
    sets = rng.random((3, 7)) < 0.6
    multipliers = SymmetricMultipliers.of(
        rng.normal(size=7), 0.3, sets, np.array([1, 2, 6]), np.array([0.2, 0.5, 0.7])
    )
    edges = np.array(np.triu_indices(7, 1))
    ((vertices, times),) = graph.blocks()
    assert vertices.tolist() == list(range(7))
    alone = multipliers.gains_of(edges, graph.costs(edges))
    assert multipliers.gains(vertices, times)[tuple(edges)] == pytest.approx(alone)


def test_an_edge_takes_its_shorter_direction_if_that_is_of_use() -> None:
    """The short way from node 1 to node 2 cannot be used: nothing reaches node 1 in time."""
    travel = np.array([[0, 9, 1, 1], [9, 0, 1, 1], [9, 5, 0, 1], [9, 9, 9, 0]], dtype=np.float64)
    problem = TeamOrienteering(travel, [0, 2, 0, 0], [0, 1, 1, 0], [9.0])
    graph = SymmetricGraph.of(Network.of(problem))
    edges = np.array([[1, 0, 0, 0], [2, 1, 2, 3]])
    assert graph.costs(edges).tolist() == [6.0, np.inf, 1.0, 1.0]
    assert graph.nearest(5).shape[0] == 2


def test_a_stopped_relaxation_still_bounds() -> None:
    rng = np.random.default_rng(2)
    xy = rng.random((42, 2))
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    profit = np.pad(rng.random(40), 1)
    problem = TeamOrienteering(travel, np.zeros(42), profit, [1.5, 1.5])
    bounds = []
    for limits, tail in ((Limits(time=0.0), 0.0), (Limits(), 0.1), (Limits(), 0.0)):
        relaxation = SymmetricRelaxation(Network.of(problem), limits.start())
        relaxation.solve(tail=tail)
        bounds.append(relaxation.bound)
    assert bounds[0] == pytest.approx(problem.total_profit)
    assert bounds == sorted(bounds, reverse=True)
