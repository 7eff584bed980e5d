"""The fastest ways through the nodes against enumeration, and what they prove."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.check import check
from fiveroute.heuristics.shortest_routes import (
    is_proved_infeasible,
    shortest_route,
    shortest_routes,
)
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


@st.composite
def problems(draw: st.DrawFn) -> TeamOrienteering:
    """A direct leg that is often slower than a detour over nodes."""
    n = draw(st.integers(0, 5))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    travel = rng.random((n + 2, n + 2)) * 100.0
    travel[0, -1] *= draw(st.sampled_from([1.0, 3.0]))
    service = np.array([0.0, *rng.random(n) * draw(st.sampled_from([0.0, 20.0])), 0.0])
    fleet_size = draw(st.integers(1, 3))
    return TeamOrienteering(travel, service, np.zeros(n + 2), rng.random(fleet_size) * 150.0)


def least_duration(problem: TeamOrienteering, nodes: list[int]) -> float:
    return min(
        problem.duration(route)
        for size in range(len(nodes) + 1)
        for route in itertools.permutations(nodes, size)
    )


@settings(deadline=None, max_examples=60)
@given(problems(), st.integers(0, 2**32 - 1))
def test_no_route_is_faster(problem: TeamOrienteering, seed: int) -> None:
    rng = np.random.default_rng(seed)
    barred = [node for node in range(1, problem.n + 1) if rng.random() < 0.3]
    free = [node for node in range(1, problem.n + 1) if node not in barred]
    route = shortest_route(problem, barred)
    assert not set(route) & set(barred)
    assert problem.duration(route) == pytest.approx(least_duration(problem, free))


@settings(deadline=None, max_examples=60)
@given(problems())
def test_only_what_cannot_be_done_is_called_infeasible(problem: TeamOrienteering) -> None:
    fastest = least_duration(problem, list(range(1, problem.n + 1)))
    assert is_proved_infeasible(problem) == bool((fastest > problem.allowed).any())
    routes = shortest_routes(problem)
    if routes is not None:
        assert check(problem, Plan(routes)) == []
    elif problem.fleet_size == 1:
        assert is_proved_infeasible(problem)


def test_a_detour_saves_the_fleet() -> None:
    """The direct leg takes 9 s, the way over either node 2 s; there is time for 5."""
    travel = np.full((4, 4), 1.0)
    travel[0, 3] = 9.0
    problem = TeamOrienteering(travel, np.zeros(4), np.zeros(4), [5.0, 5.0])
    assert not is_proved_infeasible(problem)
    routes = shortest_routes(problem)
    assert routes is not None
    assert sorted(routes) == [(1,), (2,)]
    assert shortest_routes(problem.with_budgets([5.0] * 3)) is None


def test_a_budget_that_the_direct_leg_just_uses_up_is_enough() -> None:
    problem = TeamOrienteering(np.full((2, 2), 0.1 + 0.2), [0, 0], [0, 0], [0.3])
    assert not is_proved_infeasible(problem)
    assert shortest_routes(problem) == ((),)
