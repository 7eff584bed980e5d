"""KML 2.2 for Google Earth and others: one file for the fleet, a folder an AUV.

An AUV is a line at its depths; with a known departure it is a ``gx:Track`` too, which plays
back. Altitudes are absolute, the depths negated. Nodes are points, closed zones polygons, and
their ``ExtendedData`` is what the reader of nodes understands.

References
----------
Open Geospatial Consortium, "OGC KML 2.2", OGC 07-147r2 (2008); Google, "KML Reference" (gx).
"""

from __future__ import annotations

from xml.etree import ElementTree

from fiveroute.vehicle_files.mission import Mission, Position, SensorNode, Vehicle, Zone
from fiveroute.vehicle_files.spelling import child, degrees, metres, require, xml_text

__all__ = ["check", "write"]

_NAMESPACE = "http://www.opengis.net/kml/2.2"
_GX = "http://www.google.com/kml/ext/2.2"

Element = ElementTree.Element


def write(mission: Mission) -> dict[str, str]:
    """The fleet in one file."""
    root = ElementTree.Element("kml", {"xmlns": _NAMESPACE, "xmlns:gx": _GX})
    document = child(root, "Document")
    child(document, "name", mission.name)
    for vehicle in mission.vehicles:
        _add_vehicle(document, mission, vehicle)
    nodes = _folder(document, "nodes")
    if mission.vehicles:
        points = mission.vehicles[0].waypoints
        for end in (points[0], points[-1]):
            _add_point(nodes, end.name, end.place, 0.0, {"kind": end.kind})
    for node in mission.nodes:
        _add_node(nodes, node)
    zones = _folder(document, "zones")
    for zone in mission.zones:
        _add_zone(zones, zone)
    return {"mission.kml": xml_text(root)}


def check(files: dict[str, str]) -> None:
    """Refuse positions that are not on Earth or above the water, and tracks out of step."""
    for text in files.values():
        root = ElementTree.fromstring(text)
        for coordinates in root.iter(f"{{{_NAMESPACE}}}coordinates"):
            for position in (coordinates.text or "").split():
                lon, lat, altitude = map(float, position.split(","))
                require(abs(lon) <= 180.0 and abs(lat) <= 90.0, "is not on Earth", (lon, lat))
                require(altitude <= 0.0, "must be below the surface", altitude)
        for track in root.iter(f"{{{_GX}}}Track"):
            whens = len(track.findall(f"{{{_NAMESPACE}}}when"))
            require(whens == len(track.findall(f"{{{_GX}}}coord")), "each place needs its time")


def _add_vehicle(document: Element, mission: Mission, vehicle: Vehicle) -> None:
    folder = _folder(document, vehicle.name)
    line = child(_placemark(folder, vehicle.name, {"kind": "route"}), "LineString")
    child(line, "altitudeMode", "absolute")
    places = [_position(point.place, point.depth) for point in vehicle.waypoints]
    child(line, "coordinates", " ".join(places))
    if mission.departure is None:
        return
    track = child(_placemark(folder, f"{vehicle.name} in time", {"kind": "route"}), "gx:Track")
    child(track, "altitudeMode", "absolute")
    stops = [
        (mission.moment(seconds), _position(point.place, point.depth).replace(",", " "))
        for point in vehicle.waypoints
        for seconds in dict.fromkeys((point.arrival, point.arrival + point.hold))
    ]
    for when, _ in stops:
        child(track, "when", when)
    for _, place in stops:
        child(track, "gx:coord", place)


def _add_node(folder: Element, node: SensorNode) -> None:
    told = {"kind": "node", "data": repr(node.data), "depth": metres(node.depth)}
    _add_point(folder, node.name, node.place, node.depth, told | {"auv": node.vehicle or ""})


def _add_point(
    folder: Element, name: str, place: Position, depth: float, told: dict[str, str]
) -> None:
    point = child(_placemark(folder, name, told), "Point")
    child(point, "altitudeMode", "absolute")
    child(point, "coordinates", _position(place, depth))


def _add_zone(folder: Element, zone: Zone) -> None:
    polygon = child(_placemark(folder, zone.kind, {"kind": zone.kind}), "Polygon")
    ring = child(child(polygon, "outerBoundaryIs"), "LinearRing")
    corners = (*zone.corners, zone.corners[0])
    child(ring, "coordinates", " ".join(_position(corner, 0.0) for corner in corners))


def _folder(parent: Element, name: str) -> Element:
    folder = child(parent, "Folder")
    child(folder, "name", name)
    return folder


def _placemark(folder: Element, name: str, told: dict[str, str]) -> Element:
    placemark = child(folder, "Placemark")
    child(placemark, "name", name)
    data = child(placemark, "ExtendedData")
    for key, value in told.items():
        child(child(data, "Data", attributes={"name": key}), "value", value)
    return placemark


def _position(place: Position, depth: float) -> str:
    return f"{degrees(place.lon)},{degrees(place.lat)},{metres(0.0 - depth)}"
