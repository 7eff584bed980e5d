"""How fast? The energy of an AUV, and what a fleet collects at every speed.

An AUV at speed v through the water draws

    P(v) = P_hotel + k v^3,     T_max(v) = E / P(v),

the power of its electronics and sensors, whether it moves or not, and that of its propulsion
against a drag that grows as v^2. In still water it goes farthest at v* = (P_hotel / (2 k))^(1/3),
where propulsion takes half of what the hotel takes; a head current moves the best speed up.

The default hotel and propulsion are those of a small survey vehicle of the REMUS 100's kind: a drag
of 1.62 v^2 newtons (Prestero 2001, doi 10.1575/1912/3040) at 40 % of efficiency, and 30 W besides,
which makes a kilowatt-hour last for 23 hours at 1.5 m/s. The battery is by default the one that
gives the endurance of the instance at its speed.

Source of the model: A. M. Bradley, M. D. Feezor, H. Singh, F. Y. Sorrell, "Power systems for
autonomous underwater vehicles", IEEE Journal of Oceanic Engineering 26 (2001), 526 to 538, doi
10.1109/48.972089.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from fiveroute.decide.sweep import Row, Sweep, figures, vary
from fiveroute.errors import InputError
from fiveroute.fleet_planning import plan, sail
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import Bounding
from fiveroute.tiers.preplanning import fleet_size_of

__all__ = ["PowerModel", "sweep_speeds"]

_JOULE = 3600.0  # of a watt-hour


@dataclass(frozen=True, slots=True)
class PowerModel:
    """What an AUV draws, and what its battery holds.

    Parameters
    ----------
    hotel
        P_hotel in watts.
    propulsion
        k in watts at one metre per second.
    """

    hotel: float = 30.0
    propulsion: float = 4.05

    def __post_init__(self) -> None:
        for name in ("hotel", "propulsion"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise InputError(
                    "must be a positive number of watts", field=name, value=getattr(self, name)
                )

    def power(self, speed: float) -> float:
        """P(v) in watts."""
        return self.hotel + self.propulsion * speed**3

    def endurance(self, battery: float, speed: float) -> float:
        """T_max(v) in seconds with a battery in watt-hours."""
        return battery * _JOULE / self.power(speed)


def sweep_speeds(
    instance: Instance,
    speeds: Sequence[float],
    *,
    power: PowerModel | None = None,
    battery: float | None = None,
    fleet_size: int | None = None,
    bound: Bounding = "quick",
    straight_lines: bool = False,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> Sweep:
    """Plan a mission at different speeds, each with the endurance that its power leaves.

    Parameters
    ----------
    instance
        The mission.
    speeds
        Speeds through the water in metres per second.
    power
        What the AUVs draw.
    battery
        Watt-hours of every AUV; None takes what the endurance of the instance needs.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it for its own speed.
    bound
        Where the upper bounds come from.
    straight_lines
        Whether to ignore the ocean.
    limits
        When to stop, shared among the speeds.
    seed
        Seed of the random numbers.
    progress
        Told what is at work.
    folder
        Folder that the name of the file of currents is relative to.

    Raises
    ------
    InputError
        If a speed or the battery is not positive, or the endurance is unlimited and no battery
        is given.
    """
    for speed in speeds:
        _require_positive("speeds", speed)
    power = power or PowerModel()
    batteries = _batteries(instance, power, battery)
    clock = (limits or Limits()).start()
    size = fleet_size or instance.fleet_size
    if size is None:
        voyage = sail(
            instance, folder=folder, straight_lines=straight_lines, limits=clock.limits, seed=seed
        )
        rng = np.random.default_rng(seed)
        size = fleet_size_of(voyage.instance, voyage.travel, rng=rng)

    def row(speed: float, limits: Limits) -> Row:
        endurance = [power.endurance(each, speed) for each in batteries]
        is_each = isinstance(instance.fleet.endurance, tuple)
        fleet = replace(
            instance.fleet, speed=speed, endurance=tuple(endurance) if is_each else endurance[0]
        )
        planned = plan(
            replace(instance, fleet=fleet),
            fleet_size=size,
            bound=bound,
            straight_lines=straight_lines,
            limits=limits,
            seed=seed,
            folder=folder,
        )
        return {
            "power": power.power(speed),
            "endurance": float(np.mean(endurance)),
            **figures(planned),
        }

    sweep = vary(instance.name, "speed", "m/s", speeds, row, clock=clock, progress=progress)
    best = sweep.best("objective")
    return sweep if best is None else sweep.marking(best["speed"], "collects most")


def _batteries(instance: Instance, power: PowerModel, stated: float | None) -> list[float]:
    """Watt-hours: those stated for all, or what every endurance of the instance needs."""
    endurance = np.atleast_1d(np.array(instance.fleet.endurance or np.nan, dtype=np.float64))
    if stated is not None:
        _require_positive("battery", stated)
        return [stated] * len(endurance)
    if not np.isfinite(endurance).all():
        raise InputError(
            "is unlimited, so that no battery follows from it; state the watt-hours",
            field="fleet.endurance",
        )
    batteries: list[float] = (endurance * power.power(instance.fleet.speed) / _JOULE).tolist()
    return batteries


def _require_positive(field: str, value: float) -> None:
    if not 0.0 < value < np.inf:
        raise InputError("must be finite and above 0", field=field, value=value)
