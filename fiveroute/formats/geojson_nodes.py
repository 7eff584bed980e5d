"""Nodes and zones from GeoJSON: longitude and latitude on WGS84, as RFC 7946 has it.

A ``Point``, or a ``MultiPoint`` of one, is a node, with the properties ``id`` or ``name``,
``data``, ``service_time`` and ``depth``, or minus its altitude where that is below zero. A
``Polygon`` is a zone, with its holes, and so is every part of a ``MultiPolygon``; ``kind`` says
``land`` or ``obstacle``, which it is without one. A ``Point`` with a ``radius`` in metres is a
round obstacle. Lines of the ``kind`` route are no nodes.

References
----------
H. Butler et al., "The GeoJSON format", RFC 7946 (2016), doi 10.17487/RFC7946.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

from fiveroute.errors import InputError
from fiveroute.formats.chart_fields import area_kind, fields_of, ring, site_of
from fiveroute.formats.json_document import parsed
from fiveroute.formats.survey import Area, Site, Spot, Survey, require_on_earth

__all__ = ["read"]


def read(text: str) -> Survey:
    """Read nodes and zones.

    Raises
    ------
    InputError
        If the text is no such document; it names the feature.
    """
    sites: list[Site] = []
    areas: list[Area] = []
    for i, feature in enumerate(_features(text)):
        for thing in _things(feature, f"features[{i}]"):
            if isinstance(thing, Site):
                sites.append(thing)
            else:
                areas.append(thing)
    return Survey(True, tuple(sites), tuple(areas))


def _features(text: str) -> list[Any]:
    document = parsed(text)
    kind = document.get("type") if isinstance(document, dict) else None
    if kind == "Feature":
        return [document]
    if kind != "FeatureCollection" or not isinstance(document.get("features"), list):
        raise InputError('must be GeoJSON that says "type": "FeatureCollection"')
    _require_wgs84(document.get("crs"))
    features: list[Any] = document["features"]
    return features


def _require_wgs84(crs: object) -> None:
    """The old key for other coordinates may only say what is the rule now."""
    if crs is not None and not any(sign in json.dumps(crs) for sign in ("CRS84", "4326")):
        raise InputError(
            "must be WGS84; save the file with longitudes and latitudes", field="crs", value=crs
        )


def _things(feature: object, where: str) -> Iterator[Site | Area]:
    if not isinstance(feature, dict) or feature.get("type") != "Feature":
        raise InputError('must be an object that says "type": "Feature"', field=where)
    told, geometry = feature.get("properties") or {}, feature.get("geometry")
    if not isinstance(told, dict) or not isinstance(geometry, dict):
        raise InputError("must have a geometry, and properties that are an object", field=where)
    if "id" in feature and "id" not in told:
        told = {"id": feature["id"], **told}
    values = _values(told, f"{where}.properties")
    kind, place = geometry.get("type"), geometry.get("coordinates")
    at = f"{where}.geometry.coordinates"
    if kind == "MultiPoint" and isinstance(place, list) and len(place) == 1:
        kind, place = "Point", place[0]  # as QGIS likes to save points
    if kind == "Point":
        yield _point(place, values, at, where)
    elif kind in ("Polygon", "MultiPolygon"):
        for rings in [place] if kind == "Polygon" else _list(place, at):
            yield _polygon(rings, values, at)
    elif (values.get("kind") or "").lower() != "route":
        raise InputError(
            "must be Point, MultiPoint of one, Polygon or MultiPolygon; remove the feature, or "
            "say kind: route",
            field=f"{where}.geometry.type",
            value=kind,
        )


def _values(told: dict[str, Any], where: str) -> dict[str, str | None]:
    """The texts of our fields."""
    try:
        found = fields_of(told)
    except InputError as error:
        raise InputError(error.rule, value=error.value, field=where) from None
    values = {field: told[name] for field, name in found.items()}
    for field, value in values.items():
        if value is not None and not isinstance(value, (str, int, float)):
            raise InputError(
                "must be text or a number", field=f"{where}.{found[field]}", value=value
            )
    return {field: None if value is None else str(value) for field, value in values.items()}


def _point(place: object, values: dict[str, str | None], at: str, where: str) -> Site | Area:
    lon, lat, *altitude = _position(place, at)
    radius = values.get("radius")
    if radius is not None:
        size = _finite(radius)
        if size is None or size <= 0.0:
            raise InputError(
                "must be metres above 0", field=f"{where}.properties.radius", value=radius
            )
        if area_kind(values.get("kind"), f"{where}.properties.kind") == "land":
            raise InputError(
                "land must be a polygon; draw one, or make it an obstacle", field=where
            )
        return Area("obstacle", (require_on_earth(lon, lat, at),), size)
    if not values.get("depth") and altitude and altitude[0] < 0.0:
        values["depth"] = repr(-altitude[0])
    return site_of(values, (lon, lat), geographic=True, where=f"{where}.")


def _polygon(rings: object, values: dict[str, str | None], at: str) -> Area:
    outer, *holes = (_ring(ring, at) for ring in _list(rings, at) or [None])
    return Area(area_kind(values.get("kind"), at), outer, holes=tuple(holes), where=at)


def _ring(positions: object, at: str) -> tuple[Spot, ...]:
    corners = (_position(position, at) for position in _list(positions, at))
    return ring([require_on_earth(lon, lat, at) for lon, lat, *_ in corners], at)


def _position(value: object, where: str) -> list[float]:
    numbers = _list(value, where)
    finite = [_finite(part) if type(part) in (int, float) else None for part in numbers]
    if len(numbers) not in (2, 3) or None in finite:
        raise InputError("a position must be two or three finite numbers", field=where, value=value)
    return [part for part in finite if part is not None]


def _list(value: object, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise InputError("must be a list", field=where, value=value)
    return value


def _finite(value: Any) -> float | None:
    try:
        result = float(value)
    except (ValueError, OverflowError):
        return None
    return result if math.isfinite(result) else None
