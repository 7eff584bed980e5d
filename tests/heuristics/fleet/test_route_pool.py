import numpy as np

from fiveroute.heuristics.fleet.network import Network, build_network
from fiveroute.heuristics.fleet.route_pool import Pool
from fiveroute.problem import TeamOrienteering


def network(n: int = 4) -> Network:
    """Nodes at 1, 2, ... n on a line from a start at 0 to a destination at 0."""
    place = np.array([*range(n + 1), 0.0])
    travel = abs(place[:, None] - place[None, :])
    return build_network(TeamOrienteering(travel, 0 * place, np.sign(place), [100.0]), 3)


def test_of_two_orders_the_faster_one_is_kept() -> None:
    pool = Pool(network(), 10)
    for trail in ((0, 2, 1, 3), (0, 1, 2, 3), (3, 1, 2, 0)):
        pool.add([trail])
    routes = pool.routes()
    assert len(pool) == 1
    assert routes.trail(0) == (0, 1, 2, 3)
    assert routes.time.tolist() == [8.0]


def test_routes_lie_side_by_side_where_places_says() -> None:
    pool = Pool(network(), 10)
    pool.add([(0,), (), (1, 2)])
    routes = pool.routes()
    assert routes.first.tolist() == [0, 1, 1, 3]
    assert [routes.trail(route) for route in pool.places([(2, 1), (), (0,)])] == [(1, 2), (), (0,)]


def test_the_oldest_leave_a_full_pool() -> None:
    pool = Pool(network(9), 30)
    pairs = [(i, j) for i in range(9) for j in range(i)]
    pool.add(pairs[:30])
    pool.add([pairs[0]])
    pool.add(pairs[30:31])
    routes = pool.routes()
    assert len(pool) == 30
    assert routes.trail(0) == pairs[2]
    assert routes.trail(28) == pairs[0]
