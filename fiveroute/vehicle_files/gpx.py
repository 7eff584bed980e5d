"""GPX 1.1: sensor nodes as waypoints, and a route an AUV; one file for the fleet.

Depths are negative elevations. Times are written where the departure is known. Chart plotters
and OpenCPN read it.

References
----------
TopoGrafix, "GPX 1.1 Schema Documentation" (2004).
"""

from __future__ import annotations

from xml.etree import ElementTree

from fiveroute.vehicle_files.mission import Mission, Position
from fiveroute.vehicle_files.spelling import child, degrees, metres, require, xml_text

__all__ = ["check", "write"]

_NAMESPACE = "http://www.topografix.com/GPX/1/1"
_ORDER = ("ele", "time", "name", "desc", "type")  # as the schema wants it

Element = ElementTree.Element


def write(mission: Mission) -> dict[str, str]:
    """The fleet in one file."""
    attributes = {"version": "1.1", "creator": "fiveroute", "xmlns": _NAMESPACE}
    root = ElementTree.Element("gpx", attributes)
    child(child(root, "metadata"), "name", mission.name)
    for node in mission.nodes:
        told = f"data {node.data:g}, {node.vehicle or 'not visited'}"
        _add_point(root, "wpt", node.place, node.depth, None, node.name, told, "node")
    for vehicle in mission.vehicles:
        route = child(root, "rte")
        child(route, "name", vehicle.name)
        for point in vehicle.waypoints:
            stay = f"stay {point.hold:g} s" if point.hold else None
            when = mission.moment(point.arrival)
            _add_point(route, "rtept", point.place, point.depth, when, point.name, stay, point.kind)
    return {"mission.gpx": xml_text(root)}


def check(files: dict[str, str]) -> None:
    """Refuse files that break the schema."""
    for text in files.values():
        root = ElementTree.fromstring(text)
        spot = f"{{{_NAMESPACE}}}"
        require(root.tag == f"{spot}gpx" and root.attrib["version"] == "1.1", "must be GPX 1.1")
        points = [*root.iter(f"{spot}wpt"), *root.iter(f"{spot}rtept")]
        for point in points:
            lat, lon = float(point.attrib["lat"]), float(point.attrib["lon"])
            require(abs(lat) <= 90.0 and abs(lon) <= 180.0, "is not on Earth", (lat, lon))
            places = [_ORDER.index(part.tag.removeprefix(spot)) for part in point]
            require(places == sorted(places), "elements must be in the order of the schema")
            require(float(point.findtext(f"{spot}ele", "nan")) <= 0.0, "must be below the surface")


def _add_point(
    parent: Element,
    tag: str,
    place: Position,
    depth: float,
    when: str | None,
    name: str,
    told: str | None,
    kind: str,
) -> None:
    point = child(parent, tag, attributes={"lat": degrees(place.lat), "lon": degrees(place.lon)})
    values = (metres(0.0 - depth), when, name or None, told, kind)
    for key, value in zip(_ORDER, values, strict=True):
        if value is not None:
            child(point, key, value)
