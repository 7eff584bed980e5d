"""Luck that is sailed: every leg by the vehicle model, in the true ocean of its run.

The ocean of a run is drawn from seed and run alone, and is the same for all AUVs and all planners.
In a current that does not vary the time of a leg is a pure function of seed, run and leg, as it is
by (12) (`fiveroute.sea.luck`), and a leg is sailed once in a run. Each leg begins at its stop, at
speed and on its track's heading.

Only discs near the track are looked at; a vehicle that strays so far that others could have
mattered sails again among all.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path as File

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.limits import Limits
from fiveroute.ocean.barriers import Barriers, distance_to_leg
from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.voyage import Voyage
from fiveroute.sea.luck import Leg
from fiveroute.sea.seeds import Purpose, generator
from fiveroute.tiers.actuation import uncertainty_of
from fiveroute.vehicle.dynamics import Vehicle
from fiveroute.vehicle.fit import Fit, SailedLegs, drift_of_walks, fit_uncertainty, sail_legs
from fiveroute.vehicle.guidance import Guidance
from fiveroute.vehicle.obstacle_avoidance import Avoidance
from fiveroute.vehicle.sailed_track import Outcome, SailedTrack
from fiveroute.vehicle.tracking import sail_track
from fiveroute.vehicle.true_ocean import Forecast, TrueOcean
from fiveroute.vehicle.unknown_obstacles import near_track

__all__ = ["SailedLuck", "VehicleModel"]

Floats = NDArray[np.float64]
Arc = tuple[int, int]

_CORRIDOR = 150.0
"""Metres to each side of a track within which discs are looked at, besides the sonar's reach."""

_OVERTIME = 1.5
"""Endurances for which a current that varies is known; it stays as it is thereafter."""

_STRIDES = 3
"""Legs of a walk that the fit is made of, besides the leg home."""

_LEAST = 5
"""Oceans that a fit is made in at least."""

_NEIGHBOURS = 6
"""They lead to one of so many nearest stops, as the legs of routes do."""


@dataclass(frozen=True, slots=True, eq=False)
class VehicleModel:
    """How legs are sailed: what all runs have in common.

    Parameters
    ----------
    forecast
        What is known of the ocean.
    vehicle, guidance, avoidance
        The vehicle, how it keeps to a track, and how it avoids obstacles.
    legs
        The planned tracks; None for straight lines between the stops.
    """

    forecast: Forecast
    vehicle: Vehicle
    guidance: Guidance = field(default_factory=Guidance)
    avoidance: Avoidance = field(default_factory=Avoidance)
    legs: LegTable | None = None

    @classmethod
    def of(cls, voyage: Voyage, folder: File | None = None) -> VehicleModel:
        """The vehicle of a mission, in the ocean that its legs were planned in.

        Parameters
        ----------
        voyage
            The mission and its legs. Where they are straight lines in still water, nothing of
            the stated ocean is there.
        folder
            Folder that the name of the file of currents is relative to.
        """
        instance = voyage.instance
        if instance.travel_times is not None:
            raise InputError(
                "a vehicle sails from position to position, not by a table of times; simulate "
                "with --actuation abstraction",
                field="travel_times",
            )
        stops, speed = instance.points, instance.fleet.speed
        grid = barriers = None
        if voyage.legs is not None:
            from fiveroute.ocean.stated import stated_current
            from fiveroute.paths.stated_waters import waters_of

            longest = float(np.max(instance.fleet.endurance or 0.0))
            current = stated_current(voyage.mission, folder)
            waters = waters_of(voyage.mission, current, duration=_OVERTIME * longest)
            grid, barriers = waters.grid, waters.barriers
        rough = uncertainty_of(instance)
        forecast = Forecast.of(grid, barriers, stops, speed, rough)
        return cls(forecast, Vehicle(speed), legs=voyage.legs)

    @property
    def is_steady(self) -> bool:
        """Whether it makes no difference when a leg begins."""
        return self.forecast.grid.is_steady

    def ocean(self, seed: int, run: int) -> TrueOcean:
        """The ocean of a run."""
        rng = generator(Purpose.OCEAN, seed, run)
        return self.forecast.truth(rng, self.avoidance.standoff)

    def track(self, i: int, j: int) -> Floats:
        """The planned track of a leg: waypoints in metres, shape (k, 2).

        Raises
        ------
        KeyError
            If the leg cannot be sailed by plan.
        """
        return self.forecast.stops[[i, j]] if self.legs is None else self.legs.track(i, j)

    def sail(self, ocean: TrueOcean, i: int, j: int, begin: float = 0.0) -> SailedTrack:
        """Sail a leg that begins at a time in seconds."""
        track = self.track(i, j)
        for barriers in (self._near(ocean.barriers, track), ocean.barriers):
            sailed = sail_track(
                ocean.grid,
                track,
                self.vehicle,
                barriers=barriers,
                guidance=self.guidance,
                avoidance=self.avoidance,
                begin=begin,
            )
            if not _strays(sailed.positions, track, _CORRIDOR):
                break
        return sailed

    def fit(
        self,
        planned: Floats,
        *,
        seed: int = 0,
        oceans: int = 120,
        walks: int = 2,
        limits: Limits | None = None,
    ) -> Fit:
        """What (12) should assume of legs such as routes are made of.

        (12) takes legs for independent, but the legs of a route follow each other through the same
        water. So walks home of several legs are sailed, which are what a reserve is for, and the
        drift is that of `drift_of_walks`.

        Parameters
        ----------
        planned
            Planned leg times t in seconds, shape (n + 2, n + 2).
        seed
            Seed of the oceans and of the choice of legs; not that of a simulation.
        oceans, walks
            Number of oceans, and of walks sailed in each.
        limits
            When to stop; the fit is made of the walks that were sailed, five oceans' at least.
        """
        clock, rng = (limits or Limits()).start(), generator(Purpose.WALKS, seed)
        if self.legs is not None:
            planned = np.where(np.isfinite(self.legs.times), planned, np.inf)
        sailed: list[SailedLegs] = []
        for run in range(oceans):
            if run >= _LEAST and clock.expired:
                break
            ocean = self.ocean(seed, run)
            ways = (_walk(planned, rng) for _ in range(walks))
            sailed += [self._both_ways(ocean, way, planned) for way in ways]
        together = _joined(sailed)
        fit = fit_uncertainty(together)
        walk = np.repeat(np.arange(len(sailed)), [len(legs.planned) for legs in sailed])
        return replace(fit, drift=drift_of_walks(together, walk, fit.delay.value))

    def _both_ways(self, ocean: TrueOcean, legs: Sequence[Arc], planned: Floats) -> SailedLegs:
        """Legs sailed without and with unknown obstacles."""
        tracks = [self.track(*leg) for leg in legs]
        return sail_legs(
            tracks,
            [float(planned[leg]) for leg in legs],
            [ocean.grid] * len(legs),
            [self._near(ocean.barriers, track) for track in tracks],
            self.vehicle,
            guidance=self.guidance,
            avoidance=self.avoidance,
        )

    def _near(self, barriers: Barriers, track: Floats) -> Barriers:
        """Barriers without the discs that are far from a track."""
        within = _CORRIDOR + self.avoidance.sonar.reach
        return barriers._replace(circles=near_track(barriers.circles, track, within))


