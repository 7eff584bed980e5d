"""Replanning for the whole fleet: legal, never worse, and as good as the exact answer."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fiveroute.routes import Plan, Route
from fiveroute.sea.courses import fleet_replanning
from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.exact_replanning import best_courses
from fiveroute.sea.courses.fleet_replanning import replan_fleet
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.world import World


@pytest.fixture
def view(world: World) -> Outlook:
    return Outlook.of(world.problem, world.law, 1.645)


def data(view: Outlook, routes: tuple[Route, ...]) -> float:
    return sum(float(view.profit[list(route)].sum()) for route in routes)


def test_the_search_agrees_with_the_exact_answer(
    view: Outlook, monkeypatch: pytest.MonkeyPatch
) -> None:
    rng, gaps = np.random.default_rng(0), []
    for seed in range(30):
        nodes = np.sort(rng.choice(np.arange(1, 25), 6, replace=False))
        anchors, budgets = rng.integers(0, 25, size=3), rng.uniform(2000.0, 9000.0, size=3)
        courses = [
            Course(int(anchor), 0.0, 0.0, float(budget), ())
            for anchor, budget in zip(anchors, budgets, strict=True)
        ]
        exact = data(view, best_courses(view, courses, nodes))
        with monkeypatch.context() as patch:
            patch.setattr(fleet_replanning, "EXACT", 0)
            gaps.append(exact - data(view, replan_fleet(view, courses, nodes.tolist(), seed)))
    assert min(gaps) > -1e-9
    assert sum(gap < 1e-9 for gap in gaps) >= 29


def test_a_fleet_is_never_made_worse(world: World, view: Outlook, plan: Plan) -> None:
    budgets = (world.problem.budgets * 1.2).tolist()
    courses = [
        Course(0, 0.0, 0.0, budget, route)
        for budget, route in zip(budgets, plan.routes, strict=True)
    ]
    before = [route for c, route in zip(courses, plan.routes, strict=True) if in_hand(view, c) >= 0]
    routes = replan_fleet(view, courses, plan.idle(world.problem), 1)
    assert data(view, routes) >= data(view, tuple(before))
    visited = [node for route in routes for node in route]
    assert len(visited) == len(set(visited))
    for course, route in zip(courses, routes, strict=True):
        assert in_hand(view, replace(course, route=route)) >= 0.0
    assert routes == replan_fleet(view, courses, plan.idle(world.problem), 1)


def test_with_endless_time_everything_is_visited_in_the_shortest_time(view: Outlook) -> None:
    courses = [Course(0, 0.0, 0.0, 1e6, (1, 2)), Course(9, 0.0, 0.0, 1e6, ())]
    nodes = [node for node in range(3, 25) if node != 9]
    routes = replan_fleet(view, courses, nodes, 1)
    assert sorted(node for route in routes for node in route) == sorted([1, 2, *nodes])
    hand = sum(
        in_hand(view, replace(c, route=route)) for c, route in zip(courses, routes, strict=True)
    )
    one_by_one = (in_hand(view, replace(courses[0], route=(1, 2, *nodes))), 1e6)
    assert hand > sum(one_by_one) - 1e6 + in_hand(view, courses[1])


@pytest.mark.parametrize("courses", [[], [Course(1, 9e3, 0.0, 9e3, ())]])
def test_nothing_to_plan(view: Outlook, courses: list[Course]) -> None:
    assert replan_fleet(view, courses, (), 1) == ((),) * len(courses)
    assert math.isfinite(sum(map(len, replan_fleet(view, courses, range(2, 20), 1))))
