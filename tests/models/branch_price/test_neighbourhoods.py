"""Neighbourhoods: what they forbid, and how they grow."""

import numpy as np

from fiveroute.models.branch_price.neighbourhoods import grow, is_forgetful, nearest
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering


def line(spacing: float, n: int = 6) -> Roads:
    x = np.arange(n + 2) * spacing
    profit = np.pad(np.ones(n), 1)
    return Roads.of(
        Network.of(TeamOrienteering(abs(x[:, None] - x), 0.0 * profit, profit, [100.0]))
    )


def test_the_nearest_nodes_are_neighbours() -> None:
    near = nearest(line(1.0), 3)
    assert set(np.flatnonzero(near[3])) == {2, 3, 4}
    assert near.diagonal().all()


def test_nodes_in_one_place_all_remember_each_other() -> None:
    near = nearest(line(0.0), 2)
    assert near[1:-1, 1:-1].all()


def test_a_route_may_come_back_to_what_it_forgot() -> None:
    near = nearest(line(1.0), 3)
    assert not is_forgetful(near, (1, 2, 1))
    assert is_forgetful(near, (1, 4, 1))
    assert is_forgetful(near, (1, 2, 3, 4))


def test_growing_forbids_a_cycle_for_ever() -> None:
    near = nearest(line(1.0), 3)
    route = (1, 4, 1, 5)
    assert grow(near, [route])
    assert not is_forgetful(near, route)
    assert not grow(near, [(1, 2, 3)])


def test_a_full_neighbourhood_does_not_grow() -> None:
    near = nearest(line(1.0), 3)
    before = near.copy()
    assert not grow(near, [(1, 4, 1)], most=3)
    np.testing.assert_array_equal(near, before)
