"""Members of an ensemble: oceans that may be, and what planned paths take in them.

A member is a file of a forecast centre's ensemble, or a truth drawn from the vortices of the
instance. Files may have grids, times and variables of their own: each is read at the moment and
in the metres of the mission. Where the instance does not state these, they are the first time and
the middle of its own file, or of the first member, so that all members are of one place and time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.instance import Currents, Instance
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.currents import LambVortices, Superposition
from fiveroute.ocean.obstacles import refuse_points_inside
from fiveroute.ocean.stated import filed_current, stated_barriers, stated_current
from fiveroute.ocean.uncertain_ocean import VortexUncertainty, draw_truth
from fiveroute.paths.legs import track_clearance, track_time
from fiveroute.paths.stated_waters import waters_of
from fiveroute.paths.voyage import Voyage

__all__ = ["drawn_members", "filed_members", "lost_share", "member_times"]

Floats = NDArray[np.float64]

_ANYWHERE = Region(-math.inf, -math.inf, math.inf, math.inf)._asdict()


def filed_members(instance: Instance, files: Sequence[Path], folder: Path) -> list[Superposition]:
    """Members that files of currents hold, each in the place of the instance's own.

    Parameters
    ----------
    instance
        The mission.
    files
        CF netCDF files.
    folder
        Folder that names in the instance are relative to.

    Raises
    ------
    InputError
        If a file cannot be read as a current, does not hold the time of the mission, or has no
        data at a stop, or land there.
    """
    stated = instance.ocean.currents
    first = files[0].absolute() if stated.file is None else folder / stated.file
    own = filed_current(_with(instance, replace(stated, file=str(first))))
    assert own is not None
    times, begin = own.coverage.time, stated.begin
    if begin is None and times is not None:
        begin = str(times[0].astype("datetime64[s]"))
    placed = replace(instance, crs=instance.crs or own.plane.proj)
    members = []
    for file in files:
        member = _with(placed, replace(stated, file=str(file.absolute()), begin=begin))
        members.append(stated_current(member))
        _require_stops(member, members[-1], file)
    return members


def _with(instance: Instance, currents: Currents) -> Instance:
    return replace(instance, ocean=replace(instance.ocean, currents=currents))


def _require_stops(instance: Instance, member: Superposition, file: Path) -> None:
    """Refuse a member without data or with land at a stop."""
    try:
        member(*instance.points.T)
        refuse_points_inside(instance, stated_barriers(instance, member))
    except InputError as error:
        raise error.at(file) from error.__cause__


def drawn_members(
    instance: Instance,
    count: int,
    uncertainty: VortexUncertainty,
    rng: np.random.Generator,
    folder: Path | None = None,
) -> list[Superposition]:
    """Truths drawn from the vortices of an instance; its other currents stay as they are.

    Parameters
    ----------
    instance
        The mission.
    count
        Number of members.
    uncertainty
        How far they may be from the instance's current.
    rng
        Random numbers.
    folder
        Folder that names in the instance are relative to.

    Raises
    ------
    InputError
        If the instance states no vortices.
    """
    stated = stated_current(instance, folder)
    vortices = [part for part in stated.parts if isinstance(part, LambVortices)]
    if not vortices:
        raise InputError(
            "states none to draw from; name the files of an ensemble",
            field="ocean.currents.vortices",
        )
    others = tuple(part for part in stated.parts if not isinstance(part, LambVortices))
    low, high = instance.points.min(axis=0), instance.points.max(axis=0)
    region = (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
    return [
        Superposition((*others, *(draw_truth(each, uncertainty, region, rng) for each in vortices)))
        for _ in range(count)
    ]


def member_times(voyage: Voyage, member: Superposition) -> Floats:
    """What the planned paths of all legs take in another current, in seconds, shape (n + 2, n + 2).

    A leg that meets a current too strong there, or the member's own land or the end of its data, is
    infinitely long. Without planned paths legs are straight.
    """
    instance = voyage.instance
    waters = waters_of(instance, member)
    barriers = waters.barriers._replace(**_ANYWHERE)
    times = np.full((len(instance.points),) * 2, np.inf)
    np.fill_diagonal(times, 0.0)
    for leg, track in _tracks(voyage):
        if track_clearance(barriers, track) >= 0.0:
            times[leg] = track_time(waters.grid, track, 0.0, waters.speed)
    return times


def lost_share(voyage: Voyage, times: Floats) -> float:
    """Share of the planned legs that cannot be sailed with the leg times of a member."""
    planned = voyage.instance.travel if voyage.travel is None else voyage.travel
    is_leg = ((planned > 0.0) & np.isfinite(planned))[:-1, 1:]
    return float(np.isinf(times[:-1, 1:][is_leg]).sum() / max(is_leg.sum(), 1))


def _tracks(voyage: Voyage) -> Iterable[tuple[tuple[int, int], Floats]]:
    """Waypoints of every leg in metres."""
    if voyage.legs is not None:
        return voyage.legs.planned_tracks()
    points = voyage.instance.points
    last = len(points) - 1
    legs = ((i, j) for i in range(last) for j in range(1, last + 1) if i != j)
    return ((leg, points[list(leg)]) for leg in legs)
