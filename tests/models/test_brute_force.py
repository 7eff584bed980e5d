"""Brute force against an even simpler search, and on problems solved by hand."""

from itertools import permutations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.limits import Limits
from fiveroute.models.brute_force import MOST_NODES, quickest_routes, solve, supports
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Plan


def every_plan_tried(problem: TeamOrienteering) -> float | None:
    """Every assignment of nodes to AUVs or to nobody, in every order, past the judge."""
    fleet, nodes, best = range(problem.fleet_size), range(1, problem.n + 1), None
    for owners in product([None, *fleet], repeat=problem.n):
        loads = [[k for k, owner in zip(nodes, owners, strict=True) if owner == m] for m in fleet]
        for routes in product(*(permutations(load) for load in loads)):
            plan = Plan(routes)
            if not check(problem, plan):
                best = max(plan.objective(problem), -1.0 if best is None else best)
    return best


@st.composite
def problems(draw: st.DrawFn) -> TeamOrienteering:
    n = draw(st.integers(0, 4))
    times = st.integers(0, 9).map(float)
    travel = draw(arrays(np.float64, (n + 2, n + 2), elements=times))
    service, profit = (draw(arrays(np.float64, n, elements=times)) for _ in range(2))
    budgets = draw(st.lists(st.integers(0, 25).map(float), min_size=1, max_size=2))
    return TeamOrienteering(travel, np.pad(service, 1), np.pad(profit, 1), budgets)


@settings(max_examples=30, deadline=None)
@given(problem=problems())
def test_agrees_with_trying_every_plan(problem: TeamOrienteering) -> None:
    result, best = solve(problem), every_plan_tried(problem)
    assert (result.status is Status.INFEASIBLE) == (best is None)
    assert result.objective == pytest.approx(best or 0.0)


def test_the_quickest_route_of_every_set() -> None:
    line = np.abs(np.subtract.outer([0.0, 3.0, 1.0, 2.0, 4.0], [0.0, 3.0, 1.0, 2.0, 4.0]))
    problem = TeamOrienteering(line, [0] * 5, [0] * 5, [9.0])
    # By bit mask: none, {1}, {2}, {1, 2}, {3}, {1, 3}, {2, 3}, all.
    expected = [(), (1,), (2,), (2, 1), (3,), (3, 1), (2, 3), (2, 3, 1)]
    assert quickest_routes(problem) == expected


def test_a_larger_set_may_fit_where_a_smaller_does_not() -> None:
    """Node 2 is far from everything but node 1, which lies on the way."""
    travel = [[0, 1, 9, 1], [9, 0, 1, 1], [9, 9, 0, 1], [9, 9, 9, 0]]
    result = solve(TeamOrienteering(travel, [0] * 4, [0, 0, 5, 0], [3.0]))
    assert result.plan == Plan(((1, 2),))
    assert result.objective == 5.0


def test_too_many_nodes_are_refused() -> None:
    size = MOST_NODES + 3
    problem = TeamOrienteering(np.zeros((size, size)), [0] * size, [0] * size, [1.0])
    assert not supports(problem)
    with pytest.raises(InputError, match="at most 9 nodes"):
        solve(problem)


def test_the_warm_start_is_the_answer_when_stopped() -> None:
    problem = TeamOrienteering(np.zeros((3, 3)), [0] * 3, [0, 1, 0], [1.0])
    result = solve(problem, Limits(time=0.0), warm_start=Plan(((1,),)))
    assert result.plan == Plan(((1,),))
    assert result.bound == 1.0
