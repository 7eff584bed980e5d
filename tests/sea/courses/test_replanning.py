"""Replanning on board: never worse than discarding, and near the optimum on small cases."""

from itertools import permutations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.generate import generate
from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.replanning import replan
from fiveroute.sea.world import World


def view_of(nodes: int, seed: int, reserve: float) -> Outlook:
    world = World.of(generate(nodes=nodes, seed=seed, fleet_size=1))
    return Outlook.of(world.problem, world.law, reserve)


def data(view: Outlook, course: Course) -> float:
    return float(view.profit[list(course.route)].sum())


def best_by_enumeration(view: Outlook, course: Course, nodes: int) -> float:
    routes = (r for k in range(nodes + 1) for r in permutations(range(1, nodes + 1), k))
    courses = (Course(0, course.time, 0.0, course.budget, route) for route in routes)
    return max(data(view, c) for c in courses if in_hand(view, c) >= 0.0)


@settings(deadline=None, max_examples=60)
@given(
    nodes=st.integers(0, 20),
    seed=st.integers(0, 10_000),
    budget=st.floats(0.0, 30_000.0),
    reserve=st.sampled_from([0.0, 1.645]),
)
def test_what_comes_out_is_a_course_that_fits(
    nodes: int, seed: int, budget: float, reserve: float
) -> None:
    view = view_of(nodes, seed, reserve)
    order = (np.random.default_rng(seed).permutation(nodes) + 1).tolist()
    before = Course(0, 0.0, 0.0, budget, tuple(order[: nodes // 2]))
    after, left_over = replan(view, before, order[nodes // 2 :], 30, seed)
    assert sorted((*after.route, *left_over)) == list(range(1, nodes + 1))
    trimmed, _ = discard(view, before)
    assert in_hand(view, after) >= min(0.0, in_hand(view, trimmed))
    assert data(view, after) >= data(view, trimmed) - 1e-9
    assert (after, left_over) == replan(view, before, order[nodes // 2 :], 30, seed)


def test_small_courses_are_optimal_nearly_always() -> None:
    shares = []
    for seed in range(60):
        view = view_of(6, seed, 1.645)
        here = Course(0, 0.0, 0.0, 14_000.0, ())
        after, _ = replan(view, here, range(1, 7), 100, seed)
        shares.append(data(view, after) / best_by_enumeration(view, here, 6))
    assert sum(share > 1.0 - 1e-9 for share in shares) >= 48
    assert np.mean(shares) > 0.98


def test_an_overdue_course_keeps_what_costs_nothing() -> None:
    view = view_of(5, 1, 1.645)
    after, left_over = replan(view, Course(0, 0.0, 0.0, 1.0, ()), range(1, 6), 20, 1)
    assert after.route == ()
    assert left_over == (1, 2, 3, 4, 5)
