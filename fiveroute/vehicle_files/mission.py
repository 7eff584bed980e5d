"""What every writer of vehicle files takes: the fleet's waypoints, on Earth, with depths.

A `Mission` is a plan made ready for vehicles: positions in degrees (WGS84) beside the planner's
metres, depths in metres, positive down, and times in seconds after the departure. It knows no
format, and a format knows nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Literal

from fiveroute.errors import InputError

__all__ = ["Kind", "Mission", "Position", "SensorNode", "Vehicle", "Waypoint", "Zone"]

Kind = Literal["start", "node", "bend", "destination"]
"""What a waypoint is; a bend is one of the path between the others."""


@dataclass(frozen=True, slots=True)
class Position:
    """A place on Earth in degrees, WGS84."""

    lon: float
    lat: float


@dataclass(frozen=True, slots=True)
class Waypoint:
    """A place that an AUV sails to in a straight line.

    Parameters
    ----------
    kind
        What it is: ``start``, ``node``, ``destination``, or a ``bend`` of the path in between.
    name
        Id of the node; ``start``, ``destination``, or nothing at a bend.
    place
        Where it is.
    x, y
        Where it is in the planner's metres.
    depth
        Depth in metres, positive down; 0 at the surface.
    hold
        How long the AUV stays, in seconds.
    arrival
        When it arrives, in seconds after the departure.
    """

    kind: Kind
    name: str
    place: Position
    x: float
    y: float
    depth: float
    hold: float
    arrival: float


@dataclass(frozen=True, slots=True)
class Vehicle:
    """An AUV and what it is to do, from the start to the destination.

    Parameters
    ----------
    name
        Its name: letters, digits, dots, hyphens and underscores only.
    waypoints
        Where it goes, the start first and the destination last.
    """

    name: str
    waypoints: tuple[Waypoint, ...]


@dataclass(frozen=True, slots=True)
class SensorNode:
    """A sensor node, whether it is visited or not.

    Parameters
    ----------
    name
        Its id.
    place
        Where it is.
    depth
        Depth in metres, positive down.
    data
        Its data.
    vehicle
        Name of the AUV that visits it; None without one.
    """

    name: str
    place: Position
    depth: float
    data: float
    vehicle: str | None


@dataclass(frozen=True, slots=True)
class Zone:
    """Where no AUV may be.

    Parameters
    ----------
    kind
        ``obstacle`` or ``land``.
    corners
        Its corners anticlockwise, the first not repeated; of a polygon around a round one.
    centre, radius
        Of a round obstacle, the radius in metres; None for a polygon.
    """

    kind: Literal["obstacle", "land"]
    corners: tuple[Position, ...]
    centre: Position | None = None
    radius: float | None = None


@dataclass(frozen=True, slots=True)
class Mission:
    """A plan made ready for vehicles.

    Parameters
    ----------
    name
        Name of the instance.
    vehicles
        The AUVs that are exported.
    nodes, zones
        The nodes and the closed zones of the instance.
    origin
        What the planner's metres are measured from.
    speed
        Speed through the water in metres per second.
    depth_rating
        How deep the AUVs may dive, in metres; None leaves it open.
    departure
        When they leave, UTC; None leaves it open.
    """

    name: str
    vehicles: tuple[Vehicle, ...]
    nodes: tuple[SensorNode, ...]
    zones: tuple[Zone, ...]
    origin: Position
    speed: float
    depth_rating: float | None = None
    departure: datetime | None = None

    def moment(self, seconds: float) -> str | None:
        """The time so long after the departure, as 2016-01-31T12:00:00Z; None if it is open."""
        if self.departure is None:
            return None
        try:
            then = self.departure + timedelta(seconds=round(seconds))
        except OverflowError:
            raise InputError(
                "seconds after the departure are beyond the calendar; leave it out", value=seconds
            ) from None
        return then.strftime("%Y-%m-%dT%H:%M:%SZ")
