"""Nodes and zones as charts and tables hold them, and the mission that they become.

A chart of nodes says where they are, and perhaps what they hold; it knows no fleet. `Terms` adds
what is missing. Longitudes and latitudes meet the planner's metres in the azimuthal equidistant
plane about the middle of the chart (`fiveroute.ocean.local_plane`), which the instance keeps as
its ``crs``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Literal, TypeVar

import numpy as np

from fiveroute.errors import InputError
from fiveroute.formats.files import non_negative, number
from fiveroute.instance import Circle, Currents, Fleet, Instance, Node, Ocean, Point, Polygon
from fiveroute.ocean.local_plane import LocalPlane

__all__ = [
    "ENDS",
    "Area",
    "Site",
    "Survey",
    "Terms",
    "amount",
    "area_kind",
    "fields_of",
    "parsed_number",
    "require_on_earth",
    "ring",
    "site_of",
]

ENDS = ("start", "destination")
"""Names of points that are no nodes but where the fleet is released and recovered."""

T = TypeVar("T")

_FARTHEST = 500e3  # metres from the middle, where lengths err by 0.1 %

_SPELLINGS = {
    "id": ("id", "name", "node", "nodeid", "station", "stationid", "label", "title"),
    "lon": ("lon", "long", "lng", "longitude", "longitudedeg", "londeg"),
    "lat": ("lat", "latitude", "latitudedeg", "latdeg"),
    "x": ("x", "xm", "east", "easting"),
    "y": ("y", "ym", "north", "northing"),
    "data": ("data", "rho", "profit", "prize", "score", "value", "datavolume", "volume"),
    "service_time": ("servicetime", "service", "servicetimes", "dwell", "dwelltime", "hold"),
    "depth": ("depth", "depthm", "z"),
    "kind": ("kind",),
    "radius": ("radius", "radiusm"),
}
_NUMBERS = ("lon", "lat", "x", "y", "data", "service_time", "depth", "radius")
_FIELDS = {spelling: field for field, all_of in _SPELLINGS.items() for spelling in all_of}

_LAND = ("land", "coast", "coastline", "island", "shore")
_OBSTACLES = ("", "obstacle", "zone", "exclusion")

_Spot = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Site:
    """A point of a chart.

    Parameters
    ----------
    name
        Its name; nothing leaves it to its number in the chart.
    spot
        Longitude and latitude in degrees, or x and y in metres.
    data, service_time, depth
        See `fiveroute.instance.Node`; None where the chart does not say.
    end
        Whether it may be a start or destination, by its name.
    """

    name: str
    spot: _Spot
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
        Its corners as in `Site`, or the centre alone of a round one.
    radius
        Of a round one, in metres.
    """

    kind: Literal["obstacle", "land"]
    corners: tuple[_Spot, ...]
    radius: float | None = None


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

    start: _Spot | None = None
    destination: _Spot | None = None
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
        ends = [self._end(which, getattr(terms, which)) for which in ENDS]
        nodes = [site for site in self.sites if site.end is None]
        areas = [*self.areas, *self._same_kind(zones).areas] if zones else list(self.areas)
        spots = [*ends, *(site.spot for site in nodes), *(c for a in areas for c in a.corners)]
        plane = _middle([*ends, *(site.spot for site in nodes)]) if self.geographic else None
        placed = _placed(spots, plane)
        start, destination = (Point(*next(placed)) for _ in ENDS)
        return Instance(
            name=name,
            nodes=tuple(
                Node(
                    site.name or str(k),
                    *next(placed),
                    1.0 if site.data is None else site.data,
                    site.service_time,
                    site.depth,
                )
                for k, site in enumerate(nodes, start=1)
            ),
            start=start,
            destination=destination,
            fleet=Fleet(
                terms.fleet_size,
                _needed(terms.speed, "--speed", "how fast the AUVs are: pass --speed V in m/s"),
                _needed(
                    terms.endurance,
                    "--endurance",
                    "how long the AUVs can stay out: pass --endurance S in seconds",
                ),
                depth=terms.depth,
                depth_rating=terms.depth_rating,
            ),
            ocean=_ocean(areas, [[next(placed) for _ in a.corners] for a in areas], terms.currents),
            crs=plane.proj if plane else None,
        )

    def _end(self, which: str, stated: _Spot | None) -> _Spot:
        charted = [site.spot for site in self.sites if site.end == which]
        if stated is not None:
            if self.geographic:
                require_on_earth(*stated, f"--{which}")
            return stated
        place = "LON,LAT" if self.geographic else "X,Y"
        told = "released" if which == "start" else "recovered"
        return _needed(
            charted[0] if charted else None,
            f"--{which}",
            f"where the AUVs are {told}: pass --{which} {place}, or call a point {which!r}",
        )

    def _same_kind(self, zones: Survey) -> Survey:
        if zones.areas and zones.geographic != self.geographic:
            raise InputError(
                "one has longitudes and latitudes, the other metres; use one kind for both",
                field="nodes and zones",
            )
        return zones


