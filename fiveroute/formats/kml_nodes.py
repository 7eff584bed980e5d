"""Nodes and zones from KML, as Google Earth and QGIS write it.

Every ``Point`` of a placemark is a node, named by the placemark; its depth is minus its altitude
where that is below zero. Every ``Polygon`` is a zone, with its holes. ``ExtendedData`` may say
``data``, ``service_time``, ``depth`` and ``kind``; everything else is left alone, links are never
followed.

References
----------
Open Geospatial Consortium, "OGC KML 2.2", OGC 07-147r2 (2008).
"""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

from fiveroute.errors import InputError
from fiveroute.formats.chart_fields import area_kind, fields_of, parsed_number, ring, site_of
from fiveroute.formats.safe_xml import local_name, named, parse_xml, text_of
from fiveroute.formats.survey import Area, Site, Spot, Survey, require_on_earth

__all__ = ["read"]


def read(text: str) -> Survey:
    """Read nodes and zones.

    Raises
    ------
    InputError
        If the text is no KML; it names the placemark.
    """
    root = parse_xml(text)
    if local_name(root) != "kml":
        raise InputError("must be a kml element", value=local_name(root))
    sites: list[Site] = []
    areas: list[Area] = []
    for i, placemark in enumerate(named(root, "Placemark"), start=1):
        where = f"placemark {i}"
        values = _values(placemark, where)
        sites += [_site(point, values, where) for point in named(placemark, "Point")]
        areas += [_area(polygon, values, where) for polygon in named(placemark, "Polygon")]
    return Survey(True, tuple(sites), tuple(areas))


def _values(placemark: Element, where: str) -> dict[str, str | None]:
    told: dict[str, str | None] = {}
    for data in named(placemark, "Data"):
        told[data.attrib.get("name", "")] = text_of(data, "value")
    for data in named(placemark, "SimpleData"):
        told[data.attrib.get("name", "")] = data.text
    try:
        found = fields_of(told)
    except InputError as error:
        raise InputError(error.rule, value=error.value, field=where) from None
    values = {field: told[name] for field, name in found.items()}
    return values | {"id": text_of(placemark, "name") or values.get("id")}


def _site(point: Element, values: dict[str, str | None], where: str) -> Site:
    positions = list(_positions(point, where))
    if len(positions) != 1:
        raise InputError("a point needs one position", field=where, value=len(positions))
    lon, lat, altitude = positions[0]
    if not values.get("depth") and altitude < 0.0:
        values = values | {"depth": repr(-altitude)}
    return site_of(values, (lon, lat), geographic=True, where=f"{where}, ")


def _area(polygon: Element, values: dict[str, str | None], where: str) -> Area:
    outer = next(named(polygon, "outerBoundaryIs"), polygon)
    inner = (hole for by in named(polygon, "innerBoundaryIs") for hole in named(by, "LinearRing"))
    return Area(
        area_kind(values.get("kind"), where),
        _ring(outer, where),
        holes=tuple(_ring(hole, where) for hole in inner),
        where=where,
    )


def _ring(boundary: Element, where: str) -> tuple[Spot, ...]:
    positions = _positions(boundary, where)
    return ring([require_on_earth(lon, lat, where) for lon, lat, _ in positions], where)


def _positions(geometry: Element, where: str) -> Iterator[tuple[float, float, float]]:
    """Longitude, latitude and altitude of every position of a geometry."""
    for coordinates in named(geometry, "coordinates"):
        for position in (coordinates.text or "").split():
            numbers = [parsed_number(part, where) for part in position.split(",")]
            if len(numbers) not in (2, 3):
                raise InputError(
                    "a position is longitude,latitude or longitude,latitude,altitude, without "
                    "blanks in it",
                    field=where,
                    value=position,
                )
            lon, lat, *altitude = numbers
            yield lon, lat, altitude[0] if altitude else 0.0
