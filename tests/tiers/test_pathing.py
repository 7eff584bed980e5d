"""Tier 3 in one piece: closed forms, obstacles, unreachable nodes, asymmetric leg times."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from shapely import LineString
from shapely import Point as Spot

from fiveroute.check_paths import sailing_time
from fiveroute.fleet_planning import plan
from fiveroute.instance import (
    Circle,
    Currents,
    Fleet,
    Instance,
    Node,
    Ocean,
    Point,
    Polygon,
    Uniform,
    Vortex,
)
from fiveroute.limits import Limits, Progress
from fiveroute.ocean.stated import stated_current
from fiveroute.paths.stated_waters import waters_of
from fiveroute.paths.waters import Waters
from fiveroute.result import Status
from fiveroute.tiers.pathing import at_sea, plan_legs, plan_path

STILL = Ocean()
STREAM = Ocean(Currents(uniform=Uniform(0.4, 0.0)))
EDDIES = Ocean(
    Currents(
        vortices=(Vortex(1500.0, 1200.0, 1200.0, 500.0), Vortex(2500.0, 2600.0, -900.0, 600.0))
    ),
    (Circle(2000.0, 2000.0, 300.0),),
)


def mission(ocean: Ocean) -> Instance:
    """Three nodes between the south-west and the north-east of a square of 4 km."""
    nodes = ((500.0, 3500.0), (3500.0, 500.0), (2000.0, 1000.0))
    return Instance(
        "square",
        tuple(Node(f"n{k}", x, y, 1.0) for k, (x, y) in enumerate(nodes)),
        Point(0.0, 0.0),
        Point(4000.0, 4000.0),
        Fleet(1, 1.0, 20000.0),
        ocean=ocean,
    )


def waters(ocean: Ocean) -> Waters:
    instance = mission(ocean)
    return waters_of(instance, stated_current(instance))


def test_legs_in_still_water_are_straight() -> None:
    instance = mission(STILL)
    table = plan_legs(waters(STILL), stated_current(instance), instance.points)
    for tail, head in table.planned():
        away = instance.points[head] - instance.points[tail]
        assert table.times[tail, head] == pytest.approx(math.hypot(*away), rel=1e-12)
        assert len(table.track(tail, head)) == 2


def test_legs_in_a_uniform_stream_have_their_closed_form() -> None:
    instance = mission(STREAM)
    table = plan_legs(waters(STREAM), stated_current(instance), instance.points)
    for tail, head in table.planned():
        east, north = instance.points[head] - instance.points[tail]
        length = math.hypot(east, north)
        made_good = 0.4 * east / length + math.sqrt(1.0 - (0.4 * north / length) ** 2)
        assert table.times[tail, head] == pytest.approx(length / made_good, rel=1e-9)


def test_legs_among_eddies_and_an_obstacle() -> None:
    """No worse than the straight line, as fast as the reference, and clear of the obstacle."""
    instance, sea = mission(EDDIES), waters(EDDIES)
    current, points = stated_current(instance), instance.points
    table = plan_legs(sea, current, points)
    legs = list(table.planned())
    assert legs == [leg for leg in itertools.product(range(4), range(1, 5)) if leg[0] != leg[1]]
    rock = Spot(2000.0, 2000.0).buffer(299.9)
    for leg in legs:
        track, time = table.track(*leg), table.times[leg]
        assert track[[0, -1]].tolist() == points[list(leg)].tolist()
        assert not LineString(track).intersects(rock)
        assert time == sailing_time(track, current, 1.0)
        straight = LineString(points[list(leg)])
        if not straight.intersects(rock):
            assert time <= sailing_time(points[list(leg)], current, 1.0) * (1.0 + 1e-6)
        reference = plan_path(sea, *points[list(leg)]).reference
        assert time == pytest.approx(reference, rel=3e-3)
    assert table.times[1, 2] != pytest.approx(table.times[2, 1], rel=1e-3)


def test_a_leg_does_not_depend_on_the_others() -> None:
    instance, sea = mission(EDDIES), waters(EDDIES)
    current, points = stated_current(instance), instance.points
    alone = plan_legs(sea, current, points, only=[(2, 1)])
    both = plan_legs(sea, current, points, only=[(0, 4), (2, 1)])
    assert alone.times[2, 1] == both.times[2, 1]
    assert np.isinf(alone.times[0, 4])


def test_times_taken_in_haste_are_never_too_short() -> None:
    instance = mission(EDDIES)
    current = stated_current(instance)
    sea = waters_of(instance, current)
    table = plan_legs(sea, current, instance.points, limits=Limits(time=0.0))
    for leg in table.planned():
        exact = sailing_time(table.track(*leg), current, 1.0)
        assert exact <= table.times[leg] <= 1.003 * exact


def test_an_expired_clock_leaves_straight_lines() -> None:
    instance = mission(replace(EDDIES, obstacles=()))
    sea, current = waters(instance.ocean), stated_current(instance)
    table = plan_legs(sea, current, instance.points, limits=Limits(time=0.0))
    assert (table.track(0, 1) == instance.points[[0, 1]]).all()
    exact = sailing_time(instance.points[[0, 1]], current, 1.0)
    assert table.times[0, 1] == pytest.approx(exact, rel=2e-3)


def test_no_time_at_all_still_finds_ways_round_what_blocks_them() -> None:
    walls = Ocean(
        land=(
            Polygon(((200.0, 3000.0), (900.0, 3000.0), (900.0, 3100.0), (200.0, 3100.0))),
            Polygon(((1700.0, 600.0), (2300.0, 600.0), (2300.0, 700.0), (1700.0, 700.0))),
        ),
        obstacles=(Circle(3000.0, 1000.0, 250.0), Circle(600.0, 600.0, 100.0)),
    )
    voyage = at_sea(mission(walls), limits=Limits(time=0.0))
    assert voyage.unreachable == ()
    assert voyage.travel is not None
    assert np.isfinite(voyage.travel[:-1, 1:]).all()
    assert voyage.is_complete


def test_an_interruption_proves_nothing() -> None:
    limits = Limits()
    limits.interrupt.set()
    instance = mission(Ocean(obstacles=(Circle(2000.0, 1500.0, 250.0),)))
    assert not at_sea(instance, limits=limits).is_complete
    cut_off = plan(instance, bound="exact", limits=limits)
    assert cut_off.bound is None
    assert cut_off.status is not Status.OPTIMAL


def test_a_node_that_cannot_be_reached_is_named_and_left_out() -> None:
    """Node n2 lies in a bay closed all around, the others do not."""
    wall = [(1500, 500), (2500, 500), (2500, 1500), (1500, 1500), (1500, 600), (1600, 600)]
    wall += [(1600, 1400), (2400, 1400), (2400, 600), (1700, 600), (1700, 550), (1500, 550)]
    closed = Polygon(tuple((float(x), float(y)) for x, y in wall))
    lid = Polygon(((1550.0, 480.0), (1750.0, 480.0), (1750.0, 620.0), (1550.0, 620.0)))
    voyage = at_sea(mission(Ocean(land=(closed, lid))))
    assert voyage.unreachable == ("n2",)
    assert [node.id for node in voyage.instance.nodes] == ["n0", "n1"]
    assert voyage.travel is not None
    assert np.isfinite(voyage.travel[:-1, 1:]).all()
    problem = voyage.instance.problem(travel=voyage.travel)
    assert problem.n == 2


def test_against_too_strong_a_stream_nothing_is_reached() -> None:
    voyage = at_sea(mission(Ocean(Currents(uniform=Uniform(-1.5, 0.0)))))
    assert voyage.unreachable == ("n0", "n1", "n2")
    problem = voyage.instance.problem(travel=voyage.travel)
    assert problem.travel[0, -1] > problem.allowed[0]


def test_still_open_water_needs_no_planning() -> None:
    voyage = at_sea(mission(STILL))
    assert voyage.travel is None
    assert voyage.unreachable == ()


def test_a_voyage_is_planned_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FIVEROUTE_CACHE", str(tmp_path))
    instance = mission(replace(EDDIES, obstacles=()))
    reports: list[Progress] = []
    first = at_sea(instance, progress=reports.append)
    assert len(list(tmp_path.rglob("*.npz"))) == 1
    again = at_sea(instance, limits=Limits(time=0.0))
    assert first.travel is not None
    assert again.travel is not None
    assert again.travel.tolist() == first.travel.tolist()


def test_one_path_with_its_reference() -> None:
    planned = plan_path(waters(EDDIES), np.zeros(2), np.array([4000.0, 4000.0]))
    assert planned.path.is_found
    assert planned.path.min_clearance >= 0.0
    assert planned.gap is not None
    assert abs(planned.gap) < 2e-3


def test_no_path_has_no_gap() -> None:
    sea = waters(Ocean(Currents(uniform=Uniform(-1.5, 0.0))))
    planned = plan_path(sea, np.zeros(2), np.array([4000.0, 4000.0]))
    assert not planned.path.is_found
    assert planned.gap is None
