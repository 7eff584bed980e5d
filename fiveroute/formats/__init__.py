"""Files in and out: one module a format, and the doors that choose among them.

A format is a pair of pure functions between text and `Instance`. What a format cannot hold
is refused when it is written, and what it leaves unsaid when it is read is stated in its
module. Charts of nodes, which know no fleet, are read as a `Survey` and become an instance with
the `Terms` of a mission.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from fiveroute.errors import InputError, nearest
from fiveroute.formats import (
    chao,
    csv_nodes,
    geojson_nodes,
    gpx_nodes,
    kml_nodes,
    native,
    oplib,
    tsplib,
)
from fiveroute.formats.files import require_writable, title_of, write_text_atomically
from fiveroute.formats.kmz import chart_text
from fiveroute.formats.native import currents_file, instance_hash, relocated
from fiveroute.formats.plan_file import PlanFile, read_plan, write_plan
from fiveroute.formats.survey import Survey, Terms
from fiveroute.instance import Instance

__all__ = [
    "FORMATS",
    "SURVEY_FORMATS",
    "Format",
    "PlanFile",
    "Survey",
    "SurveyFormat",
    "Terms",
    "chart_text",
    "currents_file",
    "instance_hash",
    "read_instance",
    "read_plan",
    "read_survey",
    "require_writable",
    "survey_format",
    "write_instance",
    "write_plan",
    "write_text_atomically",
]


@dataclass(frozen=True, slots=True)
class Format:
    """How a format is read and written.

    Parameters
    ----------
    suffixes
        Endings of file names that suggest it.
    signature
        Is found in the first `_HEAD` characters of such a file.
    read
        ``read(text, name)``, where `name` serves formats that hold none.
    write
        ``write(instance)``.
    """

    suffixes: tuple[str, ...]
    signature: re.Pattern[str]
    read: Callable[[str, str], Instance]
    write: Callable[[Instance], str]


FORMATS = {
    "native": Format((".json",), re.compile(r"\A\s*\{"), native.read, native.write),
    "oplib": Format(
        (".oplib", ".op"),
        re.compile(r"^[ \t]*(COST_LIMIT\s*:|TYPE\s*:\s*OP\b|NODE_SCORE_SECTION)", re.MULTILINE),
        oplib.read,
        oplib.write,
    ),
    "tsplib": Format(
        (".tsp", ".atsp"),
        re.compile(r"^[ \t]*(NAME|TYPE|DIMENSION|EDGE_WEIGHT_TYPE)\s*:", re.MULTILINE),
        tsplib.read,
        tsplib.write,
    ),
    "chao": Format((".txt", ".top"), re.compile(r"\A\s*(n|m|tmax)[\s;]"), chao.read, chao.write),
}
"""All formats by name, in the order in which their signatures are tried."""


@dataclass(frozen=True, slots=True)
class SurveyFormat:
    """How a chart of nodes is read.

    Parameters
    ----------
    suffixes
        Endings of file names that suggest it.
    signature
        Is found in the first `_HEAD` characters of such a file; None where only the suffix tells.
    read
        ``read(text)``.
    """

    suffixes: tuple[str, ...]
    signature: re.Pattern[str] | None
    read: Callable[[str], Survey]


SURVEY_FORMATS = {
    "csv": SurveyFormat((".csv", ".tsv"), None, csv_nodes.read),
    "geojson": SurveyFormat(
        (".geojson",), re.compile(r'"type"\s*:\s*"Feature(Collection)?"'), geojson_nodes.read
    ),
    "kml": SurveyFormat((".kml", ".kmz"), re.compile(r"<(\w+:)?kml[\s>]"), kml_nodes.read),
    "gpx": SurveyFormat((".gpx",), re.compile(r"<(\w+:)?gpx[\s>]"), gpx_nodes.read),
}
"""All formats of charts by name."""

_HEAD = 4096


def read_instance(path: Path, format_name: str | None = None) -> Instance:
    """Read an instance from a file.

    Parameters
    ----------
    path
        The file.
    format_name
        Name of its format; None finds out, first from the content, then from the suffix.

    Raises
    ------
    InputError
        If the file cannot be read, or is no valid instance; it names file, line or field,
        the value, the rule and the remedy.
    """
    text = chart_text(path)
    try:
        if format_name is None and (chart := survey_format(path, text)) is not None:
            raise InputError(
                f"is a chart of nodes ({chart}) without a fleet; turn it into a mission with "
                "fiveroute convert"
            )
        chosen = (
            _detected(text, path.suffix.lower()) if format_name is None else _named(format_name)
        )
        return chosen.read(text, title_of(path))
    except InputError as error:
        raise error.at(path) from None


def write_instance(
    instance: Instance,
    path: Path,
    format_name: str | None = None,
    force: bool = False,
    source: Path | None = None,
) -> None:
    """Write an instance to a file, whole or not at all.

    Parameters
    ----------
    instance
        The instance.
    path
        The file.
    format_name
        Name of its format; None takes it from the suffix, native for an unknown one.
    force
        Overwrite an existing file.
    source
        File that the instance comes from; names of files in it are relative to its folder
        and are changed so that they mean the same files from the new folder.

    Raises
    ------
    InputError
        If the format cannot hold the instance, or the file cannot be written.
    """
    if format_name is None:
        suffix = path.suffix.lower()
        chosen = next((f for f in FORMATS.values() if suffix in f.suffixes), FORMATS["native"])
    else:
        chosen = _named(format_name)
    moved = instance if source is None else relocated(instance, source, path)
    write_text_atomically(path, chosen.write(moved), force)


def survey_format(path: Path, text: str) -> str | None:
    """Name of the format of a chart of nodes; None for any other file.

    Parameters
    ----------
    path
        The file, for its suffix.
    text
        Its content.
    """
    head, suffix = text[:_HEAD], path.suffix.lower()
    for name, known in SURVEY_FORMATS.items():
        if known.signature is None and suffix in known.suffixes:
            return name
        if known.signature is not None and known.signature.search(head):
            return name
    return None


def read_survey(path: Path, format_name: str | None = None) -> Survey:
    """Read a chart of nodes and zones.

    Parameters
    ----------
    path
        The file.
    format_name
        Name of its format; None finds out, first from the content, then from the suffix.

    Raises
    ------
    InputError
        If the file cannot be read, or is no valid chart; it says where.
    """
    text = chart_text(path)
    name = format_name or survey_format(path, text)
    try:
        if name not in SURVEY_FORMATS:
            raise InputError(
                f"is no chart of nodes; known are {', '.join(SURVEY_FORMATS)}", value=format_name
            )
        return SURVEY_FORMATS[name].read(text)
    except InputError as error:
        raise error.at(path) from None


def _named(name: str) -> Format:
    if name not in FORMATS:
        raise InputError(f"is no format; {nearest(name, FORMATS)}", value=name)
    return FORMATS[name]


def _detected(text: str, suffix: str) -> Format:
    head = text[:_HEAD]
    for known in FORMATS.values():
        if known.signature.search(head):
            return known
    for known in FORMATS.values():
        if suffix in known.suffixes:
            return known
    raise InputError(
        "is of no format that fiveroute knows; end its name in "
        f"{', '.join(s for known in FORMATS.values() for s in known.suffixes)}",
    )
