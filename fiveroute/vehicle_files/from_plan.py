"""From a plan in metres to a mission on Earth.

The waypoints of an AUV are those of its filed paths, thinned out (`safe_tracks`). Without paths the
AUVs sail straight from node to node. They leave and arrive at the surface, cruise at one depth, and
visit a node at its own depth if it states one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fiveroute.check_paths import sailing_time
from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Circle, Instance, Polygon
from fiveroute.ocean.currents import Current
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.stated import stated_current
from fiveroute.vehicle_files.mission import (
    Kind,
    Mission,
    Position,
    SensorNode,
    Vehicle,
    Waypoint,
    Zone,
)
from fiveroute.vehicle_files.safe_tracks import safe_tracks
from fiveroute.vehicle_files.safety import require_depths

__all__ = ["TOLERANCE", "Choices", "mission_of"]

TOLERANCE = 1.0
"""Metres by which the straight lines between waypoints may leave a path."""

Floats = NDArray[np.float64]

_NAMES = r"(?!(?i:con|prn|aux|nul|com\d|lpt\d)(\.|$))[A-Za-z0-9_][A-Za-z0-9_.-]{0,59}"
"""Names of AUVs become names of files; Windows keeps some for devices."""

_FIRST_YEAR, _LAST_YEAR = 1001, 9000

_CORNERS = 64  # of the polygon around a round obstacle


@dataclass(frozen=True, slots=True, kw_only=True)
class Choices:
    """What a plan leaves open.

    Parameters
    ----------
    depth
        Depth at which the AUVs cruise, in metres, positive down; None takes the fleet's.
    origin
        Longitude and latitude in degrees of the point (0, 0); None takes the instance's.
    auv
        The only AUV to export, counted from 1; None exports all.
    names
        Names of the AUVs; without any ``auv-1``, ``auv-2`` and so on.
    departure
        When the fleet leaves, UTC where it says no zone; None takes when the instance's currents
        begin, if they say.
    tolerance
        See `TOLERANCE`.
    """

    depth: float | None = None
    origin: tuple[float, float] | None = None
    auv: int | None = None
    names: tuple[str, ...] = ()
    departure: datetime | None = None
    tolerance: float = TOLERANCE


def mission_of(filed: PlanFile, folder: Path, choices: Choices) -> Mission:
    """Make a plan ready for vehicles, or say why it must not be.

    Parameters
    ----------
    filed
        The plan.
    folder
        Folder that the name of the instance's file of currents is relative to.
    choices
        What the plan leaves open.

    Raises
    ------
    InputError
        If the plan is unsafe, or anything is missing.
    """
    instance = filed.instance
    _require_places(filed)
    plane = _plane(instance, choices.origin)
    depth = _cruising_depth(instance, choices.depth)
    names = _names(len(filed.routes), choices.names)
    filed.require_currents(folder)
    current = stated_current(instance, folder)
    tracks = safe_tracks(filed, folder, current, choices.tolerance)
    vehicles = tuple(
        Vehicle(name, tuple(_waypoints(filed, auv, tracks[auv], current, plane, depth)))
        for auv, name in enumerate(names)
    )
    chosen = vehicles if choices.auv is None else (_chosen(vehicles, choices.auv),)
    for vehicle in chosen:
        require_depths(vehicle.waypoints, instance.fleet.depth_rating)
    return Mission(
        name=instance.name,
        vehicles=chosen,
        nodes=_nodes(filed, names, plane, depth),
        zones=_zones(instance, plane),
        origin=Position(plane.lon, plane.lat),
        speed=instance.fleet.speed,
        depth_rating=instance.fleet.depth_rating,
        departure=_departure(instance, choices.departure),
    )


def _waypoints(
    filed: PlanFile,
    auv: int,
    paths: Sequence[Floats],
    current: Current,
    plane: LocalPlane,
    depth: float,
) -> Iterator[Waypoint]:
    """The waypoints of one AUV, with the times of its arrivals."""
    instance, route = filed.instance, filed.plan.routes[auv]
    service, now = instance.service_times, 0.0
    begin = np.array([(instance.start.x, instance.start.y)])
    yield _waypoint("start", "start", begin[0], _places(plane, begin)[0], 0.0, 0.0)
    for head, path in zip((*route, len(instance.nodes) + 1), paths, strict=True):
        *bends, end = zip(path[1:], _places(plane, path[1:]), strict=True)
        for k, bend in enumerate(bends, start=1):
            now += sailing_time(path[k - 1 : k + 1], current, instance.fleet.speed)
            yield _waypoint("bend", "", *bend, depth, now)
        now += sailing_time(path[-2:], current, instance.fleet.speed)
        if head <= len(instance.nodes):
            node, hold = instance.nodes[head - 1], float(service[head])
            at = depth if node.depth is None else node.depth
            yield _waypoint("node", node.id, *end, at, now, hold)
            now += hold
        else:
            yield _waypoint("destination", "destination", *end, 0.0, now)


def _waypoint(
    kind: Kind,
    name: str,
    spot: Floats,
    place: Position,
    depth: float,
    arrival: float,
    hold: float = 0.0,
) -> Waypoint:
    x, y = spot.tolist()
    return Waypoint(kind, name, place, x, y, depth, hold, arrival)


def _nodes(
    filed: PlanFile, names: Sequence[str], plane: LocalPlane, depth: float
) -> tuple[SensorNode, ...]:
    visitor = {
        node: name for name, route in zip(names, filed.routes, strict=True) for node in route
    }
    nodes = filed.instance.nodes
    return tuple(
        SensorNode(
            node.id,
            place,
            depth if node.depth is None else node.depth,
            node.data,
            visitor.get(node.id),
        )
        for node, place in zip(nodes, _places(plane, filed.instance.points[1:-1]), strict=True)
    )


def _zones(instance: Instance, plane: LocalPlane) -> tuple[Zone, ...]:
    obstacles = [
        _round_zone(shape, plane)
        if isinstance(shape, Circle)
        else Zone("obstacle", _corners(shape, plane))
        for shape in instance.ocean.obstacles
    ]
    land = [Zone("land", _corners(shape, plane)) for shape in instance.ocean.land]
    return (*obstacles, *land)


def _round_zone(shape: Circle, plane: LocalPlane) -> Zone:
    """A circle and the polygon around it."""
    angles = 2.0 * np.pi * np.arange(_CORNERS) / _CORNERS
    reach = shape.radius / np.cos(np.pi / _CORNERS)
    around = reach * np.column_stack((np.cos(angles), np.sin(angles)))
    middle = np.array([(shape.x, shape.y)])
    centre, *places = _places(plane, np.vstack((middle, middle + around)))
    return Zone("obstacle", tuple(places), centre, shape.radius)


def _corners(shape: Polygon, plane: LocalPlane) -> tuple[Position, ...]:
    corners = np.array(shape.polygon)
    x, y = (corners - corners[0]).T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return tuple(_places(plane, corners[::-1] if area < 0.0 else corners))


def _places(plane: LocalPlane, points: Floats) -> list[Position]:
    """Where points in metres, shape (k, 2), are on Earth."""
    lon, lat = plane.unproject(*points.T)
    return [Position(*place) for place in zip(lon.tolist(), lat.tolist(), strict=True)]


def _require_places(filed: PlanFile) -> None:
    """Refuse plans that are not made of metres, or of other nodes than their instance's."""
    if filed.instance.metric != "euclidean":
        raise InputError(
            "does not measure metres on a map; only plans of the metric 'euclidean' are exported",
            field="instance.metric",
            value=filed.instance.metric,
        )
    strangers = filed.vertex_names[len(filed.instance.nodes) + 2 :]
    if strangers:
        raise InputError(
            "is no node of the instance; plan it again", field="routes", value=strangers[0]
        )


