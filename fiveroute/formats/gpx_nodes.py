"""Nodes from GPX: every waypoint is one, with its name; routes and tracks are left alone.

The depth is minus the elevation where that is below zero. GPX has no place for data, so that
every node counts 1, nor for zones.

References
----------
TopoGrafix, "GPX 1.1 Schema Documentation" (2004).
"""

from __future__ import annotations

from xml.etree.ElementTree import Element

from fiveroute.errors import InputError
from fiveroute.formats.chart_fields import parsed_number, site_of
from fiveroute.formats.safe_xml import local_name, named, parse_xml, text_of
from fiveroute.formats.survey import Site, Survey

__all__ = ["read"]


def read(text: str) -> Survey:
    """Read nodes.

    Raises
    ------
    InputError
        If the text is no GPX; it names the waypoint.
    """
    root = parse_xml(text)
    if local_name(root) != "gpx":
        raise InputError("must be a gpx element", value=local_name(root))
    waypoints = enumerate(named(root, "wpt"), start=1)
    return Survey(True, tuple(_site(point, f"waypoint {i}") for i, point in waypoints))


def _site(point: Element, where: str) -> Site:
    lon, lat = (
        parsed_number(point.attrib.get(key, ""), f"{where}, {key}") for key in ("lon", "lat")
    )
    kind = text_of(point, "type")
    values: dict[str, str | None] = {
        "id": text_of(point, "name"),
        "kind": kind if kind == "node" else None,
    }
    elevation = text_of(point, "ele")
    if elevation is not None:
        height = parsed_number(elevation, f"{where}, ele")
        values["depth"] = repr(-height) if height < 0.0 else None
    return site_of(values, (lon, lat), geographic=True, where=f"{where}, ")
