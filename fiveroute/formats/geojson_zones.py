"""Zones, that is obstacles and land, from GeoJSON and out again.

GeoJSON (RFC 7946) knows longitude and latitude only; by the prior arrangement that its section 4
allows, positions here are local metres, x east and y north, as everywhere in an instance.

- A ``Polygon`` is a zone, and so is every part of a ``MultiPolygon``. One with holes is cut into
  parts without (`fiveroute.formats.holes`). Altitudes are dropped.
- A ``Point`` with the property ``radius``, in metres, is a round obstacle.
- The property ``kind`` says ``obstacle`` or ``land``; without it a zone is an obstacle. Other
  properties are left alone, and not kept.

Rings are read in either sense of rotation and written anticlockwise, as RFC 7946 asks.

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
from fiveroute.formats.holes import anticlockwise, without_holes
from fiveroute.formats.json_document import parsed
from fiveroute.instance import Circle, Ocean, Polygon

__all__ = ["read", "write"]

_KINDS = ("obstacle", "land")


def read(text: str) -> Ocean:
    """Read zones.

    Parameters
    ----------
    text
        A FeatureCollection.

    Returns
    -------
    Ocean
        Its obstacles and land, in their order; without currents.

    Raises
    ------
    InputError
        If the text is no such document; it names the feature and the rule.
    """
    obstacles: list[Circle | Polygon] = []
    land: list[Polygon] = []
    for i, feature in enumerate(_features(text)):
        where = f"features[{i}]"
        kind = _kind(feature, where)
        for zone in _zones(feature, where):
            if kind == "obstacle":
                obstacles.append(zone)
            elif isinstance(zone, Polygon):
                land.append(zone)
            else:
                raise _fault("land must be a polygon; draw one, or make it an obstacle", where)
    return Ocean(obstacles=tuple(obstacles), land=tuple(land))


def write(ocean: Ocean) -> str:
    """Write the obstacles and the land of an ocean, a feature a line."""
    zones = [("obstacle", zone) for zone in ocean.obstacles]
    features = [_feature(kind, zone) for kind, zone in [*zones, *(("land", p) for p in ocean.land)]]
    lines = ",\n".join(json.dumps(feature, allow_nan=False) for feature in features)
    return f'{{"type": "FeatureCollection", "features": [\n{lines}\n]}}\n'


def _features(text: str) -> list[dict[str, Any]]:
    """The features of a document, each a JSON object that says so."""
    document = parsed(text)
    if not isinstance(document, dict) or document.get("type") != "FeatureCollection":
        raise InputError('must be GeoJSON that says "type": "FeatureCollection"')
    if document.get("crs") is not None:
        raise _fault("only local metres are supported; project the file", "crs", document["crs"])
    features = document.get("features")
    if not isinstance(features, list):
        raise _fault("must be a list of features", "features", features)
    for i, feature in enumerate(features):
        if not isinstance(feature, dict) or feature.get("type") != "Feature":
            raise _fault('must be an object that says "type": "Feature"', f"features[{i}]", feature)
    return features


def _kind(feature: dict[str, Any], where: str) -> str:
    properties = feature.get("properties")
    if properties is not None and not isinstance(properties, dict):
        raise _fault("must be an object or null", f"{where}.properties", properties)
    kind = (properties or {}).get("kind", "obstacle")
    if kind not in _KINDS:
        raise _fault(f"must be one of {', '.join(_KINDS)}", f"{where}.properties.kind", kind)
    return str(kind)


def _zones(feature: dict[str, Any], where: str) -> Iterator[Circle | Polygon]:
    """The zones of one feature."""
    geometry = feature.get("geometry")
    if not isinstance(geometry, dict):
        raise _fault("must be an object; a zone needs a place", f"{where}.geometry", geometry)
    kind, place = geometry.get("type"), geometry.get("coordinates")
    where_place = f"{where}.geometry.coordinates"
    if kind == "Point":
        x, y = _position(place, where_place)
        yield Circle(x, y, _radius(feature, where))
    elif kind == "Polygon":
        yield from _polygons(place, where_place)
    elif kind == "MultiPolygon":
        for i, part in enumerate(_list(place, where_place)):
            yield from _polygons(part, f"{where_place}[{i}]")
    else:
        raise _fault(
            "must be Polygon, MultiPolygon, or Point with a radius", f"{where}.geometry.type", kind
        )


def _radius(feature: dict[str, Any], where: str) -> float:
    radius = (feature.get("properties") or {}).get("radius")
    if radius is None or not _is_finite(radius) or radius <= 0.0:
        raise _fault(
            "a Point needs a radius in metres above 0", f"{where}.properties.radius", radius
        )
    return float(radius)


def _polygons(rings: object, where: str) -> Iterator[Polygon]:
    """The parts of a polygon without its holes."""
    outer, *holes = (
        _ring(ring, f"{where}[{k}]") for k, ring in enumerate(_list(rings, where) or [None])
    )
    for part in without_holes(outer, holes, where):
        yield Polygon(part)


def _ring(ring: object, where: str) -> tuple[tuple[float, float], ...]:
    """The corners of a closed ring, the last of which repeats the first."""
    corners = [
        _position(position, f"{where}[{i}]") for i, position in enumerate(_list(ring, where))
    ]
    if len(corners) < 4 or corners[0] != corners[-1]:
        raise _fault(
            "a ring needs four positions at least, the last the same as the first", where, corners
        )
    return tuple(corners[:-1])


def _position(value: object, where: str) -> tuple[float, float]:
    numbers = _list(value, where)
    if len(numbers) not in (2, 3) or not all(map(_is_finite, numbers)):
        raise _fault("a position must be two finite numbers, x and y", where, value)
    return float(numbers[0]), float(numbers[1])


def _list(value: object, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise _fault("must be a list", where, value)
    return value


def _is_finite(value: object) -> bool:
    """Whether a JSON value is a number that a float can hold."""
    try:
        return type(value) in (int, float) and math.isfinite(value)  # type: ignore[arg-type]
    except OverflowError:
        return False


def _fault(rule: str, field: str, value: object = None) -> InputError:
    return InputError(rule, field=field, value=value)


def _feature(kind: str, zone: Circle | Polygon) -> dict[str, Any]:
    properties: dict[str, Any] = {"kind": kind}
    if isinstance(zone, Circle):
        geometry: dict[str, Any] = {"type": "Point", "coordinates": (zone.x, zone.y)}
        properties["radius"] = zone.radius
    else:
        corners = anticlockwise(zone.polygon)
        geometry = {"type": "Polygon", "coordinates": [[*corners, corners[0]]]}
    return {"type": "Feature", "properties": properties, "geometry": geometry}
