"""Looking ahead: what a course is worth is what sailing it by this rule brings on average."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.generate import generate
from fiveroute.instance import Uncertainty
from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import look_ahead, next_stop, reconsider, with_recourse
from fiveroute.sea.courses.replanning import TRIALS, replan
from fiveroute.sea.world import World

ROUTE: tuple[int, ...] = (4, 7, 2, 9, 12, 6)


@pytest.fixture(scope="module")
def view(world: World) -> Outlook:
    return with_recourse(Outlook.of(world.problem, world.law, 1.645))


def value(view: Outlook, route: tuple[int, ...], left: float) -> tuple[int, float]:
    """Position of the next stop from the start, and V there."""
    stops = np.array((0, *route, len(view.profit) - 1))
    values = np.empty((len(stops), view.late.shape[1]))
    look_ahead(view, stops, len(stops), values)
    return next_stop(view, stops, len(stops), 0, left, values)


@pytest.mark.parametrize("left", [6000.0, 9000.0, 14_000.0])
def test_a_course_is_worth_what_sailing_it_brings(view: Outlook, left: float) -> None:
    rng, runs, worth = np.random.default_rng(1), 400, []
    for _ in range(runs):
        at, rest, time, data = 0, ROUTE, left, 0.0
        while time >= 0.0:
            moved = view._replace(legs=view.legs.copy(), variance=view.variance.copy())
            moved.legs[0], moved.variance[0] = view.legs[at], view.variance[at]
            late = view.late.copy()
            late[0] = view.late[at]
            to, _ = value(moved._replace(late=late), rest, time)
            j = (0, *rest, len(view.profit) - 1)[to]
            deviation = float(view.variance[at, j]) ** 0.5
            time -= max(float(view.legs[at, j]) + deviation * rng.standard_normal(), 0.0)
            data += float(view.profit[j])
            if j == len(view.profit) - 1:
                break
            at, rest = j, rest[to:]
        worth.append(data - view.price * (time < 0.0))
    error = np.std(worth) / runs**0.5
    assert value(view, ROUTE, left)[1] == pytest.approx(np.mean(worth), abs=3.0 * error + 0.1)


@given(left=st.floats(0.0, 18_000.0), more=st.floats(0.0, 5000.0))
@settings(deadline=None, max_examples=40)
def test_time_and_options_are_worth_something(view: Outlook, left: float, more: float) -> None:
    assert value(view, ROUTE, left + more)[1] >= value(view, ROUTE, left)[1] - 1e-9
    assert value(view, ROUTE[:3], left)[1] >= value(view, ROUTE[:2], left)[1] - 1e-9


def test_with_time_for_all_it_goes_on_and_without_it_goes_home(view: Outlook) -> None:
    assert value(view, ROUTE, 18_000.0)[0] == 1
    late = Course(0, 100.0, 0.0, 0.0, ROUTE)
    assert reconsider(view, late, ())[0].route == ()


@given(
    nodes=st.integers(0, 20),
    seed=st.integers(0, 10_000),
    budget=st.floats(0.0, 30_000.0),
    reserve=st.sampled_from([0.0, 1.645]),
)
@settings(deadline=None, max_examples=60)
def test_what_comes_out_keeps_the_reserve(
    nodes: int, seed: int, budget: float, reserve: float
) -> None:
    world = World.of(generate(nodes=nodes, seed=seed, fleet_size=1))
    view = with_recourse(Outlook.of(world.problem, world.law, reserve))
    order = tuple((np.random.default_rng(seed).permutation(nodes) + 1).tolist())
    before = Course(0, 0.0, 0.0, budget, order[: nodes // 2])
    after, left_over = reconsider(view, before, order[nodes // 2 :])
    assert sorted((*after.route, *left_over)) == list(range(1, nodes + 1))
    assert in_hand(view, after) >= min(0.0, in_hand(view, discard(view, before)[0]))


def test_who_keeps_a_reserve_for_the_longest_leg_does_not_look_ahead(world: World) -> None:
    plain, course = Outlook.of(world.problem, world.law, 1.645), Course(0, 0.0, 0.0, 9000.0, ROUTE)
    assert reconsider(plain, course, (1, 3)) == replan(plain, course, (1, 3), TRIALS, 0)


def test_where_nothing_is_uncertain_a_plan_that_fits_is_sailed() -> None:
    calm = Uncertainty(drift=0.0, manoeuvres_per_km=0.0, manoeuvre_time=0.0)
    world = World.of(generate(nodes=10, seed=2, fleet_size=1), uncertainty=calm)
    view = with_recourse(Outlook.of(world.problem, world.law, 1.645))
    course = Course(0, 0.0, 0.0, 1e5, (3, 5, 1))
    tight = replace(course, budget=1e5 - in_hand(view, course) + 1e-3)
    assert set(reconsider(view, tight, ())[0].route) == {3, 5, 1}
