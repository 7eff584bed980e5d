from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from fiveroute.errors import InputError
from fiveroute.instance import (
    MAX_FLEET,
    Circle,
    Currents,
    Fleet,
    Instance,
    Node,
    Ocean,
    Point,
    Polygon,
    Service,
    Uniform,
)

# Two nodes on a 3-4-5 triangle; the start lies at its right angle, the destination on a node.
NODES = (Node("a", 300.0, 0.0, 0.5), Node("b", 0.0, 400.0, 1.0, service_time=7.0))


def instance(**changes: Any) -> Instance:
    parts: dict[str, Any] = {
        "name": "triangle",
        "nodes": NODES,
        "start": Point(0.0, 0.0),
        "destination": Point(0.0, 400.0),
        "fleet": Fleet(2, 2.0, 1000.0),
        "service": Service(delay=5.0, rate=20.0),
    }
    return Instance(**(parts | changes))


def test_leg_times_are_distances_over_speed() -> None:
    expected = [[0, 150, 200, 200], [150, 0, 250, 250], [200, 250, 0, 0], [200, 250, 0, 0]]
    np.testing.assert_allclose(instance().travel, expected)


def test_service_times_follow_the_data_unless_stated() -> None:
    np.testing.assert_allclose(instance().service_times, [0.0, 15.0, 7.0, 0.0])


def test_problem_has_a_budget_for_every_auv() -> None:
    problem = instance().problem()
    assert problem.budgets.tolist() == [1000.0, 1000.0]
    assert problem.profit.tolist() == [0.0, 0.5, 1.0, 0.0]
    assert instance().problem(3).fleet_size == 3


def test_endurances_state_the_size_of_the_fleet() -> None:
    two = instance(fleet=Fleet(None, 1.0, (10.0, 20.0)))
    assert two.fleet_size == 2
    assert two.problem().budgets.tolist() == [10.0, 20.0]
    with pytest.raises(InputError, match="names 2 AUVs"):
        two.problem(3)


def test_unlimited_endurance_fits_every_route() -> None:
    problem = instance(fleet=Fleet(1, 2.0, None)).problem()
    assert all(problem.duration(route) <= problem.budgets[0] for route in ([1, 2], [2, 1]))


def test_empty_node_list_is_legal() -> None:
    problem = instance(nodes=()).problem()
    assert problem.n == 0
    assert problem.travel[0, 1] == 200.0


@pytest.mark.parametrize("size", [None, 0, -1, MAX_FLEET + 1])
def test_impossible_fleet_sizes_are_refused(size: int | None) -> None:
    with pytest.raises(InputError, match="from 1 to"):
        instance(fleet=Fleet(None, 1.0, 5.0)).problem(size)


def test_start_and_destination_in_one_place_are_no_way_apart() -> None:
    for metric in ("euclidean", "EUC_2D", "CEIL_2D", "GEO", "ATT"):
        closed = instance(destination=Point(0.0, 0.0), metric=metric)
        assert closed.travel[0, -1] == closed.travel[-1, 0] == 0.0


def test_explicit_times_stand_for_themselves() -> None:
    times = ((0.0, 1.0, 2.0, 3.0),) * 4
    explicit = instance(metric="explicit", travel_times=times)
    np.testing.assert_array_equal(explicit.travel, times)
    assert not explicit.problem().is_symmetric


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"nodes": (NODES[0], NODES[0])}, r"nodes\[1\].id: 'a': is the id of nodes\[0\] too"),
        ({"crs": "EPSG:4326"}, "crs: 'EPSG:4326': only local metres"),
        ({"fleet": Fleet(3, 1.0, (1.0, 2.0))}, "fleet.size: 3: endurance has 2 entries"),
        ({"metric": "explicit"}, "go together"),
        ({"travel_times": ((0.0,) * 4,) * 4}, "go together"),
        (
            {"metric": "explicit", "travel_times": ((0.0,) * 4,) * 3},
            "travel_times: 3: must have 4 entries",
        ),
        (
            {"metric": "explicit", "travel_times": (*((0.0,) * 4,) * 3, (0.0,))},
            r"travel_times\[3\]: 1: must have 4 entries",
        ),
    ],
)
def test_contradictions_are_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        instance(**changes)


@pytest.mark.parametrize(
    "build",
    [
        lambda: Node("", 0.0, 0.0, 1.0),
        lambda: Node("a", float("nan"), 0.0, 1.0),
        lambda: Node("a", 0.0, float("inf"), 1.0),
        lambda: Node("a", 0.0, 0.0, -1.0),
        lambda: Node("a", 0.0, 0.0, 1.0, service_time=-1.0),
        lambda: Fleet(0, 1.0, 1.0),
        lambda: Fleet(MAX_FLEET + 1, 1.0, 1.0),
        lambda: Fleet(1, 0.0, 1.0),
        lambda: Fleet(1, -1.0, 1.0),
        lambda: Fleet(1, 1.0, 0.0),
        lambda: Fleet(1, 1.0, ()),
        lambda: Fleet(1, 1.0, (1.0, -1.0)),
        lambda: Polygon(((0.0, 0.0), (1.0, 1.0))),
        lambda: Circle(0.0, 0.0, 0.0),
        lambda: Currents(file=""),
    ],
)
def test_impossible_values_are_refused(build: Any) -> None:
    with pytest.raises(ValidationError):
        build()


@pytest.mark.parametrize("metric", ["euclidean", "EUC_2D", "CEIL_2D", "GEO", "ATT"])
@pytest.mark.parametrize("endurance", [None, 5.0])
def test_places_beyond_all_numbers_are_refused(metric: Any, endurance: float | None) -> None:
    far = Node("far", 1e308, -1e308, 1.0)
    with pytest.raises(InputError, match="must be finite"):
        instance(nodes=(far,), metric=metric, fleet=Fleet(1, 0.1, endurance)).problem()


def test_ocean_is_told_from_still_open_water() -> None:
    assert not instance().has_ocean
    for ocean in (
        Ocean(Currents(uniform=Uniform(0.1, 0.0))),
        Ocean(obstacles=(Circle(0.0, 0.0, 5.0),)),
        Ocean(land=(Polygon(((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))),)),
    ):
        assert replace(instance(), ocean=ocean).has_ocean
