"""A fleet of two in a bay, ready for vehicles."""

from __future__ import annotations

from datetime import datetime

import pytest

from fiveroute.vehicle_files.mission import (
    Kind,
    Mission,
    Position,
    SensorNode,
    Vehicle,
    Waypoint,
    Zone,
)


def waypoint(
    kind: Kind, name: str, lon: float, lat: float, depth: float, **more: float
) -> Waypoint:
    x, y = more.get("x", 111_000.0 * (lon - 10.0)), more.get("y", 111_000.0 * (lat - 63.0))
    hold, arrival = more.get("hold", 0.0), more.get("arrival", 0.0)
    return Waypoint(kind, name, Position(lon, lat), x, y, depth, hold, arrival)


@pytest.fixture
def mission() -> Mission:
    one = Vehicle(
        "auv-1",
        (
            waypoint("start", "start", 10.0, 63.0, 0.0),
            waypoint("bend", "", 10.01, 63.005, 20.0, arrival=700.0),
            waypoint("node", "a", 10.02, 63.0, 35.5, hold=30.2, arrival=1400.0),
            waypoint("node", "b", 10.03, 63.0, 20.0, arrival=2000.0),
            waypoint("destination", "destination", 10.04, 63.0, 0.0, arrival=2600.0),
        ),
    )
    ends = one.waypoints[0], one.waypoints[-1]
    return Mission(
        name="bay",
        vehicles=(one, Vehicle("auv-2", ends)),
        nodes=(
            SensorNode("a", Position(10.02, 63.0), 35.5, 2.0, "auv-1"),
            SensorNode("b", Position(10.03, 63.0), 20.0, 1.0, "auv-1"),
            SensorNode("c", Position(10.05, 63.1), 20.0, 1.0, None),
        ),
        zones=(
            Zone("land", (Position(9.9, 63.1), Position(10.0, 63.1), Position(10.0, 63.2))),
            Zone(
                "obstacle",
                (Position(10.1, 63.1), Position(10.11, 63.1), Position(10.1, 63.11)),
                Position(10.1, 63.1),
                300.0,
            ),
        ),
        origin=Position(10.0, 63.0),
        speed=1.25,
        depth_rating=100.0,
        departure=datetime(2026, 6, 1, 6, 0),
    )
