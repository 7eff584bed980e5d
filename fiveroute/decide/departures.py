"""When to leave? The same mission at different times of a forecast.

A plan takes the current as it is when the mission begins, so that the times to compare should lie
no closer than the current takes to change.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

from fiveroute.decide.sweep import Row, Sweep, figures, shown, vary
from fiveroute.errors import InputError
from fiveroute.fleet_planning import plan
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import Bounding
from fiveroute.ocean.stated import filed_current

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
        Number of AUVs; None takes that of the instance, or else the estimate for the first
        departure.
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
    moments = dict(zip(hours, _moments(instance, hours, folder), strict=True))
    size = fleet_size

    def row(after: float, limits: Limits) -> Row:
        nonlocal size
        currents = replace(instance.ocean.currents, begin=moments[after])
        mission = replace(instance, ocean=replace(instance.ocean, currents=currents))
        planned = plan(
            mission, fleet_size=size, bound=bound, limits=limits, seed=seed, folder=folder
        )
        size = planned.fleet_size  # the fleet is the same, whenever it leaves
        return {"departure": moments[after], "fleet_size": size, **figures(planned)}

    clock = (limits or Limits()).start()
    sweep = vary(instance.name, "hours", "h", hours, row, clock=clock, progress=progress)
    best = sweep.best("completion_rate", least="mean_duration")
    if best is None:
        return sweep
    return sweep.marking(best["hours"], f"best, {shown('departure', best['departure'])} UTC")


def begin_after(first: datetime, hours: float) -> str:
    """A time some hours after another, as an instance states it."""
    moment = first + timedelta(seconds=round(hours * _HOUR))
    return moment.astimezone(UTC).replace(tzinfo=None).isoformat(timespec="seconds")


def _moments(instance: Instance, hours: Sequence[float], folder: Path | None) -> list[str]:
    """The departures as an instance states them, if the file has them all."""
    forecast = filed_current(instance, folder)
    if forecast is None:
        raise InputError(
            "needs a forecast that varies; name a CF netCDF file of currents",
            field="ocean.currents.file",
        )
    times = forecast.coverage.time
    if times is None or forecast.is_steady:
        raise InputError(
            "holds a single time; a file of several is needed", field="ocean.currents.file"
        )
    first, last = (str(time.astype("datetime64[s]")) for time in times)
    begin = datetime.fromisoformat(instance.ocean.currents.begin or first)
    begin = begin if begin.tzinfo is not None else begin.replace(tzinfo=UTC)
    moments = [begin_after(begin, after) for after in hours]
    for after, moment in zip(hours, moments, strict=True):
        if not first <= moment <= last:
            raise InputError(
                f"is {moment} UTC, beyond the forecast; choose hours from {first} to {last} UTC",
                field="hours",
                value=after,
            )
    return moments
