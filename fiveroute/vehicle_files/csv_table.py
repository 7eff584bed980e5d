"""A table of all waypoints of the fleet, a row a waypoint: for spreadsheets and other programs.

Spreadsheets run a cell that begins with ``=``, ``+``, ``-``, ``@``, a tab or a carriage return as
a formula. Text that does gets an apostrophe before it, which spreadsheets hide and the reader of
nodes takes away.
"""

from __future__ import annotations

import csv
import io

from fiveroute.vehicle_files.mission import Mission
from fiveroute.vehicle_files.spelling import degrees, metres, require

__all__ = ["COLUMNS", "check", "write"]

COLUMNS = (
    "auv",
    "number",
    "kind",
    "id",
    "longitude",
    "latitude",
    "x",
    "y",
    "depth",
    "service_time",
    "arrival",
    "time",
)

_FORMULAS = ("=", "+", "-", "@", "\t", "\r", "'")


def write(mission: Mission) -> dict[str, str]:
    """The fleet in one table."""
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(COLUMNS)
    for vehicle in mission.vehicles:
        for number, point in enumerate(vehicle.waypoints):
            place = degrees(point.place.lon), degrees(point.place.lat)
            words = [_harmless(vehicle.name), number, point.kind, _harmless(point.name)]
            numbers = [metres(v) for v in (point.x, point.y, point.depth, point.hold)]
            times = [f"{point.arrival:.1f}", mission.moment(point.arrival) or ""]
            writer.writerow([*words, *place, *numbers, *times])
    return {"mission.csv": table.getvalue()}


def check(files: dict[str, str]) -> None:
    """Refuse tables with ragged rows, or with text that a spreadsheet would run."""
    for text in files.values():
        head, *rows = csv.reader(io.StringIO(text, newline=""))
        require(tuple(head) == COLUMNS, "must begin with the names of its columns")
        for row in rows:
            require(len(row) == len(COLUMNS), "every row has all columns", len(row))
            harmless = not any(row[k].startswith(_FORMULAS[:-1]) for k in (0, 2, 3))
            require(harmless, "no text may begin like a formula", row)
            require(float(row[COLUMNS.index("depth")]) >= 0.0, "depth is positive down")


def _harmless(text: str) -> str:
    return f"'{text}" if text.startswith(_FORMULAS) else text
