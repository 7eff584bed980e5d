"""Barriers from the obstacles and the land of an instance, and the points that lie in them.

Circles and polygons go to the kernels as they are. A polygon must be simple, as the crossing
numbers that tell its inside from its outside mean nothing for one that crosses itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from fiveroute.errors import InputError
from fiveroute.instance import Circle, Instance, Ocean, Polygon
from fiveroute.ocean.barriers import Barriers, boxed, clearance, no_barriers
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.land_mask import LandDistance
from fiveroute.ocean.simple_polygon import first_conflict

__all__ = ["barriers_of", "refuse_points_inside"]


def barriers_of(
    ocean: Ocean,
    region: Region | None = None,
    *,
    margin: float = 0.0,
    land: LandDistance | None = None,
) -> Barriers:
    """Barriers of an ocean.

    Parameters
    ----------
    ocean
        Its obstacles and its land; its currents are not looked at.
    region
        Where paths must stay; None lets them go anywhere.
    margin
        Safety margin around obstacles and land, in metres.
    land
        Land of a mask, in addition.

    Raises
    ------
    InputError
        If a polygon crosses or touches itself, or the margin is no distance.
    """
    if not 0.0 <= margin < math.inf:
        raise InputError(
            "a safety margin must be a distance in metres, not below 0",
            field="margin",
            value=margin,
        )
    open_water = no_barriers(region)._replace(margin=margin)
    barriers = _with_zones(open_water, dict(_zones(ocean)))
    if land is None:
        return barriers
    distance, west, south, step = land
    return barriers._replace(land=distance, land_west=west, land_south=south, land_step=step)


def refuse_points_inside(instance: Instance, barriers: Barriers) -> None:
    """Make sure that an AUV can be at the start, at every node and at the destination.

    Parameters
    ----------
    instance
        The instance.
    barriers
        Its barriers, from `barriers_of`.

    Raises
    ------
    InputError
        If a point lies in an obstacle, on land, within their margin or outside the region; it
        names the first such point, and what it lies in.
    """
    ends = {"start": instance.start, "destination": instance.destination}
    for field, end in ends.items():
        _refuse_inside(instance.ocean, barriers, end.x, end.y, field, (end.x, end.y))
    for i, node in enumerate(instance.nodes):
        _refuse_inside(instance.ocean, barriers, node.x, node.y, f"nodes[{i}]", node.id)


def _refuse_inside(
    ocean: Ocean, barriers: Barriers, x: float, y: float, field: str, value: object
) -> None:
    """Refuse one point, naming the barrier that it is deepest in."""
    if clearance(barriers, x, y) >= 0.0:
        return
    depths = {name: -clearance(part, x, y) for name, part in _parts(ocean, barriers)}
    name = max(depths, key=lambda name: depths[name])
    if name == "the region":
        rule = f"lies {depths[name]:.1f} m outside the region that paths may use; move it inside"
    else:
        with_margin = f", counting the margin of {barriers.margin:g} m" if barriers.margin else ""
        rule = f"lies {depths[name]:.1f} m inside {name}{with_margin}; move one of them"
    raise InputError(rule, field=field, value=value)


def _parts(ocean: Ocean, barriers: Barriers) -> Iterator[tuple[str, Barriers]]:
    """Every barrier by its name, within the region; this comes first, and so wins a tie."""
    empty = no_barriers()
    mask = barriers._replace(circles=empty.circles, corners=empty.corners, first=empty.first)
    open_water = mask._replace(land=empty.land)
    yield "the region", open_water
    for name, zone in _zones(ocean):
        yield name, _with_zones(open_water, {name: zone})
    yield "the land of the mask", mask


def _zones(ocean: Ocean) -> Iterator[tuple[str, Circle | Polygon]]:
    """Obstacles and land by the names of their fields."""
    for i, obstacle in enumerate(ocean.obstacles):
        yield f"ocean.obstacles[{i}]", obstacle
    for i, polygon in enumerate(ocean.land):
        yield f"ocean.land[{i}]", polygon


def _with_zones(open_water: Barriers, zones: dict[str, Circle | Polygon]) -> Barriers:
    circles = [(zone.x, zone.y, zone.radius) for zone in zones.values() if isinstance(zone, Circle)]
    polygons = {name: zone for name, zone in zones.items() if isinstance(zone, Polygon)}
    for name, polygon in polygons.items():
        _require_simple(name, polygon)
    corners = [corner for polygon in polygons.values() for corner in polygon.polygon]
    counts = [len(polygon.polygon) for polygon in polygons.values()]
    return boxed(
        open_water._replace(
            circles=np.array(circles, dtype=np.float64).reshape(-1, 3),
            corners=np.array(corners, dtype=np.float64).reshape(-1, 2),
            first=np.cumsum([0, *counts], dtype=np.int64),
        )
    )


def _require_simple(name: str, polygon: Polygon) -> None:
    conflict = first_conflict(np.array(polygon.polygon, dtype=np.float64))
    if conflict is not None:
        x, y = conflict
        raise InputError(
            f"is no simple polygon (see the corner {x:.10g}, {y:.10g}); its edges must not "
            "cross or touch one another",
            field=name,
            value=polygon.polygon,
        )