def fields_of(names: Iterable[str]) -> dict[str, str]:
    """Which names of columns or properties are ours, each by what it holds.

    Names differ by capitals, signs and SI units in brackets without meaning anything else. Foreign
    ones are left alone, unless they look like a slip of the keyboard. Of several names of a
    node the first in the order of `_SPELLINGS` is its id.

    Raises
    ------
    InputError
        If a name is almost one of ours, or two mean the same number.
    """
    found: dict[str, str] = {}
    for name in sorted(names, key=lambda name: _rank(_bare(name))):
        field = _FIELDS.get(_bare(name))
        if field is None:
            _require_foreign(name)
        elif field not in found:
            found[field] = name
        elif field in _NUMBERS:
            raise InputError(
                f"means the same as {found[field]!r}; remove one of them", value=name, field=field
            )
    return found


def _bare(name: str) -> str:
    """A name without signs and SI units."""
    word = re.sub(r"[(\[](m|s|deg|degrees|°)[)\]]\s*$", "", name.strip().lower())
    return re.sub(r"[^0-9a-z]", "", word)


def _rank(bare: str) -> int:
    return list(_FIELDS).index(bare) if bare in _FIELDS else len(_FIELDS)


def _require_foreign(name: str) -> None:
    """Refuse a name that is almost that of a number of ours."""
    spellings = [spelling for spelling, field in _FIELDS.items() if field in _NUMBERS]
    bare = _bare(name)
    close = get_close_matches(bare, spellings, n=1, cutoff=0.8) if len(bare) > 3 else []
    if close:
        raise InputError(
            f"is no name that is known here; did you mean {_FIELDS[close[0]]!r}? Units are metres, "
            "seconds and degrees; rename it",
            value=name,
        )


def site_of(
    values: Mapping[str, str | None],
    spot: _Spot,
    *,
    geographic: bool,
    line: int | None = None,
    where: str = "",
) -> Site:
    """A site from the texts of its fields.

    Parameters
    ----------
    values
        Texts by field, see `fields_of`; empty ones say nothing.
    spot
        Where it is.
    geographic
        Whether that is longitude and latitude.
    line, where
        What to call it in an error.
    """
    if geographic:
        spot = require_on_earth(*spot, where.rstrip(", ."), line)
    name = (values.get("id") or "").strip()
    kind = (values.get("kind") or "").strip().lower()
    called = "" if kind == "node" else name.lower()
    amounts = {}
    for field in ("data", "service_time", "depth"):
        text = (values.get(field) or "").strip()
        amounts[field] = amount(text, f"{where}{field}", line) if text else None
    end = kind if kind in ENDS else called
    return Site(
        name,
        spot,
        **amounts,
        end="start" if end == "start" else "destination" if end == "destination" else None,
    )


def area_kind(text: str | None, where: str) -> Literal["obstacle", "land"]:
    """What a zone is, from what its ``kind`` says."""
    kind = (text or "").strip().lower()
    if kind in _LAND:
        return "land"
    if kind not in _OBSTACLES:
        raise InputError("must be obstacle or land; correct it", value=text, field=where)
    return "obstacle"


def require_on_earth(lon: float, lat: float, where: str, line: int | None = None) -> _Spot:
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


def parsed_number(text: str, field: str, line: int | None = None) -> float:
    """A finite number, or an error that names where it stands."""
    return _told(number, text, field, line)


def amount(text: str, field: str, line: int | None = None) -> float:
    """A finite number of at least 0, or an error that names where it stands."""
    return _told(non_negative, text, field, line)


def ring(corners: Sequence[_Spot], where: str) -> tuple[_Spot, ...]:
    """The corners of a closed ring, the last of which repeats the first."""
    if len(corners) < 4 or corners[0] != corners[-1] or not all(map(math.isfinite, corners[0])):
        raise InputError(
            "a ring needs four positions at least, the last the same as the first",
            field=where,
            value=list(corners),
        )
    return tuple(corners[:-1])


def _told(
    parse: Callable[[str, str, int], float], text: str, field: str, line: int | None
) -> float:
    try:
        return parse(text.strip(), field, line or 0)
    except InputError as error:
        raise InputError(error.rule, value=error.value, field=field, line=line) from None


def _needed(value: T | None, field: str, told: str) -> T:
    if value is None:
        raise InputError(f"is missing: the file does not say {told}", field=field)
    return value


def _middle(spots: Sequence[_Spot]) -> LocalPlane:
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


def _placed(spots: Sequence[_Spot], plane: LocalPlane | None) -> Iterator[_Spot]:
    """The spots in metres, to the millimetre, one after the other."""
    points = np.array(spots, dtype=np.float64)
    if plane is not None:
        points = np.column_stack(plane.project(*points.T.copy()))
    return iter([(round(x, 3), round(y, 3)) for x, y in points.tolist()])


def _ocean(areas: Sequence[Area], shapes: Sequence[Sequence[_Spot]], currents: str | None) -> Ocean:
    obstacles: list[Circle | Polygon] = []
    land: list[Polygon] = []
    for area, corners in zip(areas, shapes, strict=True):
        if area.radius is not None:
            obstacles.append(Circle(*corners[0], area.radius))
        elif area.kind == "land":
            land.append(Polygon(tuple(corners)))
        else:
            obstacles.append(Polygon(tuple(corners)))
    return Ocean(Currents(file=currents), tuple(obstacles), tuple(land))
