import numpy as np
import pytest

from fiveroute.heuristics.fleet import archipelago
from fiveroute.heuristics.fleet.archipelago import PAIRS, TOGETHER, Archipelago
from fiveroute.heuristics.fleet.crew import crew
from fiveroute.heuristics.fleet.network import Network, build_network
from fiveroute.heuristics.fleet.schedule import FIRST, ROUNDS
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def random_network(rng: np.random.Generator) -> Network:
    points = rng.uniform(0.0, 100.0, (42, 2))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    profit = np.pad(rng.random(40), 1)
    return build_network(TeamOrienteering(travel, np.zeros(42), profit, [150.0] * 2), 20)


def test_a_new_round_starts_from_combinations_and_loses_nothing() -> None:
    rng = np.random.default_rng(5)
    islands = Archipelago.around(Plan.empty(2), random_network(rng), 0.01, rng)
    with crew(2) as for_each:
        for part in np.linspace(0.0, FIRST, 30, endpoint=False):
            islands.run(200, part, for_each)
        before = islands.objective
        assert before > 0.0
        assert all(len(pool) > 2 for pool in islands.pools)
        islands.run(200, FIRST, for_each)
    assert islands.round == 1
    assert islands.objective >= before


def test_neighbours_learn_from_each_other_and_later_all_from_all() -> None:
    rng = np.random.default_rng(6)
    islands = Archipelago.around(Plan.empty(2), random_network(rng), 0.01, rng)
    before = FIRST + (TOGETHER - 1.5) * (1.0 - FIRST) / (ROUNDS - 1)
    with crew(1) as for_each:
        islands.run(200, before, for_each)
        assert len(islands.pools) == PAIRS
        apart = [set(pool.trails) for pool in islands.pools]
        islands.run(200, 1.0, for_each)
    assert len(islands.pools) == 1
    assert {frozenset(t) for t in set.union(*apart)} <= set(map(frozenset, islands.pools[0].trails))


def test_the_best_routes_stay_known_when_pools_are_full(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(archipelago, "CAPACITY", 1)
    rng = np.random.default_rng(8)
    islands = Archipelago.around(Plan.empty(2), random_network(rng), 0.01, rng)
    with crew(1) as for_each:
        islands.run(50, 0.0, for_each)
        for pool in islands.pools:
            pool.add((i, j) for i in range(10) for j in range(i))
        islands.run(50, 1.0, for_each)
    assert len(islands.pools) == 1
    assert islands.objective > 0.0


def test_one_island_starts_from_the_plan_and_the_others_from_nothing() -> None:
    rng = np.random.default_rng(7)
    network = random_network(rng)
    plan = Plan(((1, 2), (3,)))
    first, *others = Archipelago.around(plan, network, 0.01, rng).islands
    assert first.objective == network.profit[np.isin(network.nodes, (1, 2, 3))].sum()
    assert all(island.objective == 0.0 for island in others)
