"""QGroundControl's plan for ArduSub: JSON, a file an AUV.

Obstacles and land go with it as exclusion zones of the geofence. The rules of the vehicle are
those of `fiveroute.vehicle_files.ardusub`.

References
----------
QGroundControl Developer Guide, "Plan File Format".
"""

from __future__ import annotations

import json
from typing import Any

from fiveroute.vehicle_files.ardusub import (
    ABOVE_HOME,
    MISSION_FRAME,
    WAYPOINT,
    Item,
    check_items,
    items_of,
)
from fiveroute.vehicle_files.mission import Mission, Position, Vehicle, Zone
from fiveroute.vehicle_files.spelling import require

__all__ = ["check", "write"]

_ARDUPILOT = 3
_SUBMARINE = 12
_RELATIVE = 1


def write(mission: Mission) -> dict[str, str]:
    """A plan for every AUV."""
    return {
        f"{vehicle.name}.plan": json.dumps(_plan(mission, vehicle), indent=1, allow_nan=False)
        + "\n"
        for vehicle in mission.vehicles
    }


def check(files: dict[str, str]) -> None:
    """Refuse plans that QGroundControl cannot read or ArduSub must not get."""
    for text in files.values():
        plan = json.loads(text)
        require((plan["fileType"], plan["version"]) == ("Plan", 1), "must be a plan of version 1")
        mission = plan["mission"]
        kinds = mission["version"], mission["firmwareType"], mission["vehicleType"]
        require(kinds == (2, _ARDUPILOT, _SUBMARINE), "must be a mission for ArduSub")
        numbers = [item["doJumpId"] for item in mission["items"]]
        require(numbers == list(range(1, len(numbers) + 1)), "items must be numbered from 1")
        check_items([_parsed(item) for item in mission["items"]])


def _plan(mission: Mission, vehicle: Vehicle) -> dict[str, Any]:
    home = _pair(vehicle.waypoints[0].place)
    items = items_of(mission, vehicle)
    return {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "fiveroute",
        "mission": {
            "version": 2,
            "firmwareType": _ARDUPILOT,
            "vehicleType": _SUBMARINE,
            "globalPlanAltitudeMode": _RELATIVE,
            "cruiseSpeed": mission.speed,
            "hoverSpeed": mission.speed,
            "plannedHomePosition": [*home, 0],
            "items": [_item(item, number) for number, item in enumerate(items, start=1)],
        },
        "geoFence": {
            "version": 2,
            "circles": [_circle(zone) for zone in mission.zones if zone.centre is not None],
            "polygons": [
                {
                    "version": 1,
                    "inclusion": False,
                    "polygon": [_pair(corner) for corner in zone.corners],
                }
                for zone in mission.zones
                if zone.centre is None
            ],
        },
        "rallyPoints": {"version": 2, "points": []},
    }


def _item(item: Item, number: int) -> dict[str, Any]:
    document: dict[str, Any] = {
        "type": "SimpleItem",
        "command": item.command,
        "frame": item.frame,
        "doJumpId": number,
        "autoContinue": True,
        "params": list(item.parameters),
    }
    if item.command == WAYPOINT:
        document |= {
            "AMSLAltAboveTerrain": None,
            "Altitude": item.parameters[-1],
            "AltitudeMode": _RELATIVE,
        }
        document["params"][3] = None  # no heading is asked for
    return document


def _parsed(document: dict[str, Any]) -> Item:
    first, second, third, fourth, *place = document["params"]
    frames = {WAYPOINT: ABOVE_HOME}
    wanted = frames.get(document["command"], MISSION_FRAME)
    require(document["frame"] == wanted, "is the wrong frame", document["frame"], "frame")
    lat, lon, altitude = place
    return Item(
        document["command"],
        document["frame"],
        (first, second, third, fourth or 0.0, lat, lon, altitude),
    )


def _circle(zone: Zone) -> dict[str, Any]:
    assert zone.centre is not None
    circle = {"center": _pair(zone.centre), "radius": zone.radius}
    return {"version": 1, "inclusion": False, "circle": circle}


def _pair(place: Position) -> list[float]:
    return [round(place.lat, 8), round(place.lon, 8)]
