"""Pricing against all routes, with every part at work: classes, cuts, neighbourhoods."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.branch_price.duals import Cut, Duals
from fiveroute.models.branch_price.master import coefficient
from fiveroute.models.branch_price.neighbourhoods import is_forgetful, nearest
from fiveroute.models.branch_price.pricing import Pricer
from fiveroute.models.branch_price.roads import Roads, is_mirrored
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering


def problem(seed: int) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    n = 6
    xy = rng.uniform(0.0, 10.0, (n + 2, 2))
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    if seed % 3 == 1:
        travel = travel * rng.uniform(0.5, 1.5, travel.shape)
    if seed % 3 == 2:
        travel = np.rint(travel) * (rng.random(travel.shape) < 0.8)
    service = np.pad(rng.integers(0, 3, n).astype(np.float64), 1)
    budgets = rng.uniform(12.0, 28.0, 1 + seed % 3)
    return TeamOrienteering(travel, service, np.pad(rng.uniform(0.1, 1.0, n), 1), budgets)


def multipliers(roads: Roads, seed: int, cuts: int) -> Duals:
    rng = np.random.default_rng(seed + 1000)
    n, classes = roads.problem.n, len(roads.limits)
    chosen = []
    for _ in range(cuts):
        nodes = tuple(int(k) for k in rng.choice(np.arange(1, n + 1), 3, replace=False))
        memory = frozenset(nodes) | {int(k) for k in rng.integers(1, n + 1, 2)}
        chosen.append(Cut((nodes[0], nodes[1], nodes[2]), memory))
    return Duals(
        np.pad(rng.uniform(-0.1, 0.8, n), 1),
        np.full(classes, -5.0),
        tuple(chosen),
        rng.uniform(0.0, 0.5, cuts),
    )


def worth(roads: Roads, duals: Duals, route: tuple[int, ...]) -> float:
    paid = sum(
        price * coefficient(route, cut) for cut, price in zip(duals.cuts, duals.price, strict=True)
    )
    return float(roads.worth(route) - duals.node[list(route)].sum() - paid)


def best_of_all(roads: Roads, duals: Duals) -> np.ndarray:
    best = np.full(len(roads.limits), -np.inf)
    n = roads.problem.n
    for count in range(n + 1):
        for route in permutations(range(1, n + 1), count):
            auv_class = roads.class_of(roads.duration(route))
            if auv_class < len(best):
                best[auv_class] = max(best[auv_class], worth(roads, duals, route))
    return np.maximum.accumulate(best)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("cuts", [0, 4])
@pytest.mark.parametrize("toll", [0.0, 0.05])
def test_finds_the_most_valuable_route(seed: int, cuts: int, toll: float) -> None:
    """With neighbourhoods of all nodes, ng-routes are elementary."""
    roads = replace(Roads.of(Network.of(problem(seed))), toll=toll)
    duals = multipliers(roads, seed, cuts)
    everything = np.ones(roads.leg.shape, dtype=np.bool_)
    priced = Pricer(roads, everything).price(duals, Limits().start())
    assert priced is not None
    assert priced.is_exact
    np.testing.assert_allclose(priced.best, best_of_all(roads, duals), atol=1e-9)
    found = max(worth(roads, duals, route) for route in priced.routes)
    assert found == pytest.approx(priced.best[-1])


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("toll", [0.0, 0.05])
def test_one_half_does_for_two_where_both_directions_are_alike(seed: int, toll: float) -> None:
    """No service, symmetric legs, and the destination where the start is."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0.0, 10.0, (8, 2))
    xy[-1] = xy[0]
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    profit = np.pad(rng.uniform(0.1, 1.0, 6), 1)
    alike = TeamOrienteering(travel, np.zeros(8), profit, rng.uniform(12.0, 28.0, 2))
    roads = replace(Roads.of(Network.of(alike)), toll=toll)
    assert is_mirrored(roads.leg)
    duals = multipliers(roads, seed, 4)
    everything = np.ones(roads.leg.shape, dtype=np.bool_)
    priced = Pricer(roads, everything).price(duals, Limits().start())
    assert priced is not None
    np.testing.assert_allclose(priced.best, best_of_all(roads, duals), atol=1e-9)


