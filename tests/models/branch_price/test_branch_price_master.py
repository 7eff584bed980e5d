"""The master problem on cases with a closed form."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.branch_price.duals import Cut, Duals
from fiveroute.models.branch_price.master import Master, coefficient
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering


def roads(budgets: list[float]) -> Roads:
    """Four nodes worth 1 each, everything one second apart."""
    profit = np.pad(np.ones(4), 1)
    travel = np.ones((6, 6)) - np.eye(6)
    return Roads.of(Network.of(TeamOrienteering(travel, 0.0 * profit, profit, budgets)))


def solved(master: Master) -> Duals:
    duals = master.solve()
    assert duals is not None
    return duals


def test_three_pairs_of_three_nodes_share_them_in_halves() -> None:
    """Each of the pairs at one half: 3 data; two AUVs with whole routes collect 2 of them."""
    master = Master(roads([3.0, 3.0]), Limits().start())
    assert master.add([(1, 2), (2, 3), (1, 3)]) == 3
    duals = solved(master)
    assert master.objective == pytest.approx(3.0)
    assert duals.bound(master.roads.routes, duals.floor) == pytest.approx(3.0)
    master.add_cuts([Cut((1, 2, 3), frozenset({1, 2, 3}))])
    duals = solved(master)
    assert master.objective == pytest.approx(2.0)
    assert duals.price.sum() + duals.node.sum() + 2.0 * duals.floor[0] == pytest.approx(2.0)
    master.remove_cuts([0])
    solved(master)
    assert master.objective == pytest.approx(3.0)


def test_a_longer_route_needs_a_larger_budget() -> None:
    master = Master(roads([2.0, 4.0]), Limits().start())
    master.add([(1, 2, 3), (2, 3, 4), (4,), (1,)])
    duals = solved(master)
    assert master.classes == [1, 1, 0, 0]
    assert master.objective == pytest.approx(4.0)
    assert (np.diff(duals.floor) >= -1e-12).all()


def test_known_and_late_routes_are_not_added() -> None:
    master = Master(roads([3.0]), Limits().start())
    assert master.add([(1, 2), (2, 1), (1, 2, 3, 4)]) == 1
    solved(master)
    assert master.objective == pytest.approx(2.0)


def test_banned_routes_stay_out() -> None:
    master = Master(roads([3.0]), Limits().start())
    master.add([(1, 2), (3,)])
    master.ban(lambda route: len(route) > 1)
    solved(master)
    assert master.objective == pytest.approx(1.0)
    assert master.add([(2, 1)]) == 1


def test_a_required_node_without_a_route_is_fined() -> None:
    master = Master(roads([3.0]), Limits().start(), frozenset({4}))
    master.add([(1, 2)])
    solved(master)
    assert master.objective < -30.0
    master.add([(4,)])
    solved(master)
    assert master.objective == pytest.approx(1.0)


def test_every_route_is_worth_at_most_its_floor_at_the_optimum() -> None:
    master = Master(roads([3.0, 4.0]), Limits().start())
    master.add([(1, 2), (2, 3), (1, 3, 4), (3, 4), (2,)])
    master.add_cuts([Cut((1, 2, 3), frozenset({1, 2, 3}))])
    duals = solved(master)
    assert all(master.reduced_profit(k, duals) <= 1e-9 for k in range(5))


@pytest.mark.parametrize(
    ("route", "memory", "expected"),
    [
        ((1, 2), {1, 2, 3}, 1),
        ((1, 4, 2), {1, 2, 3}, 0),
        ((1, 4, 2), {1, 2, 3, 4}, 1),
        ((1, 2, 3), {1, 2, 3}, 1),
        ((1, 2, 4, 3, 1), {1, 2, 3}, 2),
        ((4,), {1, 2, 3}, 0),
    ],
)
def test_a_cut_counts_what_it_remembers(
    route: tuple[int, ...], memory: set[int], expected: int
) -> None:
    assert coefficient(route, Cut((1, 2, 3), frozenset(memory))) == expected
    assert coefficient(route[::-1], Cut((1, 2, 3), frozenset(memory))) == expected


def test_with_cuts_another_order_of_the_same_nodes_is_another_route() -> None:
    """A cut that forgets at 4 is paid by 1, 2, 4 and not by 1, 4, 2."""
    master = Master(roads([4.0, 4.0]), Limits().start())
    assert master.add([(1, 2, 4), (3,)]) == 2
    assert master.add([(1, 4, 2)]) == 0
    cut = Cut((1, 2, 3), frozenset({1, 2, 3}))
    master.add_cuts([cut])
    assert master.add([(1, 4, 2)]) == 1
    assert master.add([(1, 2, 4), (4, 2, 1), (2, 4, 1)]) == 0
    assert coefficient((1, 2, 4), cut) == 1
    assert coefficient((1, 4, 2), cut) == 0
    master.remove_cuts([0])
    assert master.add([(4, 2, 1)]) == 0
    assert master.ban(lambda route: 4 in route) == [0, 2]
    assert master.add([(4, 2, 1)]) == 1