def _plane(instance: Instance, origin: tuple[float, float] | None) -> LocalPlane:
    stated = instance.origin
    if stated is not None and origin is not None and stated != origin:
        raise InputError(
            f"contradicts the plan, whose origin is {stated[0]:.10g},{stated[1]:.10g}; "
            "leave it out",
            field="--origin",
            value=origin,
        )
    chosen = stated if stated is not None else origin
    if chosen is None:
        raise InputError(
            "is null: the plan does not say where on Earth its metres are; pass --origin LON,LAT",
            field="instance.crs",
        )
    return LocalPlane(*chosen)


def _cruising_depth(instance: Instance, depth: float | None) -> float:
    chosen = instance.fleet.depth if depth is None else depth
    if chosen is None:
        raise InputError(
            "is missing: the plan does not say how deep to cruise; pass --depth D in metres "
            "(0 is the surface)",
            field="instance.fleet.depth",
        )
    return chosen


def _names(size: int, stated: tuple[str, ...]) -> tuple[str, ...]:
    if not stated:
        return tuple(f"auv-{auv}" for auv in range(1, size + 1))
    if len(stated) != size:
        raise InputError(
            f"must be given {size} times, once for every AUV", field="--vehicle", value=len(stated)
        )
    for i, name in enumerate(stated):
        if not re.fullmatch(_NAMES, name) or name in stated[:i]:
            raise InputError(
                "must be a name of its own, of letters, digits, '_', '-' and '.'",
                field="--vehicle",
                value=name,
            )
    return stated


def _chosen(vehicles: tuple[Vehicle, ...], auv: int) -> Vehicle:
    if not 1 <= auv <= len(vehicles):
        raise InputError(
            f"is no AUV of the plan; there are {len(vehicles)}", field="--auv", value=auv
        )
    return vehicles[auv - 1]


def _departure(instance: Instance, stated: datetime | None) -> datetime | None:
    """When the fleet leaves, in UTC; a year of four digits, of which more follow."""
    leaves = stated or _beginning(instance)
    if leaves is None:
        return None
    if not _FIRST_YEAR <= leaves.year <= _LAST_YEAR:
        raise InputError(
            f"must lie in the years {_FIRST_YEAR} to {_LAST_YEAR}",
            field="departure",
            value=leaves.isoformat(),
        )
    return leaves.replace(tzinfo=UTC) if leaves.tzinfo is None else leaves.astimezone(UTC)


def _beginning(instance: Instance) -> datetime | None:
    begin = instance.ocean.currents.begin
    if begin is None:
        return None
    try:
        moment = np.datetime64(begin.removesuffix("Z"), "us").item()
    except ValueError:
        raise InputError(
            "is no time; write 2016-01-31T12:00", field="ocean.currents.begin", value=begin
        ) from None
    return moment if isinstance(moment, datetime) else None
