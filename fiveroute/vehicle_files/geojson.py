"""GeoJSON: one file for the fleet, for QGIS and everything else that draws maps.

Every AUV is a line, every node a point, every closed zone a polygon; ``kind`` says what is what.
Positions are longitude, latitude and altitude, the depth negated. A line that crosses the
180th meridian is cut there into two, as RFC 7946 asks (section 3.1.9).

References
----------
H. Butler et al., "The GeoJSON format", RFC 7946 (2016), doi 10.17487/RFC7946.
"""

from __future__ import annotations

import json
from itertools import pairwise
from typing import Any

from fiveroute.vehicle_files.mission import Mission, Position, SensorNode, Vehicle, Zone
from fiveroute.vehicle_files.spelling import require

__all__ = ["check", "write"]

Coordinates = list[float]


def write(mission: Mission) -> dict[str, str]:
    """The fleet in one file, a feature a line."""
    ends = [] if not mission.vehicles else _ends(mission.vehicles[0])
    features = [
        *(_route(mission, vehicle) for vehicle in mission.vehicles),
        *ends,
        *(_node(node) for node in mission.nodes),
        *(_zone(zone) for zone in mission.zones),
    ]
    lines = ",\n".join(json.dumps(feature, allow_nan=False) for feature in features)
    head = json.dumps(mission.name)
    return {
        "mission.geojson": (
            f'{{"type": "FeatureCollection", "name": {head}, "features": [\n{lines}\n]}}\n'
        )
    }


def check(files: dict[str, str]) -> None:
    """Refuse positions that are not on Earth or above the water, and lines round the world."""
    for text in files.values():
        for feature in json.loads(text)["features"]:
            geometry = feature["geometry"]
            lines = _lines(geometry["type"], geometry["coordinates"])
            for line in lines:
                for lon, lat, *altitude in line:
                    require(abs(lon) <= 180.0 and abs(lat) <= 90.0, "is not on Earth", (lon, lat))
                    require(all(z <= 0.0 for z in altitude), "must be below the surface", altitude)
                if geometry["type"] != "Polygon":
                    jumps = any(abs(b[0] - a[0]) > 180.0 for a, b in pairwise(line))
                    require(not jumps, "a line must be cut at the 180th meridian")


def _lines(kind: str, coordinates: Any) -> list[list[Coordinates]]:
    """The lines of a geometry; a point is a short one."""
    if kind == "Point":
        return [[coordinates]]
    lines: list[list[Coordinates]] = [coordinates] if kind == "LineString" else coordinates
    return lines


def _route(mission: Mission, vehicle: Vehicle) -> dict[str, Any]:
    points = vehicle.waypoints
    parts = _cut([_coordinates(point.place, point.depth) for point in points])
    return _feature(
        "LineString" if len(parts) == 1 else "MultiLineString",
        parts[0] if len(parts) == 1 else parts,
        kind="route",
        name=vehicle.name,
        speed=mission.speed,
        duration=round(points[-1].arrival, 1),
        nodes=[point.name for point in points if point.kind == "node"],
        arrivals=[mission.moment(p.arrival) or round(p.arrival, 1) for p in points],
        stays=[round(point.hold, 3) for point in points],
    )


def _ends(vehicle: Vehicle) -> list[dict[str, Any]]:
    """Start and destination, which all AUVs share."""
    return [
        _feature("Point", _coordinates(point.place, 0.0), kind=point.kind, name=point.name)
        for point in (vehicle.waypoints[0], vehicle.waypoints[-1])
    ]


def _node(node: SensorNode) -> dict[str, Any]:
    return _feature(
        "Point",
        _coordinates(node.place, node.depth),
        kind="node",
        name=node.name,
        data=node.data,
        depth=node.depth,
        auv=node.vehicle,
    )


def _zone(zone: Zone) -> dict[str, Any]:
    if zone.centre is not None:
        place = _coordinates(zone.centre, 0.0)[:2]
        return _feature("Point", place, kind=zone.kind, radius=zone.radius)
    ring = [_coordinates(corner, 0.0)[:2] for corner in (*zone.corners, zone.corners[0])]
    return _feature("Polygon", [ring], kind=zone.kind)


def _feature(geometry: str, coordinates: object, **properties: object) -> dict[str, Any]:
    return {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": geometry, "coordinates": coordinates},
    }


def _coordinates(place: Position, depth: float) -> Coordinates:
    return [round(place.lon, 8), round(place.lat, 8), 0.0 - round(depth, 3)]


def _cut(line: list[Coordinates]) -> list[list[Coordinates]]:
    """A line in parts, cut where it crosses the 180th meridian."""
    parts = [[line[0]]]
    for (lon0, lat0, z0), (lon1, lat1, z1) in pairwise(line):
        if abs(lon1 - lon0) > 180.0:
            edge = 180.0 if lon0 > 0.0 else -180.0
            span = lon1 + 2.0 * edge - lon0
            share = (edge - lon0) / span if span else 0.0
            lat, z = lat0 + share * (lat1 - lat0), z0 + share * (z1 - z0)
            parts[-1].append([edge, lat, z])
            parts.append([[-edge, lat, z]])
        parts[-1].append([lon1, lat1, z1])
    return parts
