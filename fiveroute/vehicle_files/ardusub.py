"""What ArduSub flies, as QGroundControl's plans and waypoint lists both say it.

- Home is the water surface at the start; altitudes are relative to it, so that they are minus
  the depth. A positive one is refused by the vehicle.
- Altitude 0 means "keep the depth": the surface is written as -0.1 m.
- Latitude and longitude 0 mean "stay where you are"; no waypoint may lie there.
- A stay is a number of whole seconds at a waypoint, at most 65,535.

References
----------
ArduPilot, ``ArduSub/commands_logic.cpp``; MAVLink, "MAV_CMD" of the common message set.
"""

from __future__ import annotations

from dataclasses import dataclass

from fiveroute.vehicle_files.mission import Mission, Vehicle
from fiveroute.vehicle_files.spelling import require, whole_seconds

__all__ = [
    "ABOVE_HOME",
    "CHANGE_SPEED",
    "MISSION_FRAME",
    "SURFACE",
    "WAYPOINT",
    "Item",
    "check_items",
    "items_of",
]

WAYPOINT = 16
CHANGE_SPEED = 178
MISSION_FRAME = 2
ABOVE_HOME = 3

SURFACE = -0.1
"""Altitude in metres that stands for the surface, where 0 would mean any depth."""

_MOST_SECONDS = 65_535


@dataclass(frozen=True, slots=True)
class Item:
    """A mission item: command, frame, and its seven parameters.

    The last three are latitude and longitude in degrees and altitude in metres.
    """

    command: int
    frame: int
    parameters: tuple[float, float, float, float, float, float, float]


def items_of(mission: Mission, vehicle: Vehicle) -> list[Item]:
    """The items of an AUV: its speed, and every waypoint after the start, which is home."""
    speed = Item(CHANGE_SPEED, MISSION_FRAME, (1.0, mission.speed, -1.0, 0.0, 0.0, 0.0, 0.0))
    waypoints = [
        Item(
            WAYPOINT,
            ABOVE_HOME,
            (
                float(whole_seconds(point.hold)),
                0.0,
                0.0,
                0.0,
                round(point.place.lat, 8),
                round(point.place.lon, 8),
                min(round(-point.depth, 3), SURFACE),
            ),
        )
        for point in vehicle.waypoints[1:]
    ]
    return [speed, *waypoints]


def check_items(items: list[Item]) -> None:
    """Refuse what ArduSub would refuse, or would do otherwise than it says."""
    require(items[:1] != [] and items[0].command == CHANGE_SPEED, "the speed must come first")
    for item in items[1:]:
        hold, *_, lat, lon, altitude = item.parameters
        require(item.command == WAYPOINT, "must be a waypoint", item.command, "command")
        require(item.frame == ABOVE_HOME, "must be relative to home", item.frame, "frame")
        require(
            altitude < 0.0, "ArduSub dives to altitudes below 0 only", altitude, "relative altitude"
        )
        require(
            (lat, lon) != (0.0, 0.0),
            "ArduSub takes latitude and longitude 0 for its own position; move the point",
            (lat, lon),
            "waypoint",
        )
        require(abs(lat) <= 90.0 and abs(lon) <= 180.0, "is not on Earth", (lat, lon), "waypoint")
        require(
            0.0 <= hold <= _MOST_SECONDS and hold == int(hold),
            f"ArduSub stays at most {_MOST_SECONDS} s at a waypoint; split the service time",
            hold,
            "service time",
        )
