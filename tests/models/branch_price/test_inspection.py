"""Inspection against the worth of every route by itself."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.branch_price.duals import Cut, Duals
from fiveroute.models.branch_price.inspection import Inspector
from fiveroute.models.branch_price.master import coefficient
from fiveroute.models.branch_price.pool import Pool
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering

EVERY = frozenset(range(7))


def roads(seed: int, toll: float) -> Roads:
    rng = np.random.default_rng(seed)
    travel = rng.uniform(1.0, 4.0, (7, 7))
    profit = np.pad(rng.uniform(0.1, 1.0, 5), 1)
    problem = TeamOrienteering(travel, np.zeros(7), profit, [9.0, 12.0])
    return replace(Roads.of(Network.of(problem)), toll=toll)


def all_routes(roads: Roads) -> list[tuple[int, ...]]:
    routes = [r for count in range(6) for r in permutations(range(1, 6), count)]
    return [r for r in routes if roads.class_of(roads.duration(r)) < len(roads.limits)]


def multipliers(seed: int) -> Duals:
    rng = np.random.default_rng(seed + 100)
    cuts = tuple(Cut(nodes, EVERY) for nodes in ((1, 2, 3), (2, 4, 5), (1, 3, 5)))
    prices = np.array([0.3, 0.0, 0.2])
    return Duals(np.pad(rng.uniform(-0.2, 0.6, 5), 1), np.array([0.1, 0.2]), cuts, prices)


def worth(roads: Roads, duals: Duals, route: tuple[int, ...]) -> float:
    paid = sum(p * coefficient(route, cut) for cut, p in zip(duals.cuts, duals.price, strict=True))
    return float(roads.worth(route) - duals.node[list(route)].sum() - paid)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("toll", [0.0, 0.05])
def test_finds_the_best_routes_of_every_class(seed: int, toll: float) -> None:
    ways, duals = roads(seed, toll), multipliers(seed)
    routes = all_routes(ways)
    values = np.array([worth(ways, duals, route) for route in routes])
    classes = np.array([ways.class_of(ways.duration(route)) for route in routes])
    priced = Inspector(ways, Pool.of(ways, routes)).price(duals, Limits().start())
    assert priced.is_exact
    best = [values[classes == 0].max(), values.max()]
    np.testing.assert_allclose(priced.best, best, atol=1e-12)
    missing = {r for r, v, c in zip(routes, values, classes, strict=True) if v > duals.floor[c]}
    assert set(priced.routes) <= missing
    assert bool(priced.routes) == bool(missing)


@pytest.mark.parametrize("seed", range(4))
def test_strikes_off_what_is_worth_too_little(seed: int) -> None:
    ways, duals = roads(seed, 0.0), multipliers(seed)
    routes = all_routes(ways)
    inspector = Inspector(ways, Pool.of(ways, routes))
    inspector.strike_off(duals, np.array([0.0, 0.1]))
    kept = {inspector.pool.route(k) for k in range(len(inspector.pool))}
    floors = [0.0, 0.1]
    assert kept == {
        r for r in routes if worth(ways, duals, r) > floors[ways.class_of(ways.duration(r))]
    }
    assert 0 < len(kept) < len(routes)


def test_without_routes_nothing_is_worth_anything() -> None:
    ways, duals = roads(0, 0.0), multipliers(0)
    priced = Inspector(ways, Pool.of(ways, [])).price(duals, Limits().start())
    assert priced.routes == []
    assert (priced.best == -np.inf).all()
