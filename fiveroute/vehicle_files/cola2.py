"""Missions of COLA2, the architecture of Sparus II and the Girona vehicles: XML, a file an AUV.

The AUV goes to every waypoint at its depth (``goto``), and parks at nodes as long as they take
(``park``). It keeps to the depth (heave mode 0) and goes up where it does not know its altitude.

References
----------
N. Palomeras, A. El-Fakdi, M. Carreras and P. Ridao, "COLA2: a control architecture for AUVs",
IEEE Journal of Oceanic Engineering 37 (2012), doi 10.1109/JOE.2012.2205638.
"""

from __future__ import annotations

from xml.etree import ElementTree

from fiveroute.vehicle_files.mission import Mission, Waypoint
from fiveroute.vehicle_files.spelling import (
    child,
    degrees,
    metres,
    require,
    whole_seconds,
    xml_text,
)

__all__ = ["check", "write"]

_TOLERANCE = 2.0  # metres from a waypoint at which it is reached

_GOTO = (
    "final_latitude",
    "final_longitude",
    "final_depth",
    "final_altitude",
    "heave_mode",
    "surge_velocity",
    "no_altitude_goes_up",
    "tolerance_xy",
)
_PARK = (*_GOTO[:-1], "final_yaw", "use_yaw", "time")


def write(mission: Mission) -> dict[str, str]:
    """A mission for every AUV."""
    files = {}
    for vehicle in mission.vehicles:
        root = ElementTree.Element("mission")
        child(root, "version", "2.0")
        for point in vehicle.waypoints[1:]:
            _add_step(root, point, mission.speed, stays=False)
            if point.hold:
                _add_step(root, point, mission.speed, stays=True)
        files[f"{vehicle.name}.xml"] = xml_text(root)
    return files


def check(files: dict[str, str]) -> None:
    """Refuse missions in which COLA2 would miss anything."""
    for text in files.values():
        steps = ElementTree.fromstring(text).findall("mission_step/maneuver")
        require(bool(steps), "a mission has one step at least")
        for step in steps:
            wanted = {"goto": _GOTO, "park": _PARK}[step.attrib["type"]]
            values = {part.tag: part.text or "" for part in step}
            require(set(values) == set(wanted), "must have all tags of its kind", sorted(values))
            lat, lon = float(values["final_latitude"]), float(values["final_longitude"])
            require(abs(lat) <= 90.0 and abs(lon) <= 180.0, "is not on Earth", (lat, lon))
            require(float(values["final_depth"]) >= 0.0, "depth is positive down")
            require(float(values["surge_velocity"]) > 0.0, "the speed must be above 0 m/s")
            require(float(values.get("time", "1")) > 0.0, "a stay takes some time")


def _add_step(root: ElementTree.Element, point: Waypoint, speed: float, *, stays: bool) -> None:
    values = {
        "final_latitude": degrees(point.place.lat),
        "final_longitude": degrees(point.place.lon),
        "final_depth": metres(point.depth),
        "final_altitude": "0.0",
        "heave_mode": "0",
        "surge_velocity": metres(speed),
        "no_altitude_goes_up": "true",
        "tolerance_xy": metres(_TOLERANCE),
        "final_yaw": "0.0",
        "use_yaw": "false",
        "time": str(whole_seconds(point.hold)),
    }
    step = child(root, "mission_step")
    maneuver = child(step, "maneuver", attributes={"type": "park" if stays else "goto"})
    for tag in _PARK if stays else _GOTO:
        child(maneuver, tag, values[tag])
