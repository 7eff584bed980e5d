"""Tier 5 by hand: (24) to (27), and Algorithm 2 in rounds."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.instance import Uncertainty
from fiveroute.problem import TeamOrienteering
from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import LONGEST_LEG, Outlook
from fiveroute.sea.courses.picking import offers
from fiveroute.tiers.actuation import leg_law
from fiveroute.tiers.coordination import Award, assign_idle_nodes, coordinate

CALM = Uncertainty(floor=1.0)
ROUGH = Uncertainty(0.2, 0.5, 120.0, 0.2)


def line(
    places: list[float], data: list[float], uncertainty: Uncertainty = CALM, reserve: float = 0.0
) -> Outlook:
    """Nodes on a line, start and destination both at 0, no service, 1 m/s."""
    at = np.array([0.0, *places, 0.0])
    travel = np.abs(at[:, None] - at)
    problem = TeamOrienteering(travel, np.zeros_like(at), [0.0, *data, 0.0], [1.0])
    return Outlook.of(problem, leg_law(travel, travel / 1000.0, uncertainty), reserve)


def course(budget: float, *route: int, anchor: int = 0, time: float = 0.0) -> Course:
    return Course(anchor, time, 0.0, budget, route)


def test_the_trigger_is_24() -> None:
    view = line([100.0, 300.0], [1.0, 1.0])
    assert in_hand(view, course(600.0, 1, 2)) == pytest.approx(0.0, abs=1e-6)
    assert in_hand(view, course(600.0, 1, 2, time=1.0)) == pytest.approx(-1.0)
    assert in_hand(view, course(650.0, 1, 2)) == pytest.approx(50.0)


def test_the_reserve_counts_every_leg_that_remains_and_the_longest_more() -> None:
    view = line([1000.0, 1000.0], [1.0, 1.0], ROUGH, 1.5)
    one = 200.0**2 + 0.5 * 120.0**2
    there_and_back = 9000.0 - 2120.0 - 1.5 * ((2.0 + LONGEST_LEG) * one) ** 0.5
    assert in_hand(view, course(9000.0, 1)) == pytest.approx(there_and_back)
    assert in_hand(view, course(9000.0, 1, 2)) == pytest.approx(there_and_back)
    under_way = Course(1, 0.0, one, 9000.0, ())
    assert in_hand(view, under_way) == pytest.approx(there_and_back + 1060.0)


def test_a_node_on_the_way_home_may_be_worth_more_than_it_costs() -> None:
    """Half-way home the luck of two legs evens out: to leave the node out gains no time."""
    view = line([4000.0, 2000.0], [1.0, 0.01], ROUGH, 2.0)
    assert discard(view, course(7500.0, 1, 2))[1] == (1,)
    assert discard(view, course(1.0, 2, anchor=1))[1] == ()
    psi, _ = offers(view, course(9000.0, anchor=1), np.array([2]))
    assert psi.tolist() == [0.01]


def test_the_node_of_least_ratio_is_discarded_first() -> None:
    """3 saves 200 for 5, the others save nothing while it is there."""
    view = line([100.0, 200.0, 300.0], [1.0, 1.0, 5.0])
    assert discard(view, course(500.0, 1, 2, 3)) == (course(500.0, 1, 2), (3,))
    assert discard(view, course(250.0, 1, 2, 3)) == (course(250.0, 1), (2, 3))
    assert discard(view, course(600.0, 1, 2, 3)) == (course(600.0, 1, 2, 3), ())
    assert discard(view, course(-1.0, 1, 2, 3))[1] == (1, 2, 3)


def test_psi_is_data_per_added_second_at_the_best_place() -> None:
    view = line([100.0, 200.0, 150.0], [1.0, 1.0, 3.0])
    psi, place = offers(view, course(1000.0, 1), np.array([2, 3]))
    assert psi.tolist() == pytest.approx([1.0 / 200.0, 3.0 / 100.0])
    assert set(place.tolist()) <= {0, 1}
    assert offers(view, course(299.0, 1), np.array([2]))[0].tolist() == [0.0]
    assert offers(view, course(400.0, 1), np.array([2]))[0].tolist() == pytest.approx([1 / 200.0])


def test_a_free_insertion_counts_as_a_second() -> None:
    view = line([100.0, 200.0], [2.0, 1.0])
    assert offers(view, course(400.0, 2), np.array([1]))[0].tolist() == [2.0]


def test_several_nodes_go_in_one_round_and_some_stay_idle() -> None:
    """Two AUVs at either end of a line, a node near each of them, and one out of reach."""
    view = line([0.0, 1000.0, 10.0, 990.0, 5000.0], [1.0, 1.0, 1.0, 1.0, 1.0])
    fleet = [course(100.0, anchor=1), course(1200.0, anchor=2)]
    after, awards = assign_idle_nodes(view, fleet, {3, 4, 5})
    assert awards == (Award(0, 3), Award(1, 4))
    assert [c.route for c in after] == [(3,), (4,)]


def test_who_discards_may_bid() -> None:
    view = line([100.0, 300.0], [1.0, 1.0])
    courses, discarded, awards = coordinate(view, [course(200.0, 2), course(700.0)], 0, {1})
    assert discarded == (2,)
    assert {(a.auv, a.node) for a in awards} == {(0, 1), (1, 2)}
    assert [c.route for c in courses] == [(1,), (2,)]


@settings(deadline=None, max_examples=60)
@given(seed=st.integers(0, 2**32 - 1), reserve=st.sampled_from([0.0, 1.645]))
def test_whatever_happens_there_is_time(seed: int, reserve: float) -> None:
    """Discarding makes a course fit if the way home does; no pick-up ever makes it unfit."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 12))
    travel = rng.random((n + 2, n + 2)) * 3000.0
    data = np.array([0.0, *rng.random(n), 0.0])
    service = np.array([0.0, *rng.random(n) * 30.0, 0.0])
    problem = TeamOrienteering(travel, service, data, [1.0])
    view = Outlook.of(problem, leg_law(problem.travel, problem.travel / 1000.0, ROUGH), reserve)
    order = (rng.permutation(n) + 1).tolist()
    cut = int(rng.integers(0, n + 1))
    shares: tuple[tuple[int, ...], ...] = (tuple(order[:cut]), ())
    fleet = [
        Course(0, float(rng.random() * 5000.0), float(rng.random() * 1e4), 20_000.0, share)
        for share in shares
    ]
    after, discarded, awards = coordinate(view, fleet, 0, set(order[cut:]))
    routes = [node for c in after for node in c.route]
    assert len(routes) == len(set(routes))
    assert set(order[:cut]) <= set(routes) | set(discarded)
    for m, c in enumerate(after):
        if any(a.auv == m for a in awards):
            assert in_hand(view, c) >= 0.0
