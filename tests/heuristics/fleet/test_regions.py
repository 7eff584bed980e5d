import numpy as np
import pytest

from fiveroute.check import check
from fiveroute.heuristics.fleet.crew import crew
from fiveroute.heuristics.fleet.network import Network, build_network, trails_in
from fiveroute.heuristics.fleet.regions import REGIONS, Regions, divide
from fiveroute.heuristics.fleet_search import MANY_AUVS, MANY_NODES, fleet_search
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def field(n: int, fleet_size: int) -> TeamOrienteering:
    """Asymmetric, with service times and budgets that differ."""
    rng = np.random.default_rng(5)
    points = rng.uniform(0.0, 100.0, (n + 2, 2))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    travel *= rng.uniform(1.0, 1.2, travel.shape)
    service, profit = np.pad(rng.random((2, n)), ((0, 0), (1, 1)))
    return TeamOrienteering(travel, service, profit, rng.uniform(150.0, 250.0, fleet_size))


def in_a_row(network: Network) -> Plan:
    """Node after node to AUV after AUV, two to each."""
    count = len(network.limit)
    return Plan.of(network.nodes[2 * auv : 2 * auv + 2] for auv in range(count))


@pytest.mark.parametrize("first", range(5))
def test_regions_share_the_routes_out_evenly_and_keep_them_whole(first: int) -> None:
    network = build_network(field(60, 10), 20)
    trails = trails_in(network, in_a_row(network))
    region, region_of_node = divide(network, trails, first, REGIONS)
    assert sorted(np.bincount(region, minlength=REGIONS).tolist()) == [2, 2, 3, 3]
    assert region[first] == 0
    assert len(region_of_node) == len(network.nodes)
    assert set(region_of_node.tolist()) <= set(range(REGIONS))
    for auv, trail in enumerate(trails):
        assert (region_of_node[list(trail)] == region[auv]).all()


def test_the_parts_add_up_to_a_plan_of_the_whole_and_nothing_is_lost() -> None:
    problem = field(80, 9)
    network = build_network(problem, 20)
    regions = Regions.around(Plan.empty(9), network, 0.01, np.random.default_rng(1))
    collected = 0.0
    with crew(2) as for_each:
        for part in np.linspace(0.0, 1.0, 12):
            regions.run(150, part, for_each)
            assert regions.objective >= collected
            collected = regions.objective
            assert check(problem, regions.plan) == []
            assert regions.plan.objective(problem) == pytest.approx(collected)
    assert collected > 0.5 * problem.total_profit


def test_a_large_search_gives_the_same_plan_with_any_number_of_workers() -> None:
    problem = field(MANY_NODES + 20, MANY_AUVS)
    plans = [
        fleet_search(problem, rng=np.random.default_rng(3), iterations=20_000, workers=number)
        for number in (1, 2, 4)
    ]
    assert check(problem, plans[0]) == []
    assert plans[0].objective(problem) > 0.1 * problem.total_profit
    assert plans[0] == plans[1] == plans[2]
