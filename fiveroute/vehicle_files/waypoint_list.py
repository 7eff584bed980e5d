"""The waypoint list of MAVLink ground stations for ArduSub: text, a file an AUV.

The first line is ``QGC WPL 110``; every other line has an index, whether it is the current
item, frame, command, four parameters, latitude, longitude, altitude and autocontinue, with
tabs in between. Index 0 is home. The rules of the vehicle are those of
`fiveroute.vehicle_files.ardusub`.

References
----------
MAVLink Developer Guide, "File Formats: Plain-Text File Format".
"""

from __future__ import annotations

from fiveroute.vehicle_files.ardusub import WAYPOINT, Item, check_items, items_of
from fiveroute.vehicle_files.mission import Mission, Vehicle
from fiveroute.vehicle_files.spelling import require

__all__ = ["check", "write"]

_HEAD = "QGC WPL 110"
_COLUMNS = 12


def write(mission: Mission) -> dict[str, str]:
    """A list for every AUV."""
    return {
        f"{vehicle.name}.waypoints": "\n".join([_HEAD, *_lines(mission, vehicle), ""])
        for vehicle in mission.vehicles
    }


def check(files: dict[str, str]) -> None:
    """Refuse lists that a ground station cannot read or ArduSub must not get."""
    for text in files.values():
        head, *lines = text.splitlines()
        rows = [[float(cell) for cell in line.split("\t")] for line in lines]
        require(head == _HEAD, f"must begin with {_HEAD}", head)
        require(all(len(row) == _COLUMNS for row in rows), f"a line has {_COLUMNS} columns")
        require([row[0] for row in rows] == list(range(len(rows))), "must be numbered from 0")
        home = rows[0]
        require(home[2] == 0.0 and home[3] == WAYPOINT and home[10] == 0.0, "home comes first")
        check_items([_parsed(row) for row in rows[1:]])


def _lines(mission: Mission, vehicle: Vehicle) -> list[str]:
    place = vehicle.waypoints[0].place
    home = Item(WAYPOINT, 0, (0.0, 0.0, 0.0, 0.0, place.lat, place.lon, 0.0))
    items = [home, *items_of(mission, vehicle)]
    return [_line(number, item) for number, item in enumerate(items)]


def _line(number: int, item: Item) -> str:
    *parameters, lat, lon, altitude = item.parameters
    cells = [str(number), str(int(number == 0)), str(item.frame), str(item.command)]
    cells += [f"{value:.6f}" for value in parameters]
    return "\t".join([*cells, f"{lat:.8f}", f"{lon:.8f}", f"{altitude:.3f}", "1"])


def _parsed(row: list[float]) -> Item:
    first, second, third, fourth, lat, lon, altitude = row[4:11]
    return Item(int(row[3]), int(row[2]), (first, second, third, fourth, lat, lon, altitude))
