"""What ArduSub would refuse, or would do otherwise than it says, is not written."""

from dataclasses import replace

import pytest

from fiveroute.errors import InputError
from fiveroute.vehicle_files.ardusub import Item, check_items, items_of
from fiveroute.vehicle_files.mission import Mission

PLACE = (63.0, 10.0, -5.0)


def test_items_follow_home_with_altitudes_below_zero(mission: Mission) -> None:
    speed, *rest = items_of(mission, mission.vehicles[0])
    assert (speed.command, speed.frame, speed.parameters[:3]) == (178, 2, (1.0, 1.25, -1.0))
    assert [item.parameters[-1] for item in rest] == [-20.0, -35.5, -20.0, -0.1]
    assert [item.parameters[0] for item in rest] == [0.0, 31.0, 0.0, 0.0]
    assert {(item.command, item.frame) for item in rest} == {(16, 3)}
    check_items([speed, *rest])


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (Item(16, 3, (0.0, 0.0, 0.0, 0.0, 63.0, 10.0, 5.0)), "below 0"),
        (Item(16, 3, (0.0, 0.0, 0.0, 0.0, 63.0, 10.0, 0.0)), "below 0"),
        (Item(16, 0, (0.0, 0.0, 0.0, 0.0, *PLACE)), "relative to home"),
        (Item(21, 3, (0.0, 0.0, 0.0, 0.0, *PLACE)), "must be a waypoint"),
        (Item(16, 3, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -5.0)), "own position"),
        (Item(16, 3, (0.0, 0.0, 0.0, 0.0, 10.0, 190.0, -5.0)), "not on Earth"),
        (Item(16, 3, (65_536.0, 0.0, 0.0, 0.0, *PLACE)), "65535 s"),
        (Item(16, 3, (-1.0, 0.0, 0.0, 0.0, *PLACE)), "65535 s"),
        (Item(16, 3, (0.5, 0.0, 0.0, 0.0, *PLACE)), "65535 s"),
    ],
)
def test_other_items_are_refused(mission: Mission, wrong: Item, words: str) -> None:
    speed, *_ = items_of(mission, mission.vehicles[0])
    with pytest.raises(InputError, match=words):
        check_items([speed, wrong])


def test_the_speed_comes_first(mission: Mission) -> None:
    with pytest.raises(InputError, match="first"):
        check_items(items_of(mission, mission.vehicles[0])[1:])
    with pytest.raises(InputError, match="first"):
        check_items([])


def test_shallow_water_is_no_reason_to_keep_the_depth(mission: Mission) -> None:
    points = mission.vehicles[0].waypoints
    vehicle = replace(mission.vehicles[0], waypoints=(points[0], replace(points[1], depth=0.04)))
    assert items_of(mission, vehicle)[-1].parameters[-1] == -0.1
