"""Waypoint files of the Slocum glider: ``goto_l10.ma`` and the following, a folder an AUV.

A waypoint is longitude first, then latitude, as degrees and minutes in one number: -7348.5000
is 73 degrees and 48.5 minutes west. A file lists at most seven waypoints; a longer mission
goes on in the next file. The file has no place for depths and stays: the glider's ``yo`` and
``surface`` behaviours set these, and a comment beside a waypoint tells the planned ones.

References
----------
Teledyne Webb Research, "Slocum G2 Glider Operators Manual" (goto_list behaviour).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

from fiveroute.vehicle_files.mission import Mission, Vehicle, Waypoint
from fiveroute.vehicle_files.spelling import label, require

__all__ = ["check", "write"]

_MOST_WAYPOINTS = 7
_FIRST, _LAST = 10, 99  # numbers of the files
_NEAREST, _FARTHEST = 10.0, 100.0  # metres from a waypoint at which it counts as reached
_COLUMN = 11


def write(mission: Mission) -> dict[str, str]:
    """The files of every AUV, each in a folder of its own."""
    return {
        f"{vehicle.name}/goto_l{number}.ma": _text(vehicle, number, points)
        for vehicle in mission.vehicles
        for number, points in _numbered(vehicle)
    }


def check(files: dict[str, str]) -> None:
    """Refuse files that the glider would misread."""
    for text in files.values():
        lines = [line.partition("#")[0].strip() for line in text.splitlines()]
        require(lines[0] == "behavior_name=goto_list", "must be a goto_list")
        begin, end = lines.index("<start:waypoints>"), lines.index("<end:waypoints>")
        rows = [line.split() for line in lines[begin + 1 : end] if line]
        stated = {line.split()[1]: line.split()[-1] for line in lines if line.startswith("b_arg:")}
        require(1 <= len(rows) <= _MOST_WAYPOINTS, "a file has 1 to 7 waypoints", len(rows))
        require(int(stated["num_waypoints(nodim)"]) == len(rows), "must count its waypoints")
        require(float(stated["list_when_wpt_dist(m)"]) >= _NEAREST, "must be 10 m at least")
        for lon, lat in rows:
            for text_value, most in ((lon, 180.0), (lat, 90.0)):
                value = abs(float(text_value))
                minutes = value % 100.0
                require(minutes < 60.0, "minutes must be below 60", text_value)
                require(value // 100.0 + minutes / 60.0 <= most, "is not on Earth", text_value)


def _numbered(vehicle: Vehicle) -> list[tuple[int, tuple[Waypoint, ...]]]:
    """The waypoints after the start, seven a file, with the numbers of the files."""
    points = vehicle.waypoints[1:]
    lists = [points[k : k + _MOST_WAYPOINTS] for k in range(0, len(points), _MOST_WAYPOINTS)]
    require(
        len(lists) <= _LAST - _FIRST + 1,
        f"has more waypoints than {_LAST - _FIRST + 1} files hold; pass a larger --tolerance",
        len(vehicle.waypoints),
        vehicle.name,
    )
    return list(enumerate(lists, start=_FIRST))


def _text(vehicle: Vehicle, number: int, points: Sequence[Waypoint]) -> str:
    arguments = (
        ("num_legs_to_run(nodim)", "-2", "traverse once"),
        ("start_when(enum)", "0", "BAW_IMMEDIATELY"),
        ("list_stop_when(enum)", "7", "BAW_WHEN_WPT_DIST"),
        ("list_when_wpt_dist(m)", f"{_reach(vehicle):.0f}", "at this distance it is reached"),
        ("initial_wpt(enum)", "0", "the first"),
        ("num_waypoints(nodim)", str(len(points)), ""),
    )
    lines = ["behavior_name=goto_list", f"# goto_l{number}.ma  {vehicle.name}, by fiveroute"]
    lines += ["<start:b_arg>"]
    lines += [
        f"    b_arg: {name:<24}{value:>5}{f'  # {told}' if told else ''}"
        for name, value, told in arguments
    ]
    lines += ["<end:b_arg>", "<start:waypoints>", "# LON        LAT"]
    lines += [
        f"{_minutes(point.place.lon):>{_COLUMN}} {_minutes(point.place.lat):>{_COLUMN}}"
        f"  # {_remark(point)}"
        for point in points
    ]
    return "\n".join([*lines, "<end:waypoints>", ""])


def _reach(vehicle: Vehicle) -> float:
    """Half of the shortest leg, within the bounds of what is sensible."""
    legs = [math.hypot(b.x - a.x, b.y - a.y) for a, b in itertools.pairwise(vehicle.waypoints)]
    shortest = min((leg for leg in legs if leg > 0.0), default=0.0)
    return math.floor(min(max(shortest / 2.0, _NEAREST), _FARTHEST))


def _minutes(degrees: float) -> str:
    """An angle as DDDMM.mmmm, its minutes carried at 60."""
    ten_thousandths = round(abs(degrees) * 600_000)
    whole, rest = divmod(ten_thousandths, 600_000)
    sign = "-" if degrees < 0.0 and ten_thousandths else ""
    return f"{sign}{whole}{rest // 10_000:02d}.{rest % 10_000:04d}"


def _remark(point: Waypoint) -> str:
    stay = f", stay {point.hold:.0f} s" if point.hold else ""
    return f"{label(point.name) or 'bend'}, depth {point.depth:.1f} m{stay}"
