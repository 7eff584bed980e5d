"""Trimming and pick-up: small cases by hand, and what must hold for any problem."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.check import check
from fiveroute.heuristics.pick_up import insertions, pick_up, trim
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def line(places: list[float], data: list[float], budgets: list[float]) -> TeamOrienteering:
    """Nodes on a line, start and destination both at 0, no service."""
    at = np.array([0.0, *places, 0.0])
    return TeamOrienteering(np.abs(at[:, None] - at), np.zeros_like(at), [0.0, *data, 0.0], budgets)


@st.composite
def problems(draw: st.DrawFn) -> TeamOrienteering:
    """Asymmetric problems without the triangle inequality; the direct leg takes no time."""
    n = draw(st.integers(0, 9))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    travel = rng.random((n + 2, n + 2)) * 100.0
    if draw(st.booleans()):
        travel = np.floor(travel / 30.0)
    travel[0, -1] = 0.0
    service = np.array([0.0, *rng.random(n) * 5.0, 0.0])
    profit = np.array([0.0, *np.floor(rng.random(n) * 4.0), 0.0])
    fleet_size = draw(st.integers(1, 3))
    return TeamOrienteering(travel, service, profit, rng.random(fleet_size) * 300.0)


def shares(problem: TeamOrienteering, seed: int) -> list[tuple[int, ...]]:
    """All nodes dealt out to the fleet at random."""
    rng = np.random.default_rng(seed)
    owner = rng.integers(problem.fleet_size, size=problem.n)
    order = rng.permutation(problem.n)
    return [
        tuple(int(i) + 1 for i in order if owner[i] == auv) for auv in range(problem.fleet_size)
    ]


def test_the_node_of_least_ratio_goes_first() -> None:
    """30 saves 20 for 5, 10 saves nothing, 20 saves nothing while 30 is there."""
    problem = line([10.0, 20.0, 30.0], [1.0, 1.0, 5.0], [50.0])
    assert trim(problem, 0, (1, 2, 3)) == (1, 2)
    assert trim(problem.with_budgets([25.0]), 0, (1, 2, 3)) == (1,)
    assert trim(problem.with_budgets([0.0]), 0, (1, 2, 3)) == ()


def test_ratios_are_recomputed_after_every_drop() -> None:
    """Either of two twins saves nothing alone; with one gone the other saves all."""
    problem = line([30.0, 30.0, 10.0], [1.0, 1.0, 9.0], [20.0])
    assert trim(problem, 0, (1, 2, 3)) == (1, 2, 3)  # nothing can be dropped with profit
    assert trim(line([31.0, 30.0, 10.0], [1.0, 1.0, 9.0], [20.0]), 0, (1, 2, 3)) == (3,)


def test_the_measure_of_a_route_can_be_replaced() -> None:
    problem = line([10.0, 20.0], [2.0, 1.0], [40.0])
    assert trim(problem, 0, (1, 2)) == (1, 2)
    assert trim(problem, 0, (1, 2), lambda route: 2.0 * problem.duration(route)) == (1,)
    slow = pick_up(problem, ((),), lambda route: 2.0 * problem.duration(route))
    assert slow == ((1,),)


def test_the_best_triple_of_the_whole_fleet_is_taken_first() -> None:
    """Node 3 costs the second AUV nothing, and then 4 costs it less than the first."""
    problem = line([10.0, -20.0, -10.0, -24.0], [1.0, 1.0, 1.0, 1.0], [50.0, 50.0])
    assert pick_up(problem, ((1,), (2,))) == ((1,), (3, 4, 2))


def test_a_node_without_data_is_left_where_it_costs_time() -> None:
    problem = line([10.0, 5.0], [0.0, 0.0], [50.0])
    assert pick_up(problem, ((1,),)) == ((1,),)


def test_a_detour_that_saves_time_is_taken_even_without_data() -> None:
    """The way over node 1 takes 2 s, the direct leg 9 s."""
    travel = [[0.0, 1.0, 9.0], [9.0, 0.0, 1.0], [9.0, 9.0, 0.0]]
    problem = TeamOrienteering(travel, np.zeros(3), np.zeros(3), [10.0])
    assert pick_up(problem, ((),)) == ((1,),)


def test_insertions_by_hand() -> None:
    problem = line([10.0, 20.0, -5.0], [1.0, 3.0, 2.0], [90.0])
    psi, extra, place = insertions(problem, (1,), np.array([2, 3]))
    np.testing.assert_allclose(extra, [20.0, 10.0])
    np.testing.assert_allclose(psi, [0.15, 0.2])
    assert place.tolist() == [0, 0]


@settings(deadline=None, max_examples=60)
@given(problems(), st.integers(0, 2**32 - 1))
def test_trimmed_and_filled_up_routes_are_in_time_and_full(
    problem: TeamOrienteering, seed: int
) -> None:
    routes = [trim(problem, m, route) for m, route in enumerate(shares(problem, seed))]
    late = [problem.duration(r) > problem.allowed[m] for m, r in enumerate(routes)]
    routes = [() if late[m] else route for m, route in enumerate(routes)]
    filled = pick_up(problem, routes)
    assert check(problem, Plan(filled)) == []
    assert Plan(filled).visited >= Plan(tuple(routes)).visited
    assert pick_up(problem, filled) == filled
    for node in Plan(filled).idle(problem):
        for auv, route in enumerate(filled):
            for at in range(len(route) + 1):
                longer = problem.duration((*route[:at], node, *route[at:]))
                worthwhile = problem.profit[node] > 0.0 or longer < problem.duration(route) - 1e-9
                assert longer > problem.allowed[auv] * (1.0 - 1e-9) or not worthwhile


def test_an_expired_clock_stops_the_pick_up() -> None:
    problem = line([10.0, 20.0], [2.0, 1.0], [40.0])
    assert pick_up(problem, ((),), clock=Limits(time=0.0).start()) == ((),)
