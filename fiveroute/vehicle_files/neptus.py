"""Missions of LSTS Neptus: one archive for the fleet, with a plan for every AUV.

The archive holds ``mission.nmis``, whose plans are graphs of manoeuvres, and ``maps/map.nmap``,
whose marks are the sensor nodes. A plan begins at the one node that says so, and leads from
each manoeuvre to the next when it is done: ``Goto`` for a waypoint, and ``StationKeeping`` after
it where the AUV stays. The layout is that of the files that Neptus writes; its XML schema is
older than they are.

References
----------
P. S. Dias et al., "Neptus - a framework to support multiple vehicle operation", OCEANS 2005
Europe, doi 10.1109/OCEANSE.2005.1513187.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from xml.etree import ElementTree

from fiveroute.vehicle_files.mission import Mission, Position, Vehicle, Waypoint
from fiveroute.vehicle_files.spelling import (
    child,
    degrees,
    metres,
    require,
    whole_seconds,
    xml_text,
)

__all__ = ["check", "write"]

_MISSION, _MAP = "mission.nmis", "maps/map.nmap"
_TOLERANCE = "2.0"  # metres from a waypoint at which it is reached
_LONGEST = "65535"  # seconds that a manoeuvre may take
_RADIUS = "10.0"  # metres of the circle on which a station is kept

Element = ElementTree.Element


def write(mission: Mission) -> dict[str, str]:
    """The mission and its map."""
    return {_MISSION: xml_text(_mission(mission)), _MAP: xml_text(_map(mission))}


def check(files: dict[str, str]) -> None:
    """Refuse missions whose plans are no chains of manoeuvres."""
    root = ElementTree.fromstring(files[_MISSION])
    hrefs = [element.text for element in root.iterfind("definitions/maps/map/href")]
    require(hrefs == [_MAP], "must name its map", hrefs)
    plans = root.findall("body/plan")
    require(len({plan.attrib["id"] for plan in plans}) == len(plans), "plans need ids of their own")
    for plan in plans:
        nodes, edges = plan.findall("graph/node"), plan.findall("graph/edge")
        names = [node.findtext("id") for node in nodes]
        starts = [node.attrib["start"] for node in nodes]
        require(starts == ["true", *["false"] * (len(nodes) - 1)], "must start at its first node")
        ways = [(edge.findtext("source"), edge.findtext("target")) for edge in edges]
        require(ways == list(pairwise(names)), "edges must lead from node to node")
        guards = {edge.findtext("guard") for edge in edges}
        require(guards <= {"ManeuverIsDone"}, "edges must wait for the manoeuvre", guards)
        require({unit.text for unit in plan.iter("zunits")} == {"DEPTH"}, "must state depths")
        require(all(float(z.text or "-1") >= 0.0 for z in plan.iter("z")), "depth is positive down")
        for duration in plan.iter("duration"):
            require(
                1 <= int(duration.text or "0") <= int(_LONGEST),
                f"Neptus keeps a station for at most {_LONGEST} s; split the service time",
                duration.text,
                "service time",
            )


def _mission(mission: Mission) -> Element:
    root = ElementTree.Element("mission-def")
    header = child(root, "header")
    for tag, text in (
        ("id", "fiveroute"),
        ("name", mission.name),
        ("type", "Test"),
        ("description", "Written by fiveroute"),
    ):
        child(header, tag, text)
    definitions = child(root, "definitions")
    child(definitions, "vehicles")
    chart = child(child(definitions, "maps"), "map")
    for tag, text in (("id", "nodes"), ("name", "nodes"), ("href", _MAP)):
        child(chart, tag, text)
    child(definitions, "checklists")
    home = child(definitions, "home-reference")
    child(home, "id", "home")
    child(home, "name", "home")
    origin = child(home, "origin")
    child(origin, "latitude", _sexagesimal(mission.origin.lat, "NS"))
    child(origin, "longitude", _sexagesimal(mission.origin.lon, "EW"))
    child(origin, "depth", "0.0")
    body = child(root, "body")
    for vehicle in mission.vehicles:
        _add_plan(body, vehicle, mission.speed)
    return root


def _add_plan(body: Element, vehicle: Vehicle, speed: float) -> None:
    plan = child(body, "plan", attributes={"id": vehicle.name, "vehicle": vehicle.name})
    graph = child(plan, "graph")
    names = []
    for k, (point, stays) in enumerate(_manoeuvres(vehicle), start=1):
        names.append(f"{'StationKeeping' if stays else 'Goto'}{k}")
        attributes = {"start": str(k == 1).lower(), "xPos": "0", "yPos": str(60 * (k - 1))}
        node = child(graph, "node", attributes=attributes)
        child(node, "id", names[-1])
        maneuver = child(node, "maneuver")
        child(maneuver, "minTime", "0")
        child(maneuver, "maxTime", _LONGEST)
        (_add_station if stays else _add_goto)(maneuver, point, names[-1], speed)
    for k, (source, target) in enumerate(pairwise(names), start=1):
        edge = child(graph, "edge")
        for tag, text in (("id", f"e{k}"), ("source", source), ("target", target)):
            child(edge, tag, text)
        child(edge, "guard", "ManeuverIsDone")


def _manoeuvres(vehicle: Vehicle) -> Iterator[tuple[Waypoint, bool]]:
    """Every waypoint, and once more where the AUV is to stay."""
    for point in vehicle.waypoints:
        yield point, False
        if point.hold:
            yield point, True


def _add_goto(maneuver: Element, point: Waypoint, name: str, speed: float) -> None:
    goto = child(maneuver, "Goto", attributes={"kind": "automatic"})
    final = child(goto, "finalPoint", attributes={"type": "pointType"})
    _add_point(final, point, name)
    child(final, "radiusTolerance", _TOLERANCE)
    attributes = {"tolerance": "10.0", "type": "float", "unit": "m/s"}
    child(goto, "speed", metres(speed), attributes)
    child(child(goto, "trajectoryTolerance"), "radiusTolerance", _TOLERANCE)


def _add_station(maneuver: Element, point: Waypoint, name: str, speed: float) -> None:
    station = child(maneuver, "StationKeeping", attributes={"kind": "automatic"})
    base = child(station, "basePoint", attributes={"type": "pointType"})
    _add_point(base, point, name)
    child(base, "radiusTolerance", "0")
    child(station, "duration", str(whole_seconds(point.hold)))
    child(station, "popupDuration", "0")
    child(station, "popupPeriod", "0")
    child(station, "keepSafe", "false")
    child(child(station, "trajectory"), "radius", _RADIUS, {"type": "float"})
    child(station, "speed", metres(speed), {"type": "float", "unit": "m/s"})


def _add_point(parent: Element, waypoint: Waypoint, name: str) -> None:
    point = child(parent, "point")
    child(point, "id", name)
    child(point, "name", waypoint.name or name)
    _add_coordinate(point, waypoint.place, "0.0")
    child(point, "z", metres(waypoint.depth))
    child(point, "zunits", "DEPTH")


def _map(mission: Mission) -> Element:
    root = ElementTree.Element("map")
    header = child(root, "header")
    for tag, text in (("id", "nodes"), ("name", "nodes"), ("type", "nodes")):
        child(header, tag, text)
    features = child(root, "features")
    for node in mission.nodes:
        mark = child(features, "mark", attributes={"obstacle": "false"})
        child(mark, "id", node.name)
        child(mark, "name", node.name)
        _add_coordinate(mark, node.place, metres(0.0 - node.depth))
    return root


def _add_coordinate(parent: Element, place: Position, height: str) -> None:
    coordinate = child(parent, "coordinate")
    child(coordinate, "latitude", degrees(place.lat))
    child(coordinate, "longitude", degrees(place.lon))
    child(coordinate, "height", height)


def _sexagesimal(angle: float, hemispheres: str) -> str:
    """An angle as 38N14'45.1300''."""
    minutes, seconds = divmod(round(abs(angle) * 3600.0, 4), 60.0)
    whole, minutes = divmod(minutes, 60.0)
    return f"{whole:.0f}{hemispheres[angle < 0.0]}{minutes:.0f}'{seconds:.4f}''"
