"""Longitudes and latitudes as seafarers write them: ``63°26.5'N``, ``8 30 15 W``, ``N63.44``."""

from __future__ import annotations

import re
from typing import Literal

from fiveroute.errors import InputError
from fiveroute.formats.files import number

__all__ = ["parsed_degrees"]

_POSITION = re.compile(
    r"""(?P<before>[NSEW])?\s*(?P<sign>[+-])?
        (?P<degrees>\d{1,3}(\.\d+)?)\s*[°º˚:]?
        (?:(?<=[°º˚:\s])\s*(?P<minutes>\d{1,2}(\.\d+)?)\s*['\u2032\u2019:]?
           (?:(?<=['\u2032\u2019:\s])\s*(?P<seconds>\d{1,2}(\.\d+)?)\s*(?:["\u2033\u201d]|'')?)?)?
        \s*(?P<after>[NSEW])?""",
    re.VERBOSE | re.IGNORECASE,
)
_SIGNS = {"lon": {"E": 1.0, "W": -1.0}, "lat": {"N": 1.0, "S": -1.0}}


def parsed_degrees(text: str, axis: Literal["lon", "lat"], line: int) -> float:
    """A longitude or a latitude in degrees.

    Parameters
    ----------
    text
        Degrees, degrees and minutes, or degrees, minutes and seconds, with a sign or a letter of
        the compass. Only the last of them may have decimals.
    axis
        Which of the two it is.
    line
        Line of the table, for errors.

    Raises
    ------
    InputError
        If the text is nothing of the kind.
    """
    found = _POSITION.fullmatch(text.strip())
    if found is None:
        return number(text.strip(), axis, line)
    parts = [part for part in found.group("degrees", "minutes", "seconds") if part]
    letters = [letter.upper() for letter in found.group("before", "after") if letter]
    marks = [_SIGNS[axis].get(letter, 0.0) for letter in letters]
    marks += [-1.0 if found["sign"] == "-" else 1.0] if found["sign"] else []
    if (
        len(marks) > 1
        or 0.0 in marks
        or any("." in part for part in parts[:-1])
        or any(float(part) >= 60.0 for part in parts[1:])
    ):
        raise InputError(
            "must be degrees, minutes below 60 and seconds below 60, decimals in the last of them "
            f"only, with a sign or one of {' and '.join(_SIGNS[axis])}; correct the line",
            value=text,
            field=axis,
            line=line,
        )
    size = sum(float(part) / 60.0**k for k, part in enumerate(parts))
    return size * (marks[0] if marks else 1.0)
