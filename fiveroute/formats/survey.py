"""Nodes and zones as charts and tables hold them, and the mission that they become.

A chart of nodes says where they are, and perhaps what they hold; it knows no fleet. `Terms` adds
what is missing. Longitudes and latitudes meet the planner's metres in the azimuthal equidistant
plane about the middle of the chart (`fiveroute.ocean.local_plane`), which the instance keeps as
its ``crs``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeVar

import numpy as np

from fiveroute.errors import InputError
from fiveroute.formats.holes import without_holes
from fiveroute.instance import Circle, Currents, Fleet, Instance, Node, Ocean, Point, Polygon
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.simple_polygon import first_conflict

__all__ = ["Area", "Site", "Spot", "Survey", "Terms", "require_on_earth"]

T = TypeVar("T")

_FARTHEST = 500e3  # metres from the middle, where lengths err by 0.1 %

Spot = tuple[float, float]
"""Longitude and latitude in degrees, or x and y in metres."""


@dataclass(frozen=True, slots=True)
class Site:
    """A point of a chart.

    Parameters
    ----------
    name
        Its name; nothing leaves it to its number in the chart.
    spot
        Where it is.
    data, service_time, depth
        See `fiveroute.instance.Node`; None where the chart does not say.
    end
        Whether it is no node, but where the fleet is released or recovered.
    """

    name: str
    spot: Spot
    data: float | None = None
    service_time: float | None = None
    depth: float | None = None
    end: Literal["start", "destination"] | None = None


@dataclass(frozen=True, slots=True)
class Area:
    """A closed zone of a chart.

    Parameters
    ----------
    kind
        ``obstacle`` or ``land``.
    corners
        Its corners, or the centre alone of a round one.
    radius
        Of a round one, in metres.
    holes
        Corners of its holes.
    where
        What to call it in an error.
    """

    kind: Literal["obstacle", "land"]
    corners: tuple[Spot, ...]
    radius: float | None = None
    holes: tuple[tuple[Spot, ...], ...] = ()
    where: str = field(default="", compare=False)

    @property
    def rings(self) -> tuple[tuple[Spot, ...], ...]:
        """Its corners, then those of each hole."""
        return self.corners, *self.holes


@dataclass(frozen=True, slots=True, kw_only=True)
class Terms:
    """What a chart of nodes does not say.

    Parameters
    ----------
    start, destination
        Where the fleet is released and recovered, in the coordinates of the chart; None takes the
        chart's points of these names.
    fleet_size
        Number of AUVs; None leaves it to the planner.
    speed
        Speed through the water in metres per second.
    endurance
        Time limit in seconds.
    depth, depth_rating
        See `fiveroute.instance.Fleet`.
    currents
        Name of a CF netCDF file of currents.
    """

    start: Spot | None = None
    destination: Spot | None = None
    fleet_size: int | None = None
    speed: float | None = None
    endurance: float | None = None
    depth: float | None = None
    depth_rating: float | None = None
    currents: str | None = None


@dataclass(frozen=True, slots=True)
class Survey:
    """A chart.

    Parameters
    ----------
    geographic
        Whether its spots are longitude and latitude.
    sites, areas
        What is on it.
    """

    geographic: bool
    sites: tuple[Site, ...]
    areas: tuple[Area, ...] = ()

    def instance(self, name: str, terms: Terms, zones: Survey | None = None) -> Instance:
        """The mission.

        Parameters
        ----------
        name
            Its name.
        terms
            What the chart does not say.
        zones
            Another chart, of whose areas none may be entered.

        Raises
        ------
        InputError
            If anything is missing, or lies too far away.
        """
        start = self._end("start", terms.start, "released")
        destination = self._end("destination", terms.destination, "recovered")
        sites = [site for site in self.sites if site.end is None]
        if not sites:
            raise InputError(
                "are missing; a node is a row of a table, a point, or a waypoint (wpt) of GPX: "
                "routes and tracks are left alone",
                field="nodes",
            )
        _require_within_reach(sites, terms.depth_rating)
        areas = [*self.areas, *self._areas_of(zones)]
        stops = [start, destination, *(site.spot for site in sites)]
        plane = _middle(stops) if self.geographic else None
        corners = (corner for area in areas for ring in area.rings for corner in ring)
        placed = _placed([*stops, *corners], plane)
        return Instance(  # the places come in the order in which they are asked for
            name=name,
            start=Point(*next(placed)),
            destination=Point(*next(placed)),
            nodes=tuple(_node(site, k, *next(placed)) for k, site in enumerate(sites, start=1)),
            fleet=_fleet(terms),
            ocean=Ocean(Currents(file=terms.currents), *_zones(areas, placed, plane)),
            crs=plane.proj if plane else None,
        )

    def _end(self, which: str, stated: Spot | None, told: str) -> Spot:
        """Where the fleet is released or recovered."""
        place = "LON,LAT" if self.geographic else "X,Y"
        if stated is None:
            charted = {site.spot for site in self.sites if site.end == which}
            if len(charted) > 1:
                raise InputError(
                    f"is at several places; pass --{which} {place}",
                    field=which,
                    value=sorted(charted),
                )
            return _needed(
                charted.pop() if charted else None,
                f"--{which}",
                f"where the AUVs are {told}: pass --{which} {place}, or call a point {which!r}",
            )
        return require_on_earth(*stated, f"--{which}") if self.geographic else stated

    def _areas_of(self, zones: Survey | None) -> tuple[Area, ...]:
        if zones is None:
            return ()
        if not zones.areas:
            raise InputError(
                "hold no polygon; draw some, for lines keep nobody out", field="--zones"
            )
        if zones.geographic != self.geographic:
            raise InputError(
                "one has longitudes and latitudes, the other metres; use one kind for both",
                field="nodes and zones",
            )
        return tuple(replace(area, where=f"--zones, {area.where}") for area in zones.areas)


def require_on_earth(lon: float, lat: float, where: str, line: int | None = None) -> Spot:
    """A longitude from -180 to 180 and a latitude, or an error."""
    if not (-180.0 <= lon <= 360.0 and -90.0 <= lat <= 90.0):
        raise InputError(
            "must be a longitude from -180 to 360 and a latitude from -90 to 90 degrees, in this "
            "order; metres go into columns x and y of a table",
            value=(lon, lat),
            field=where or None,
            line=line,
        )
    return (lon - 360.0 if lon > 180.0 else lon), lat


def _require_within_reach(sites: Sequence[Site], rating: float | None) -> None:
    """Refuse nodes that no AUV may dive to, before anybody plans for them."""
    deep = [site for site in sites if rating is not None and (site.depth or 0.0) > rating]
    if deep:
        deepest = max(deep, key=lambda site: site.depth or 0.0)
        raise InputError(
            f"is deeper than the rating of {rating:g} m, as are {len(deep)} of {len(sites)} nodes; "
            "leave them out, or state the depth at which they are visited",
            field=f"depth of node {deepest.name!r}",
            value=deepest.depth,
        )


def _needed(value: T | None, field: str, told: str) -> T:
    if value is None:
        raise InputError(f"is missing: the file does not say {told}", field=field)
    return value


def _middle(spots: Sequence[Spot]) -> LocalPlane:
    """The plane about the middle of some places, on whichever side of the 180th meridian."""
    lon, lat = np.array(spots).T
    east = (lon - lon[0] + 180.0) % 360.0 - 180.0
    middle = float(lon[0] + (east.min() + east.max()) / 2.0)
    wrapped = round((middle + 180.0) % 360.0 - 180.0, 5)
    plane = LocalPlane(wrapped, round(float(lat.min() + lat.max()) / 2.0, 5))
    reach = float(np.hypot(*plane.project(lon, lat)).max())
    if reach > _FARTHEST:
        raise InputError(
            f"lie up to {reach / 1e3:.0f} km from their middle, and a flat map is good for "
            f"{_FARTHEST / 1e3:.0f} km; is longitude first, or is a point far off?",
            field="nodes, start and destination",
        )
    return plane


def _placed(spots: Sequence[Spot], plane: LocalPlane | None) -> Iterator[Spot]:
    """The spots in metres, to the millimetre, one after the other."""
    points = np.array(spots, dtype=np.float64)
    if plane is not None:
        points = np.column_stack(plane.project(*points.T.copy()))
    return iter([(round(x, 3), round(y, 3)) for x, y in points.tolist()])


def _node(site: Site, number: int, x: float, y: float) -> Node:
    data = 1.0 if site.data is None else site.data
    return Node(site.name or str(number), x, y, data, site.service_time, site.depth)


def _fleet(terms: Terms) -> Fleet:
    told = "how long the AUVs can stay out: pass --endurance S in seconds"
    return Fleet(
        terms.fleet_size,
        _needed(terms.speed, "--speed", "how fast the AUVs are: pass --speed V in m/s"),
        _needed(terms.endurance, "--endurance", told),
        depth=terms.depth,
        depth_rating=terms.depth_rating,
    )


def _zones(
    areas: Sequence[Area], placed: Iterator[Spot], plane: LocalPlane | None
) -> tuple[tuple[Circle | Polygon, ...], tuple[Polygon, ...]]:
    """Obstacles and land, with the corners of each in metres."""
    obstacles: list[Circle | Polygon] = []
    land: list[Polygon] = []
    for area in areas:
        outer, *holes = [[next(placed) for _ in ring] for ring in area.rings]
        if area.radius is not None:
            obstacles.append(Circle(*outer[0], area.radius))
            continue
        parts = without_holes(outer, holes, area.where)
        for part in parts:
            _require_simple(part, area.where, plane)
        (land if area.kind == "land" else obstacles).extend(map(Polygon, parts))
    return tuple(obstacles), tuple(land)


def _require_simple(corners: Sequence[Spot], where: str, plane: LocalPlane | None) -> None:
    """Refuse a polygon that crosses or touches itself, before anybody plans around it."""
    conflict = first_conflict(np.array(corners, dtype=np.float64))
    if conflict is not None:
        spot = (
            np.array(conflict)[:, None]
            if plane is None
            else plane.unproject(*np.array([conflict]).T)
        )
        x, y = (float(part[0]) for part in spot)
        raise InputError(
            f"is no simple polygon (see the corner {x:.8g}, {y:.8g}); its edges must not cross or "
            "touch one another: repair it, in QGIS by 'Fix geometries'",
            field=where,
        )
