import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Currents, Ocean
from fiveroute.ocean.currents import UniformCurrent
from fiveroute.sea.events import Event
from fiveroute.view.timed_legs import Leg, Shapes, planned_legs, sailed_legs, shapes_of, track_of


def test_routes_take_as_long_as_is_filed(plan: PlanFile) -> None:
    legs = planned_legs(plan, plan.plan)
    assert [own[-1].done for own in legs] == pytest.approx(list(plan.durations))
    assert [[leg.head for leg in own] for own in legs] == [[1, 2, 5], [3, 5]]
    for own in legs:
        for before, after in itertools.pairwise(own):
            assert (after.tail, after.left) == (before.head, before.done)
        assert all(leg.done - leg.reached == pytest.approx(60.0) for leg in own[:-1])


def test_straight_legs_take_their_length_over_the_speed(plan: PlanFile) -> None:
    still = replace(plan, paths=None, instance=replace(plan.instance, ocean=Ocean()))
    (first, second, _), _ = planned_legs(still, still.plan)
    assert first == pytest.approx((0, 1, 0.0, 1000.0, 1060.0))
    assert second.reached == pytest.approx(1060.0 + math.hypot(1000.0, 500.0))


def test_time_goes_by_as_the_current_lets_it(plan: PlanFile) -> None:
    """Along (500, 200) and (500, -200) in a northward current the crab angles differ."""
    shape = shapes_of(plan, plan.plan, UniformCurrent(0.0, 0.5)).paths[0]
    east, north = np.array([500.0, 200.0]) / math.hypot(500.0, 200.0)
    across = math.sqrt(1.0 - (0.5 * east) ** 2)
    times = [1.0 / (0.5 * north + across), 1.0 / (-0.5 * north + across)]
    assert shape.share == pytest.approx([0.0, times[0] / sum(times), 1.0])


def test_pace_is_steady_where_a_leg_cannot_be_sailed(plan: PlanFile) -> None:
    shape = shapes_of(plan, plan.plan, UniformCurrent(-3.0, 0.0)).paths[0]
    assert shape.share == pytest.approx([0.0, 0.5, 1.0])


def test_log_tells_legs(plan: PlanFile) -> None:
    events = [Event(100.0, 0, "collect", 2), Event(120.0, 0, "send"), Event(300.0, 0, "arrive")]
    legs, other = sailed_legs(plan.instance, 2, events)
    assert legs == (Leg(0, 2, 0.0, 40.0, 100.0), Leg(2, 5, 100.0, 300.0, 300.0))
    assert other == ()


def test_track_follows_shapes_and_waits_for_service(plan: PlanFile) -> None:
    shapes = shapes_of(plan, plan.plan, None)
    legs = (Leg(0, 1, 0.0, 10.0, 14.0), Leg(1, 3, 14.0, 20.0, 20.0))
    track = track_of(0, legs, shapes, plan.instance.points)
    assert track[:, 2] == pytest.approx([0.0, 0.0, 5.0, 10.0, 14.0, 14.0, 20.0])
    assert track[2, :2] == pytest.approx([500.0, 200.0])
    assert track[-1, :2] == pytest.approx([1500.0, 2000.0])


def test_no_legs_is_the_start(plan: PlanFile) -> None:
    assert track_of(0, (), Shapes(), plan.instance.points).tolist() == [[0.0, 0.0, 0.0]]


def test_unsailed_currents_do_not_matter_for_straight_plans(plan: PlanFile) -> None:
    straight = replace(plan, paths=None)
    assert shapes_of(straight, straight.plan, None).paths == ()
    assert straight.instance.ocean.currents != Currents()


def test_an_auv_keeps_to_its_own_path_and_else_to_that_of_another(plan: PlanFile) -> None:
    """Two AUVs may sail the direct leg, each on a path of its own."""
    ways = tuple(((0.0, 0.0), (2000.0, y), (4000.0, 0.0)) for y in (100.0, -100.0))
    direct = replace(plan, routes=((), ()), paths=tuple((way,) for way in ways))
    shapes = shapes_of(direct, direct.plan, None)
    leg = Leg(0, 5, 0.0, 1.0, 1.0)
    assert [shapes.place(auv, leg) for auv in range(3)] == [0, 1, 0]
    assert shapes.place(0, Leg(1, 5, 0.0, 1.0, 1.0)) is None
