"""From a plan to files that vehicles and map programs read: one module a format.

A format is a pair of functions: ``write`` turns a `Mission` into texts by file name, and ``check``
reads these texts again and refuses what breaks a rule of the format, before anything is on the
disk. The rules stand at the head of each module.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from fiveroute.errors import InputError, nearest
from fiveroute.formats.files import write_text_atomically
from fiveroute.formats.plan_file import PlanFile
from fiveroute.vehicle_files import (
    cola2,
    csv_table,
    geojson,
    gpx,
    kml,
    moos,
    neptus,
    qgroundcontrol,
    slocum,
    waypoint_list,
)
from fiveroute.vehicle_files.from_plan import Choices, mission_of
from fiveroute.vehicle_files.mission import Mission
from fiveroute.vehicle_files.writing import write_archive, write_folder

__all__ = ["VEHICLE_FORMATS", "Choices", "VehicleFormat", "export_plan", "write_mission"]


@dataclass(frozen=True, slots=True)
class VehicleFormat:
    """How a format is written.

    Parameters
    ----------
    suffixes
        Endings of its files; the first one is that of a file that stands alone.
    write
        ``write(mission)`` gives the texts by file name.
    check
        ``check(texts)`` refuses what breaks a rule.
    holds
        What one file holds: the ``fleet``, one ``vehicle``, a ``part`` of a vehicle's mission that
        never stands alone, or the fleet in an ``archive``.
    """

    suffixes: tuple[str, ...]
    write: Callable[[Mission], dict[str, str]]
    check: Callable[[dict[str, str]], None]
    holds: str


VEHICLE_FORMATS = {
    "qgc": VehicleFormat((".plan",), qgroundcontrol.write, qgroundcontrol.check, "vehicle"),
    "wpl": VehicleFormat((".waypoints",), waypoint_list.write, waypoint_list.check, "vehicle"),
    "neptus": VehicleFormat((".nmisz",), neptus.write, neptus.check, "archive"),
    "moos": VehicleFormat((".bhv", ".moos"), moos.write, moos.check, "part"),
    "slocum": VehicleFormat((".ma",), slocum.write, slocum.check, "part"),
    "cola2": VehicleFormat((".xml",), cola2.write, cola2.check, "vehicle"),
    "gpx": VehicleFormat((".gpx",), gpx.write, gpx.check, "fleet"),
    "kml": VehicleFormat((".kml",), kml.write, kml.check, "fleet"),
    "geojson": VehicleFormat((".geojson",), geojson.write, geojson.check, "fleet"),
    "csv": VehicleFormat((".csv",), csv_table.write, csv_table.check, "fleet"),
}
"""All formats by name."""


def export_plan(
    filed: PlanFile,
    source: Path,
    format_name: str,
    output: Path,
    choices: Choices | None = None,
    force: bool = False,
) -> Mission:
    """Write a plan for vehicles, or refuse an unsafe one.

    Parameters
    ----------
    filed
        The plan.
    source
        Its file; a file of currents in it is relative to the same folder.
    format_name
        One of `VEHICLE_FORMATS`.
    output
        File or folder, see `write_mission`.
    choices
        What the plan leaves open.
    force
        Overwrite what is there.

    Raises
    ------
    InputError
        If the plan is unsafe, a format cannot hold it, or it cannot be written.
    """
    mission = mission_of(filed, source.parent, choices or Choices())
    write_mission(mission, format_name, output, force)
    return mission


def write_mission(mission: Mission, format_name: str, output: Path, force: bool = False) -> None:
    """Write a mission.

    Parameters
    ----------
    mission
        The mission.
    format_name
        One of `VEHICLE_FORMATS`.
    output
        The file, where a format holds the fleet in one. Else a folder for a file an AUV and more;
        or a file with the ending of the format, for a single AUV that needs no more than one.
    force
        Overwrite what is there.
    """
    if format_name not in VEHICLE_FORMATS:
        raise InputError(
            f"is no format; {nearest(format_name, VEHICLE_FORMATS)}", value=format_name
        )
    chosen = VEHICLE_FORMATS[format_name]
    _require_no_other(chosen, output)
    files = chosen.write(mission)
    chosen.check(files)
    is_file = output.suffix.lower() in chosen.suffixes
    if chosen.holds == "archive":
        write_archive(output, files, force)
    elif chosen.holds == "fleet" or (chosen.holds == "vehicle" and is_file and len(files) == 1):
        (text,) = files.values()
        write_text_atomically(output, text, force)
    elif is_file:
        remedy = " or pass --auv K" if chosen.holds == "vehicle" else ""
        raise InputError(f"cannot hold {len(files)} files; name a folder{remedy}", file=output)
    else:
        write_folder(output, files, chosen.suffixes, force)


def _require_no_other(chosen: VehicleFormat, output: Path) -> None:
    """Refuse a name that says another format than the one that is written."""
    suffix = output.suffix.lower()
    if suffix in chosen.suffixes:
        return
    for name, other in VEHICLE_FORMATS.items():
        if suffix in other.suffixes:
            folder = ", or name a folder" if chosen.holds in ("vehicle", "part") else ""
            raise InputError(
                f"is a name for {name}; end it in {chosen.suffixes[0]}{folder}", file=output
            )
