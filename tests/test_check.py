from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.check import Violation, check, check_claims
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

LINE = TeamOrienteering(
    travel=[[abs(i - j) for j in range(5)] for i in range(5)],
    service=[0, 1, 1, 1, 0],
    profit=[0, 2, 3, 5, 0],
    budgets=[6, 4],
)


def judge(*routes: Sequence[int]) -> list[Violation]:
    return check(LINE, Plan.of(routes))


def test_a_feasible_plan_has_no_violation() -> None:
    assert judge([1, 3], []) == []


def test_a_route_may_use_its_budget_to_the_last_second() -> None:
    assert LINE.duration([1, 3]) == LINE.budgets[0]
    assert judge([1, 3], []) == []


def test_rounding_is_forgiven_but_no_more() -> None:
    tight = LINE.with_budgets([6 * (1 - 0.9e-9), 4])
    late = LINE.with_budgets([6 * (1 - 2e-9), 4])
    assert check(tight, Plan.of([[1, 3], []])) == []
    assert [v.kind for v in check(late, Plan.of([[1, 3], []]))] == ["over_budget"]


def test_over_budget_names_the_auv_and_the_seconds() -> None:
    assert judge([], [1, 3]) == [Violation("over_budget", 1, None, 2.0)]


def test_an_empty_route_must_fit_too() -> None:
    assert check(LINE.with_budgets([3.0]), Plan.empty(1)) == [
        Violation("over_budget", 0, None, 1.0)
    ]


@pytest.mark.parametrize("route", [[1, 1], [2, 1, 2]])
def test_twice_on_one_route(route: list[int]) -> None:
    kinds = [v.kind for v in judge(route, [])]
    assert kinds.count("visited_twice") == 1


def test_twice_over_the_fleet() -> None:
    assert judge([1], [1])[0] == Violation("visited_twice", 1, 1, 1.0)


@pytest.mark.parametrize("node", [0, 4, -1, 99])
def test_ends_and_strangers_are_no_sensor_nodes(node: int) -> None:
    assert judge([node], []) == [Violation("unknown_node", 0, node, 1.0)]


@pytest.mark.parametrize(("routes", "amount"), [([[]], -1.0), ([[], [], []], 1.0)])
def test_one_route_per_auv(routes: list[list[int]], amount: float) -> None:
    assert judge(*routes) == [Violation("fleet_size", None, None, amount)]


@given(st.lists(st.lists(st.integers(-1, 5), max_size=5), max_size=4))
def test_feasible_exactly_when_every_rule_holds(routes: list[list[int]]) -> None:
    nodes = [node for route in routes for node in route]
    rules = (
        len(routes) == 2
        and len(set(nodes)) == len(nodes)
        and all(1 <= node <= 3 for node in nodes)
        and all(
            LINE.duration(route) <= budget
            for route, budget in zip(routes, LINE.budgets, strict=False)
        )
    )
    assert (not check(LINE, Plan.of(routes))) == rules


def test_true_claims_stand_and_false_ones_fall() -> None:
    plan = Plan.of([[1, 3], []])
    assert check_claims(LINE, plan, 7.0, [6.0, 4.0]) == []
    assert check_claims(LINE, plan, 9.0, [6.0, 4.0]) == [Violation("objective", None, None, 2.0)]
    assert check_claims(LINE, plan, 7.0, [6.0, 4.0 + 3e-6]) == []
    traces = replace(LINE, profit=LINE.profit * 1e-8)
    assert [fault.kind for fault in check_claims(traces, plan, 9e-8, [6.0, 4.0])] == ["objective"]
    assert check_claims(LINE, plan, 7.0, [6.0, 3.5]) == [Violation("duration", 1, None, -0.5)]
