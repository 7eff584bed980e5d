"""What charts of nodes write, in whatever words: names of columns and properties, numbers, places.

Everything is told in one line that says where the fault is.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from functools import lru_cache
from typing import Literal

from fiveroute.errors import InputError
from fiveroute.formats.files import non_negative, number
from fiveroute.formats.survey import Site, Spot, require_on_earth

__all__ = ["area_kind", "fields_of", "parsed_number", "ring", "site_of"]

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


def fields_of(names: Iterable[str]) -> dict[str, str]:
    """Which names of columns or properties are ours, each by what it holds.

    Names differ by capitals, signs and SI units in brackets without meaning anything else; data are
    in any unit. Foreign ones are left alone, unless they look like a slip of the keyboard. Of
    several names of a node the first in the order of `_SPELLINGS` is its id.

    Raises
    ------
    InputError
        If a name is almost one of ours, or two mean the same number.
    """
    return dict(_fields_of(tuple(names)))


@lru_cache(maxsize=1024)  # the features of a chart mostly have the same properties
def _fields_of(names: tuple[str, ...]) -> dict[str, str]:
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
    """A name without signs and units: those of ours, and all those of data."""
    word = re.sub(r"[(\[](m|s|deg|degrees|°)[)\]]\s*$", "", name.strip().lower())
    of_data = re.sub(r"[^0-9a-z]", "", re.sub(r"[(\[][^()\[\]]*[)\]]\s*$", "", word))
    return of_data if _FIELDS.get(of_data) == "data" else re.sub(r"[^0-9a-z]", "", word)


def _rank(bare: str) -> int:
    return list(_FIELDS).index(bare) if bare in _FIELDS else len(_FIELDS)


def _require_foreign(name: str) -> None:
    """Refuse a name that is almost that of a number of ours."""
    spellings = [spelling for spelling, field in _FIELDS.items() if field in _NUMBERS]
    bare = _bare(name)
    close = get_close_matches(bare, spellings, n=1, cutoff=0.8) if 3 < len(bare) < 20 else []
    if close:
        raise InputError(
            f"is no name that is known here; did you mean {_FIELDS[close[0]]!r}? Units are metres, "
            "seconds and degrees; rename it",
            value=name,
        )


def site_of(
    values: Mapping[str, str | None],
    spot: Spot,
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
        amounts[field] = _amount(text, f"{where}{field}", line) if text else None
    ends = (kind, called)
    end: Literal["start", "destination"] | None = None
    if "start" in ends:
        end = "start"
    elif "destination" in ends:
        end = "destination"
    return Site(name, spot, **amounts, end=end)


def area_kind(text: str | None, where: str) -> Literal["obstacle", "land"]:
    """What a zone is, from what its ``kind`` says."""
    kind = (text or "").strip().lower()
    if kind in _LAND:
        return "land"
    if kind not in _OBSTACLES:
        raise InputError("must be obstacle or land; correct it", value=text, field=where)
    return "obstacle"


def parsed_number(text: str, field: str, line: int | None = None) -> float:
    """A finite number, or an error that names where it stands."""
    return _told(number, text, field, line)


def _amount(text: str, field: str, line: int | None = None) -> float:
    """A finite number of at least 0, or an error that names where it stands."""
    return _told(non_negative, text, field, line)


def ring(corners: Sequence[Spot], where: str) -> tuple[Spot, ...]:
    """The corners of a closed ring, the last of which repeats the first."""
    if len(corners) < 4 or corners[0] != corners[-1]:
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