class SailedLuck:
    """The real leg times of one run, by the vehicle.

    Parameters
    ----------
    model
        How legs are sailed.
    seed, run
        Seed of the whole simulation, and number of the run, counted from 0.
    """

    def __init__(self, model: VehicleModel, seed: int, run: int) -> None:
        self.model, self.seed, self.run = model, seed, run
        self.ocean = model.ocean(seed, run)
        self.least_clearance = math.inf
        self.collisions = 0
        self._legs: dict[tuple[int, int, float], Leg] = {}

    def leg(self, i: int, j: int, begin: float = 0.0) -> Leg:
        """What the leg from i to j takes that begins at a time in seconds."""
        begin = 0.0 if self.model.is_steady else begin
        leg = self._legs.get((i, j, begin))
        if leg is None:
            leg = self._legs[i, j, begin] = self._sailed(i, j, begin)
        return leg

    def _sailed(self, i: int, j: int, begin: float) -> Leg:
        try:
            track = self.model.sail(self.ocean, i, j, begin)
        except KeyError:
            return Leg(0.0, arrives=False)  # no path is known
        self.least_clearance = min(self.least_clearance, track.least_clearance)
        self.collisions += track.outcome is Outcome.COLLIDED
        number = track.manoeuvre
        begun = np.flatnonzero((number[1:] > 0) & (number[1:] != number[:-1])) + 1
        moments = tuple((track.times[begun] - track.times[0]).tolist())
        return Leg(track.duration, moments, track.outcome is Outcome.ARRIVED)


@kernel
def _strays(positions: Floats, track: Floats, within: float) -> bool:
    """Whether any position is farther than so many metres from the track."""
    nearest = 0
    for p in range(len(positions)):
        x, y = positions[p]
        for turn in range(len(track)):
            if turn == len(track) - 1:
                return True
            k = (nearest + turn) % (len(track) - 1)
            x0, y0, x1, y1 = track[k, 0], track[k, 1], track[k + 1, 0], track[k + 1, 1]
            if distance_to_leg(x, y, x0, y0, x1, y1) <= within:
                nearest = k
                break
    return False


def _walk(planned: Floats, rng: np.random.Generator) -> list[Arc]:
    """Legs that follow each other from stop to near stop, each nearer to home, and then home."""
    home, legs = len(planned) - 1, []
    tail = int(rng.integers(home))
    for _ in range(_STRIDES):
        nearer = planned[:, home] < planned[tail, home]
        nearer[0] = False  # nobody goes back to the start
        times = np.where(nearer & (planned[tail] > 0.0), planned[tail], math.inf)
        near = [head for head in np.argsort(times)[:_NEIGHBOURS].tolist() if times[head] < math.inf]
        if not near:
            break
        head = near[int(rng.integers(len(near)))]
        legs.append((tail, head))
        tail = head
    if 0.0 < planned[tail, home] < math.inf:
        legs.append((tail, home))
    return legs


def _joined(parts: Sequence[SailedLegs]) -> SailedLegs:
    """All legs one after the other."""
    return SailedLegs(
        *(
            np.concatenate([getattr(part, column.name) for part in parts])
            for column in fields(SailedLegs)
        )
    )
