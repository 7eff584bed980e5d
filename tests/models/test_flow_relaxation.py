"""The flow relaxation: bounds, convergence, and agreement with its symmetric sister."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.flow_relaxation import FlowRelaxation, crossing, relax
from fiveroute.models.network import Network
from fiveroute.models.symmetric_relaxation import SymmetricRelaxation
from fiveroute.problem import TeamOrienteering


def field(n: int, seed: int, fleet: int = 2) -> TeamOrienteering:
    """Nodes in a square whose side takes half of the budget."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0.0, 5.0, (n + 2, 2))
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    return TeamOrienteering(travel, np.zeros(n + 2), np.pad(rng.random(n), 1), [10.0] * fleet)


@pytest.mark.parametrize("seed", range(80))
@pytest.mark.parametrize("timed", [False, True])
def test_bounds_the_optimum(seed: int, timed: bool, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    network = Network.of(truth.problem)
    relaxation = FlowRelaxation(network, Limits().start(), timed=timed)
    if not network.has_no_route:
        assert relaxation.solve()
    if truth.optimum is not None:
        assert relaxation.dual.value >= truth.optimum


def test_the_clock_forbids_what_the_sum_of_budgets_allows() -> None:
    """Two AUVs with 4 s each cannot reach a node 3 s away, 6 s and 2 s could."""
    times = np.array([[0.0, 3.0, 1.0], [3.0, 0.0, 3.0], [1.0, 3.0, 0.0]])
    problem = TeamOrienteering(times, [0, 0, 0], [0, 1, 0], [5.9, 5.9])
    network = Network.of(problem)
    assert network.reachable.tolist() == []
    assert relax(network, Limits().start()).dual.value == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("timed", [False, True])
def test_arcs_that_enter_later_make_up_for_those_left_out(timed: bool) -> None:
    network = Network.of(field(30, seed=3))
    everything = network.usable(np.arange(network.n + 1))
    whole = FlowRelaxation(network, Limits().start(), timed=timed, arcs=everything)
    sparse = FlowRelaxation(network, Limits().start(), timed=timed)
    assert whole.solve()
    assert sparse.solve()
    assert sparse.present.sum() < everything.sum()
    assert sparse.dual.value == pytest.approx(whole.dual.value, rel=1e-4)


@pytest.mark.parametrize("seed", range(4))
def test_directions_do_not_matter_where_times_are_symmetric(seed: int) -> None:
    """Two formulations, two kinds of cuts, two proofs by duality, one bound."""
    network = Network.of(field(25, seed))
    directed = FlowRelaxation(network, Limits().start(), timed=False)
    undirected = SymmetricRelaxation(network, Limits().start())
    assert directed.solve()
    assert undirected.solve()
    assert directed.dual.value == pytest.approx(undirected.bound, rel=5e-3)


def test_the_clock_never_weakens() -> None:
    for seed in range(4):
        network = Network.of(field(25, seed))
        rough = FlowRelaxation(network, Limits().start(), timed=False)
        rough.solve()
        assert relax(network, Limits().start()).dual.value <= rough.dual.value


def test_an_expired_clock_leaves_all_data_as_the_bound() -> None:
    problem = field(10, seed=1)
    relaxation = FlowRelaxation(Network.of(problem), Limits(time=0.0).start())
    assert not relaxation.solve()
    assert relaxation.dual.value == pytest.approx(problem.total_profit)


def test_missing_routes_are_priced_out_where_no_plan_exists() -> None:
    """Both AUVs need node 1 to get across in time: the bound falls below zero."""
    times = [[0, 1, 10], [9, 0, 1], [9, 9, 0]]
    problem = TeamOrienteering(times, [0, 0, 0], [0, 1, 0], [2.0, 2.0])
    relaxation = FlowRelaxation(Network.of(problem), Limits().start())
    relaxation.solve()
    assert relaxation.dual.value < 0.0


def test_coefficients_of_a_set() -> None:
    """Arcs into the set count, those inside and out of it do not; y_k is its arcs in."""
    sets, served = np.array([[False, True, True, False]]), np.array([2])
    tails, heads = np.array([0, 1, 3, 2, 0]), np.array([1, 2, 2, 3, 4])
    rows = crossing(sets, served, tails, heads).toarray()
    assert rows.tolist() == [[1.0, -1.0, 0.0, 0.0, 0.0]]
