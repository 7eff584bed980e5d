"""Weak duality: any multipliers bound, and what they remove was of no use."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from fiveroute.models import brute_force
from fiveroute.models.flow_program import arcs_of
from fiveroute.models.network import Network
from fiveroute.models.weak_duality import Multipliers, if_idle, if_used, price
from fiveroute.problem import TeamOrienteering


def random_multipliers(network: Network, seed: int) -> Multipliers:
    """Multipliers of the right size and, but for noise, of any sign."""
    rng = np.random.default_rng(seed)
    n, count = network.n, int(rng.integers(0, 4)) if network.n else 0
    sets = rng.random((count, n + 1)) < 0.5
    sets[:, 0] = False
    served = rng.integers(1, n + 1, count)
    sets[np.arange(count), served] = True
    scale = rng.random() / max(network.horizon, 1.0)
    clock = np.append(0.0, rng.normal(0.0, scale, n))
    balance = rng.normal(0.0, 0.3, n + 1)
    return Multipliers(balance, clock, rng.normal(scale), sets, served, rng.normal(0.1, 0.3, count))


@pytest.mark.parametrize("seed", range(80))
def test_any_multipliers_bound_the_optimum(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    network = Network.of(truth.problem)
    if truth.optimum is None or network.has_no_route:
        return
    for trial in range(8):
        assert price(network, random_multipliers(network, trial)).value >= truth.optimum


@pytest.mark.parametrize("seed", range(60))
def test_what_the_best_plan_does_is_possible(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    if truth.optimum is None:
        return
    plan = brute_force.solve(truth.problem).plan
    assert plan is not None
    network = Network.of(truth.problem)
    for trial in range(8):
        multipliers = random_multipliers(network, trial).admissible()
        dual = price(network, multipliers)
        assert (if_used(network, multipliers, dual)[arcs_of(network, plan)] >= truth.optimum).all()
        idle = if_idle(network, dual)[1 : network.n + 1]
        assert all(idle[node - 1] >= truth.optimum for node in plan.idle(truth.problem))


def test_no_price_at_all_leaves_all_data_within_reach() -> None:
    times = np.full((4, 4), 2.0)
    problem = TeamOrienteering(times, [0, 1, 9, 0], [0, 3, 5, 0], [6.0])
    network = Network.of(problem)
    assert price(network, Multipliers.zero(2)).value == pytest.approx(3.0)


def test_a_price_of_time_by_hand() -> None:
    """Node 1 earns 3 in 5 s, the direct leg takes 2 s; 1/2 a second leaves it nothing.

    The bound is 1/2 * 6 s of budget; the arc to node 1 gains 3 - 1/2 (2 + 1), of which the
    leg home takes 1/2 * 2: the direct leg loses 1 and the way over the node gains 1/2.
    """
    problem = TeamOrienteering(np.full((3, 3), 2.0), [0, 1, 0], [0, 3, 0], [6.0])
    network = Network.of(problem)
    priced = Multipliers(
        np.array([0.0, 0.0]), np.zeros(2), 0.5, np.zeros((0, 2), np.bool_),
        np.zeros(0, np.int64), np.zeros(0),
    )  # fmt: skip
    dual = price(network, priced)
    assert dual.best[1:].tolist() == [1.5, -1.0]
    assert dual.value == pytest.approx(3.0 + 1.5 - 1.0)


def test_wrong_signs_are_dropped() -> None:
    sets = np.array([[False, True], [False, True]])
    wrong = Multipliers(
        np.zeros(2), np.zeros(2), -1.0, sets, np.array([1, 1]), np.array([-1.0, 2.0])
    )
    right = wrong.admissible()
    assert right.price == 0.0
    assert right.weight.tolist() == [2.0]
    assert len(right.sets) == len(right.served) == 1
