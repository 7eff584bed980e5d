"""The reserve keeps what it promises: without time in hand a course is in time with Phi(z)."""

from dataclasses import replace
from statistics import NormalDist

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.sea.courses.course import Course, in_hand
from fiveroute.sea.courses.outlook import IN_CURRENTS, Outlook, Pace
from fiveroute.sea.luck import Luck
from fiveroute.sea.world import World

ROUTES = [(), (4,), (7, 2, 9), (3, 1, 12, 6, 20, 15, 8)]


def arrivals(world: World, course: Course, runs: int) -> NDArray[np.float64]:
    problem = world.problem
    stops = np.array([course.anchor, *course.route, problem.destination])
    start = course.time + problem.service[stops[1:]].sum()
    seas = (Luck(world.law, 5, run).matrix() for run in range(runs))
    return np.array([start + legs[stops[:-1], stops[1:]].sum() for legs in seas])


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("z", [0.0, 1.0, 1.645])
def test_a_course_without_time_in_hand_is_in_time_as_promised(
    world: World, route: tuple[int, ...], z: float
) -> None:
    view = Outlook.of(world.problem, world.law, z)
    course = Course(0, 1000.0, 0.0, 20_000.0, route)
    tight = replace(course, budget=course.budget - in_hand(view, course))
    in_time = (arrivals(world, course, 2000) <= tight.budget).mean()
    assert in_hand(view, tight) == pytest.approx(0.0, abs=1e-6)
    # The longest leg counts 2.5 times: of a course of one leg the margin is sqrt(2.5) z.
    least, most = NormalDist().cdf(z), NormalDist().cdf(2.5**0.5 * z)
    assert least - 0.04 <= in_time <= most + 0.04
    if not route:
        assert in_time == pytest.approx(most, abs=0.04)


def test_in_currents_the_pace_of_the_leg_home_is_normal(world: World) -> None:
    law = world.law._replace(manoeuvre_time=0.0)
    plain, view = (Outlook.of(world.problem, law, 1.0, pace) for pace in (None, Pace(1.0, 0.2)))
    home = len(view.profit) - 1
    times = view.step * np.arange(view.late.shape[1])
    for node in (1, 9, 16):
        for z in (-1.0, 0.0, 1.645):
            late = float(
                np.interp(law.planned[node, home] / (1.0 - 0.2 * z), times, view.late[node])
            )
            assert late == pytest.approx(NormalDist().cdf(-z), abs=0.02)
    assert view.reserve == IN_CURRENTS[0] * plain.reserve
    assert view.price > plain.price
    assert (view.variance[1:home, home] > plain.variance[1:home, home]).all()
    assert (view.variance[:, :home] == plain.variance[:, :home]).all()


def test_an_uncertain_anchor_counts(world: World) -> None:
    view = Outlook.of(world.problem, world.law, 2.0)
    sure = Course(0, 0.0, 0.0, 9000.0, ())
    variance = float(view.variance[0, -1])
    unsure = replace(sure, spread=3.0 * variance)
    margins = 2.0 * (variance * np.array([2.5, 5.5])) ** 0.5
    assert in_hand(view, sure) - in_hand(view, unsure) == pytest.approx(margins[1] - margins[0])
