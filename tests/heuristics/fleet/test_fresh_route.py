import numpy as np
import pytest

from fiveroute.heuristics.fleet.chains import duration
from fiveroute.heuristics.fleet.fresh_route import fill_empty_routes, fresh_route
from fiveroute.heuristics.fleet.network import build_network
from fiveroute.problem import TeamOrienteering
from fiveroute.randomness import random_state


@pytest.mark.parametrize("seed", range(10))
def test_the_route_keeps_its_limit_and_has_room_for_no_other_node(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(0.0, 100.0, (32, 2))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    travel *= rng.uniform(1.0, 1.3, travel.shape)
    problem = TeamOrienteering(travel, np.zeros(32), np.pad(rng.random(30), 1), [250.0])
    network = build_network(problem, 10)
    leg, size = network.leg, len(network.nodes)
    idle = np.arange(0, size, 2)
    route = fresh_route(leg, network.profit, size, size + 1, 250.0, idle, random_state(rng))
    assert len(route) > 2
    assert len(set(route.tolist())) == len(route)
    assert set(route.tolist()) <= set(idle.tolist())
    assert duration(leg, size, size + 1, route) <= 250.0
    for node in set(idle.tolist()) - set(route.tolist()):
        for spot in range(len(route) + 1):
            assert duration(leg, size, size + 1, np.insert(route, spot, node)) > 250.0


def test_no_node_in_time_gives_an_empty_route() -> None:
    leg = np.array([[-np.inf, 9.0, 9.0], [9.0, -np.inf, 1.0], [9.0, 1.0, -np.inf]])
    state = random_state(np.random.default_rng(1))
    assert len(fresh_route(leg, np.ones(1), 1, 2, 5.0, np.arange(1), state)) == 0


def test_empty_routes_are_filled_and_the_others_left_alone() -> None:
    place = np.array([*range(9), 0.0])
    travel = abs(place[:, None] - place[None, :])
    network = build_network(TeamOrienteering(travel, 0 * place, np.sign(place), [8.0] * 3), 5)
    mine = (0, 1)
    filled = fill_empty_routes(network, [(), mine, ()], random_state(np.random.default_rng(1)))
    assert filled[1] == mine
    visited = [node for trail in filled for node in trail]
    assert len(visited) == len(set(visited)) > 2
