"""The best courses for few nodes, against all ways to share them out in all orders."""

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from fiveroute.routes import Route
from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.exact_replanning import best_courses
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.world import World


def best_of_all(view: Outlook, courses: Sequence[Course], nodes: list[int]) -> tuple[float, float]:
    """Greatest data, and the most time in hand with it, over everything that can be done."""
    best = (-1.0, 0.0)
    for order in itertools.permutations([*nodes, *[0] * (len(courses) - 1)]):
        text = ",".join("|" if node == 0 else str(node) for node in order)
        routes = [tuple(int(n) for n in part.split(",") if n) for part in text.split("|")]
        for kept in itertools.product((False, True), repeat=len(nodes)):
            left_out = {node for node, keep in zip(nodes, kept, strict=True) if not keep}
            tried = [tuple(n for n in route if n not in left_out) for route in routes]
            best = max(best, judged(view, courses, tried))
    return best


def judged(
    view: Outlook, courses: Sequence[Course], routes: Sequence[Route]
) -> tuple[float, float]:
    """Data and time in hand; nothing where an AUV has not the time for what it is to do."""
    hands = [in_hand(view, replace(c, route=r)) for c, r in zip(courses, routes, strict=True)]
    if any(hand < 0.0 and route for hand, route in zip(hands, routes, strict=True)):
        return -1.0, 0.0
    data = sum(float(view.profit[list(route)].sum()) for route in routes)
    return round(data, 9), round(sum(hands), 6)


@pytest.mark.parametrize("seed", range(8))
def test_it_finds_what_trying_all_finds(seed: int, world: World) -> None:
    rng = np.random.default_rng(seed)
    view = Outlook.of(world.problem, world.law, float(rng.choice([0.0, 1.645])))
    nodes = np.sort(rng.choice(np.arange(1, 25), 4, replace=False))
    courses = [
        Course(int(anchor), 100.0, float(rng.uniform(0.0, 1e4)), float(rng.uniform(1e3, 9e3)), ())
        for anchor in rng.choice(np.setdiff1d(np.arange(25), nodes), 2, replace=False)
    ]
    routes = best_courses(view, courses, nodes)
    assert judged(view, courses, routes) == best_of_all(view, courses, nodes.tolist())


def test_who_is_late_sails_home(world: World) -> None:
    view = Outlook.of(world.problem, world.law, 1.645)
    late, early = Course(3, 9000.0, 0.0, 9000.0, ()), Course(4, 0.0, 0.0, 1e6, ())
    routes = best_courses(view, [late, early], np.array([1, 2]))
    assert routes[0] == ()
    assert sorted(routes[1]) == [1, 2]
