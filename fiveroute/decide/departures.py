"""When to leave? The same mission at different times of a forecast.

A plan takes the current as it is when the mission begins, so that the times to compare should lie
no closer than the current takes to change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

from fiveroute.decide.sweep import Row, Sweep, figures, vary
from fiveroute.errors import InputError
from fiveroute.fleet_planning import plan
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import Bounding

__all__ = ["begin_after", "sweep_departures"]

_HOUR = 3600.0


def sweep_departures(
    instance: Instance,
    hours: Sequence[float],
    *,
    fleet_size: int | None = None,
    bound: Bounding = "quick",
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> Sweep:
    """Plan a mission for different departures.

    Parameters
    ----------
    instance
        A mission with a file of currents.
    hours
        Departures, in hours after the one that the instance states, or else the file's first time.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it.
    bound
        Where the upper bounds come from.
    limits
        When to stop, shared among the departures.
    seed
        Seed of the random numbers.
    progress
        Told what is at work.
    folder
        Folder that the name of the file is relative to.

    Raises
    ------
    InputError
        If there is no file of currents, or a departure lies beyond its times.
    """
    first = _stated_begin(instance, folder or Path())

    def row(after: float, limits: Limits) -> Row:
        begin = begin_after(first, after)
        currents = replace(instance.ocean.currents, begin=begin)
        mission = replace(instance, ocean=replace(instance.ocean, currents=currents))
        planned = plan(
            mission, fleet_size=fleet_size, bound=bound, limits=limits, seed=seed, folder=folder
        )
        return {"departure": begin, "fleet_size": planned.fleet_size, **figures(planned)}

    clock = (limits or Limits()).start()
    sweep = vary(instance.name, "hours", "h", hours, row, clock=clock, progress=progress)
    best = sweep.best("completion_rate")
    return sweep if best is None else sweep.marking(best["hours"], f"best, {best['departure']} UTC")


def begin_after(first: datetime, hours: float) -> str:
    """A time some hours after another, as an instance states it."""
    moment = first + timedelta(seconds=round(hours * _HOUR))
    return moment.astimezone(UTC).replace(tzinfo=None).isoformat(timespec="seconds")


def _stated_begin(instance: Instance, folder: Path) -> datetime:
    """When the instance's mission begins."""
    currents = instance.ocean.currents
    if currents.file is None:
        raise InputError(
            "needs a forecast that varies; name a CF netCDF file of currents",
            field="ocean.currents.file",
        )
    if currents.begin is not None:
        moment = datetime.fromisoformat(currents.begin)
        return moment if moment.tzinfo is not None else moment.replace(tzinfo=UTC)
    from fiveroute.ocean.model_current import read_current

    current = read_current(folder / currents.file, origin=instance.origin, depth=currents.depth)
    times = current.coverage().time
    if times is None:
        raise InputError(
            "holds a single time; a file of several is needed", field="ocean.currents.file"
        )
    return datetime.fromisoformat(str(times[0].astype("datetime64[s]"))).replace(tzinfo=UTC)
