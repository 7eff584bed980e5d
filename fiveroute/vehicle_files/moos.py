"""Helm behaviours of MOOS-IvP: a folder with a ``.bhv`` file for every AUV and ``origin.moos``.

A waypoint behaviour knows no depth, so that the mission is a chain of stages, ``STAGE = 1, 2,
...``: in each one either ``BHV_Waypoint`` follows points of one depth, or ``BHV_StationKeep``
stays at a node, and a ``BHV_ConstantDepth`` beside it holds the depth. The end of one stage
begins the next; the last one ends the deployment. ``BHV_MaxDepth`` keeps the depth rating.

Points are metres from the origin in ``origin.moos``, which belongs into the vehicle's ``.moos``
file. MOOS measures them along the grid of the origin's UTM zone, whose north is up to three
degrees off true north: they are not the planner's metres.

References
----------
M. R. Benjamin, H. Schmidt, P. M. Newman and J. J. Leonard, "Nested autonomy for unmanned marine
vehicles with MOOS-IvP", Journal of Field Robotics 27 (2010), doi 10.1002/rob.20370.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass

from fiveroute.vehicle_files.mission import Mission, Position, Vehicle, Waypoint
from fiveroute.vehicle_files.spelling import degrees, label, require, whole_seconds

__all__ = ["ORIGIN", "check", "utm_metres", "write"]

ORIGIN = "origin.moos"

_MOVES = ("BHV_Waypoint", "BHV_StationKeep")

Settings = list[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class _Stage:
    """Waypoints that one behaviour serves: a path at one depth, or one node to stay at."""

    points: tuple[Waypoint, ...]
    stays: bool


def write(mission: Mission) -> dict[str, str]:
    """The behaviours of every AUV, and the origin of their points."""
    files = {f"{vehicle.name}.bhv": _behaviours(mission, vehicle) for vehicle in mission.vehicles}
    origin = mission.origin
    lines = ["// Origin of the points in the .bhv files, for the vehicle's .moos file (fiveroute)"]
    lines += [f"LatOrigin  = {degrees(origin.lat)}", f"LongOrigin = {degrees(origin.lon)}", ""]
    return {**files, ORIGIN: "\n".join(lines)}


def check(files: dict[str, str]) -> None:
    """Refuse behaviours that do not make one chain of stages, each with its depth."""
    require("LatOrigin" in files[ORIGIN] and "LongOrigin" in files[ORIGIN], "needs its origin")
    for name in files.keys() - {ORIGIN}:
        parsed = _parsed(files[name])
        moves = [settings for kind, settings in parsed if kind in _MOVES]
        depths = [settings for kind, settings in parsed if kind == "BHV_ConstantDepth"]
        require(len(moves) == len(depths) > 0, "each stage needs a depth behaviour beside it")
        for k, (move, depth) in enumerate(zip(moves, depths, strict=True), start=1):
            stage = ("condition", f"STAGE = {k}")
            require(stage in move and stage in depth, "stages must follow each other", k)
            ended = ("endflag", f"STAGE = {k + 1}") in move
            require(ended or k == len(moves), "a stage must begin the next one", k)
            require(float(dict(depth)["depth"]) >= 0.0, "depth is positive down")


def utm_metres(places: Sequence[Position], origin: Position) -> list[tuple[float, float]]:
    """Positions as MOOS measures them: along the UTM grid of an origin, in metres."""
    import pyproj

    zone = min(int((origin.lon + 180.0) // 6.0), 59) + 1
    grid = pyproj.Proj(f"+proj=utm +zone={zone} +datum=WGS84 +units=m")
    east, north = grid(origin.lon, origin.lat)
    x, y = grid([place.lon for place in places], [place.lat for place in places])
    return [(a - east, b - north) for a, b in zip(x, y, strict=True)]


def _behaviours(mission: Mission, vehicle: Vehicle) -> str:
    lines = [f"// {label(mission.name)}: {vehicle.name}, by fiveroute", ""]
    lines += [f"initialize {flag}" for flag in ("DEPLOY = false", "STAGE = 1")]
    stages = _stages(vehicle)
    for k, stage in enumerate(stages, start=1):
        lines += _stage(mission, stage, k, is_last=k == len(stages))
    if mission.depth_rating is not None:
        settings = [("name", "depth_rating"), ("pwt", "200"), ("condition", "DEPLOY = true")]
        settings += [("max_depth", f"{mission.depth_rating:g}")]
        lines += _behaviour("BHV_MaxDepth", settings)
    return "\n".join([*lines, ""])


def _stages(vehicle: Vehicle) -> list[_Stage]:
    """The waypoints after the start, grouped by what one behaviour can serve.

    The clock of a stay runs as soon as its stage does: the AUV gets there in the stage before.
    """
    stages, path = [], []
    for point, following in itertools.zip_longest(vehicle.waypoints[1:], vehicle.waypoints[2:]):
        path.append(point)
        if point.hold or following is None or following.depth != point.depth:
            stages.append(_Stage(tuple(path), False))
            path = []
        if point.hold:
            stages.append(_Stage((point,), True))
    return stages


def _stage(mission: Mission, stage: _Stage, number: int, *, is_last: bool) -> list[str]:
    shared = [("pwt", "100"), ("condition", "DEPLOY = true"), ("condition", f"STAGE = {number}")]
    flags = ["DEPLOY = false", "MISSION_DONE = true"] if is_last else [f"STAGE = {number + 1}"]
    spots = [
        f"{x:.2f},{y:.2f}"
        for x, y in utm_metres([point.place for point in stage.points], mission.origin)
    ]
    speed = f"{mission.speed:g}"
    if stage.stays:
        kind = "BHV_StationKeep"
        own = [
            ("station_pt", spots[0]),
            ("inner_radius", "5"),
            ("outer_radius", "20"),
            ("outer_speed", speed),
            ("duration", str(whole_seconds(stage.points[0].hold))),
            ("duration_idle_decay", "false"),
        ]
    else:
        kind = "BHV_Waypoint"
        own = [
            ("speed", speed),
            ("capture_radius", "5"),
            ("slip_radius", "15"),
            ("capture_line", "true"),
            ("order", "normal"),
            ("repeat", "0"),
            ("points", " : ".join(spots)),
        ]
    names = ", ".join(label(point.name) for point in stage.points if point.name)
    moving = [("name", f"move_{number}"), *shared, *(("endflag", flag) for flag in flags), *own]
    depth = [("name", f"depth_{number}"), *shared, ("duration", "no-time-limit")]
    depth += [("depth", f"{stage.points[0].depth:g}")]
    remark = [f"// stage {number}: {names}" if names else f"// stage {number}"]
    return ["", *remark, *_behaviour(kind, moving)[1:], *_behaviour("BHV_ConstantDepth", depth)]


def _behaviour(kind: str, settings: Settings) -> list[str]:
    lines = [f"  {key} = {value}" for key, value in settings]
    return ["", f"Behavior = {kind}", "{", *lines, "}"]


def _parsed(text: str) -> list[tuple[str, Settings]]:
    """Kind and settings of every behaviour."""
    lines = "\n".join(line for line in text.splitlines() if not line.startswith("//"))
    found = re.findall(r"^Behavior = (\w+)\n\{\n(.*?)^\}$", lines, re.MULTILINE | re.DOTALL)
    return [(kind, [_setting(line) for line in body.splitlines()]) for kind, body in found]


def _setting(line: str) -> tuple[str, str]:
    key, _, value = line.strip().partition(" = ")
    return key, value