@pytest.mark.parametrize("seed", range(12))
def test_small_neighbourhoods_bound_it_from_above(seed: int) -> None:
    roads = Roads.of(Network.of(problem(seed)))
    duals = multipliers(roads, seed, 3)
    best = best_of_all(roads, duals)
    near = nearest(roads, 2)
    priced = Pricer(roads, near).price(duals, Limits().start())
    assert priced is not None
    assert (priced.best >= best - 1e-9).all()
    assert (Pricer(roads, near).walk_bound(duals) >= best - 1e-9).all()
    for route in priced.routes:
        assert is_forgetful(near, route)
        assert worth(roads, duals, route) > -5.0


@pytest.mark.parametrize("half", [0.2, 0.5, 0.8])
def test_the_half_way_point_does_not_matter(half: float) -> None:
    roads = Roads.of(Network.of(problem(3)))
    duals = multipliers(roads, 3, 4)
    pricer = Pricer(roads, nearest(roads, 4))
    pricer.half = half
    priced = pricer.price(duals, Limits().start())
    assert priced is not None
    expected = Pricer(roads, nearest(roads, 4)).price(duals, Limits().start())
    assert expected is not None
    np.testing.assert_allclose(priced.best, expected.best, atol=1e-12)


def test_quick_pricing_finds_routes_worth_their_floor() -> None:
    roads = Roads.of(Network.of(problem(0)))
    duals = multipliers(roads, 0, 0)
    priced = Pricer(roads, nearest(roads, 4)).price(duals, Limits().start(), exact=False)
    assert priced is not None
    assert priced.routes
    assert not priced.is_exact
    assert all(roads.class_of(roads.duration(r)) < len(roads.limits) for r in priced.routes)


def test_no_route_beats_a_high_floor() -> None:
    roads = Roads.of(Network.of(problem(1)))
    duals = multipliers(roads, 1, 0)
    high = Duals(duals.node, np.full(len(roads.limits), 50.0))
    priced = Pricer(roads, nearest(roads, 4)).price(high, Limits().start())
    assert priced is not None
    assert priced.routes == []
    assert (priced.best <= 50.0 + 1e-9).all()


def test_without_time_the_walks_bound() -> None:
    roads = Roads.of(Network.of(problem(2)))
    duals = multipliers(roads, 2, 0)
    pricer = Pricer(roads, nearest(roads, 4))
    pricer.most_labels = 0
    priced = pricer.price(duals, Limits(time=0.0).start())
    assert priced is not None
    np.testing.assert_array_equal(priced.best >= best_of_all(roads, duals) - 1e-9, True)


def test_useless_legs_are_on_no_valuable_route() -> None:
    roads = Roads.of(Network.of(problem(4)))
    duals = multipliers(roads, 4, 0)
    floors = best_of_all(roads, duals) - 0.4
    useless = Pricer(roads, nearest(roads, 4)).useless_legs(duals, floors)
    n, kept = roads.problem.n, 0
    for count in range(n + 1):
        for route in permutations(range(1, n + 1), count):
            auv_class = roads.class_of(roads.duration(route))
            if auv_class < len(floors) and worth(roads, duals, route) > floors[auv_class]:
                stops = (0, *route, n + 1)
                assert not useless[list(stops[:-1]), list(stops[1:])].any()
                kept += 1
    assert kept > 0
    assert useless[np.isfinite(roads.leg)].any()


def test_between_mixes_and_masks_leave_free_cuts_out() -> None:
    roads = Roads.of(Network.of(problem(4)))
    one, other = multipliers(roads, 4, 3), multipliers(roads, 4, 3)
    middle = one.between(Duals(other.node * 0.0, other.floor, other.cuts, other.price * 0.0), 0.25)
    np.testing.assert_allclose(middle.node, 0.25 * one.node)
    free = Duals(one.node, one.floor, one.cuts, np.array([0.0, 0.5, 0.0]))
    in_cut, recall, sigma = free.cut_masks()
    assert sigma.tolist() == [0.5]
    assert set(np.flatnonzero(in_cut)) == set(one.cuts[1].nodes)
    assert set(np.flatnonzero(recall)) == set(one.cuts[1].memory)
