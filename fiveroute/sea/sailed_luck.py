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
from dataclasses import dataclass, field
from pathlib import Path as File

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, distance_to_leg
from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.voyage import Voyage
from fiveroute.sea.luck import Leg
from fiveroute.tiers.actuation import uncertainty_of
from fiveroute.vehicle.dynamics import Vehicle
from fiveroute.vehicle.fit import Fit, SailedLegs, fit_uncertainty, sail_legs
from fiveroute.vehicle.guidance import Guidance
from fiveroute.vehicle.obstacle_avoidance import Avoidance
from fiveroute.vehicle.sailed_track import Outcome, SailedTrack
from fiveroute.vehicle.tracking import sail_track
from fiveroute.vehicle.true_ocean import Forecast, TrueOcean
from fiveroute.vehicle.unknown_obstacles import near_track

__all__ = ["SailedLuck", "VehicleModel"]

Floats = NDArray[np.float64]

_CORRIDOR = 150.0
"""Metres to each side of a track within which discs are looked at, besides the sonar's reach."""

_OVERTIME = 1.5
"""Endurances for which a current that varies is known; it stays as it is thereafter."""

_EXTREME = 0.02
"""Share of the legs that counts as extreme, on either side."""

_NEIGHBOURS = 6
"""The legs that the fit is made of lead to one of so many nearest stops, as those of routes do."""


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
            from fiveroute.tiers.pathing import waters_of

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
        rng = np.random.default_rng((seed, run, 5))
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

    def fit(self, planned: Floats, *, seed: int = 0, oceans: int = 25, legs: int = 8) -> Fit:
        """What (12) should assume of legs such as routes are made of.

        The one leg in fifty that takes longest for its length, as it barely makes headway, counts
        as the next one does, and so does the one that takes least: the squares of a few would
        make the whole sea look rough.

        Parameters
        ----------
        planned
            Planned leg times in seconds, shape (n + 2, n + 2).
        seed
            Seed of the oceans and of the choice of legs; not that of a simulation.
        oceans, legs
            Number of oceans, and of legs sailed in each.
        """
        rng = np.random.default_rng((seed, 6))
        if self.legs is not None:
            planned = np.where(np.isfinite(self.legs.times), planned, np.inf)
        truths = [self.ocean(seed, run) for run in range(oceans)]
        chosen = [(truth, leg) for truth in truths for leg in _some_legs(planned, legs, rng)]
        tracks = [self.track(*leg) for _, leg in chosen]
        sailed = sail_legs(
            tracks,
            [float(planned[leg]) for _, leg in chosen],
            [truth.grid for truth, _ in chosen],
            [
                self._near(truth.barriers, track)
                for (truth, _), track in zip(chosen, tracks, strict=True)
            ],
            self.vehicle,
            guidance=self.guidance,
            avoidance=self.avoidance,
        )
        return fit_uncertainty(_without_extremes(sailed))

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


def _some_legs(planned: Floats, count: int, rng: np.random.Generator) -> list[tuple[int, int]]:
    """Legs between near stops, of which a path is known."""
    size = len(planned)
    legs = []
    for tail in rng.integers(size - 1, size=count).tolist():
        times = planned[tail].copy()
        times[[0, tail]] = math.inf
        times[times == 0.0] = math.inf  # the same place
        near = [head for head in np.argsort(times)[:_NEIGHBOURS].tolist() if times[head] < math.inf]
        if near:
            legs.append((tail, near[int(rng.integers(len(near)))]))
    return legs


def _without_extremes(legs: SailedLegs) -> SailedLegs:
    """The legs that arrived, their unhindered times within quantiles as shares of the planned."""
    arrived = np.isfinite(legs.unhindered) & np.isfinite(legs.sailed)
    if not arrived.any():
        return legs
    planned, unhindered = legs.planned[arrived], legs.unhindered[arrived]
    share = unhindered / planned
    moderate = planned * share.clip(*np.quantile(share, (_EXTREME, 1.0 - _EXTREME)))
    lost = legs.sailed[arrived] - unhindered
    return SailedLegs(
        planned, legs.lengths_km[arrived], moderate, moderate + lost, legs.manoeuvres[arrived]
    )
