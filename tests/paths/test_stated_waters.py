"""The waters of a mission: room for detours, and stops that nobody could be at."""

from dataclasses import replace

import pytest

from fiveroute.errors import InputError
from fiveroute.instance import Circle, Fleet, Instance, Node, Ocean, Point
from fiveroute.ocean.stated import stated_current
from fiveroute.paths.stated_waters import waters_of
from fiveroute.paths.waters import Waters

MISSION = Instance(
    "square",
    (Node("n0", 2000.0, 1000.0, 1.0),),
    Point(0.0, 0.0),
    Point(3000.0, 4000.0),
    Fleet(1, 1.0, 20000.0),
)


def waters(*obstacles: Circle) -> Waters:
    mission = replace(MISSION, ocean=Ocean(obstacles=obstacles))
    return waters_of(mission, stated_current(mission))


def test_paths_have_a_quarter_of_the_diagonal_for_detours() -> None:
    barriers = waters().barriers
    edges = barriers.west, barriers.south, barriers.east, barriers.north
    assert edges == (-1250.0, -1250.0, 4250.0, 5250.0)


def test_paths_may_go_round_obstacles_that_lie_outside() -> None:
    assert waters(Circle(5000.0, 2000.0, 1000.0)).barriers.east > 6000.0


def test_the_grid_covers_where_paths_may_lead() -> None:
    sea = waters()
    region = sea.grid.region
    assert region.west <= sea.barriers.west
    assert region.north >= sea.barriers.north


def test_a_stop_inside_an_obstacle_is_refused() -> None:
    with pytest.raises(InputError, match=r"nodes\[0\]: .* inside ocean\.obstacles\[0\]"):
        waters(Circle(2000.0, 1000.0, 10.0))
