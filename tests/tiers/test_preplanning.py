"""Tier 1: the fleet that is sent, and the starts it hands to tier 2."""

from dataclasses import replace

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.generate import paper_scenario, scenario
from fiveroute.instance import Fleet, Instance, Node, Point
from fiveroute.limits import Limits
from fiveroute.result import Status
from fiveroute.routes import Plan
from fiveroute.tiers.preplanning import Allocation, allocations, find_giant_route, preplan

METHODS: tuple[Allocation, ...] = ("giant-route", "voronoi", "k-means", "ahc")


def outpost(endurance: float | None, size: int | None = None) -> Instance:
    """One node 100 m off, start and destination at the same place."""
    return Instance(
        "outpost",
        (Node("a", 100.0, 0.0, 1.0),),
        Point(0.0, 0.0),
        Point(0.0, 0.0),
        Fleet(size, 1.0, endurance),
    )


def rng() -> np.random.Generator:
    return np.random.default_rng(1)


def test_the_papers_fleets_have_three_or_four() -> None:
    sizes = {preplan(paper_scenario(seed), rng=rng()).problem.fleet_size for seed in range(1, 6)}
    assert sizes <= {3, 4}


def test_a_stated_fleet_is_sent_and_the_estimate_told() -> None:
    tier1 = preplan(paper_scenario(1), 6, rng=rng())
    assert tier1.problem.fleet_size == 6
    assert tier1.estimate is not None
    assert tier1.estimate.size in (3, 4)
    stated = scenario("uniform", 20, 1, 5)
    assert preplan(stated, rng=rng()).problem.fleet_size == 5
    assert preplan(stated, 2, rng=rng()).problem.fleet_size == 2


def test_unlimited_endurance_needs_one_auv_and_limited_two() -> None:
    assert preplan(outpost(None), rng=rng()).problem.fleet_size == 1
    assert preplan(outpost(10_000.0), rng=rng()).problem.fleet_size == 2


def test_no_nodes_need_one_auv() -> None:
    tier1 = preplan(replace(outpost(1_000.0), nodes=()), rng=rng())
    assert tier1.problem.fleet_size == 1
    assert tier1.giant_routes == ((),)


def test_an_endurance_too_short_for_an_estimate_is_refused_unless_a_size_is_stated() -> None:
    with pytest.raises(InputError, match=r"fleet\.endurance"):
        preplan(outpost(150.0), rng=rng())
    assert preplan(outpost(150.0), 3, rng=rng()).estimate is None


def test_an_infeasible_mission_is_left_to_the_caller() -> None:
    far = replace(outpost(150.0), destination=Point(200.0, 0.0))
    assert preplan(far, rng=rng()).estimate is None


@pytest.mark.parametrize("method", METHODS)
def test_every_start_has_every_node_once(method: Allocation) -> None:
    instance = paper_scenario(2)
    tier1 = preplan(instance, rng=rng())
    starts = list(
        allocations(
            tier1.problem,
            method,
            5,
            giant_routes=tier1.giant_routes,
            points=instance.points,
            rng=rng(),
        )
    )
    assert 1 <= len(starts) <= 5
    for start in starts:
        assert len(start) == tier1.problem.fleet_size
        assert sorted(node for route in start for node in route) == list(range(1, 61))


def test_the_first_start_is_the_best_giant_route_in_squares() -> None:
    instance = paper_scenario(3)
    tier1 = preplan(instance, rng=rng())
    start = next(
        allocations(
            tier1.problem,
            "giant-route",
            16,
            giant_routes=tier1.giant_routes,
            points=instance.points,
            rng=rng(),
        )
    )
    assert sum(start, ()) == tier1.giant_routes[0]
    times = Plan(start).durations(tier1.problem)
    assert max(times) - min(times) < 0.2 * max(times)


def test_the_longest_sub_route_goes_to_the_auv_that_lasts_longest() -> None:
    instance = paper_scenario(4)
    mixed = replace(instance, fleet=Fleet(None, 1.0, (9_000.0, 20_000.0, 15_000.0)))
    tier1 = preplan(mixed, rng=rng())
    for start in allocations(
        tier1.problem,
        "voronoi",
        3,
        giant_routes=tier1.giant_routes,
        points=mixed.points,
        rng=rng(),
    ):
        first, second, third = Plan(start).durations(tier1.problem)
        assert first <= third <= second


def test_the_giant_route_alone() -> None:
    problem = scenario("uniform", 12, 1, 2).problem()
    found = find_giant_route(problem, seed=1)
    assert sorted(found.order) == list(range(1, 13))
    assert found.duration == problem.duration(found.order)
    assert found.bound is not None
    assert found.bound <= found.duration
    proved = find_giant_route(problem, Limits(time=60.0), exact=True, seed=1)
    assert proved.status is Status.OPTIMAL
    assert proved.duration <= found.duration + 1e-6
