"""The abstraction (12) fitted to what the vehicle does, so that plans reckon with it.

Each leg is sailed twice in the same true current, without the unknown obstacles (f_0 seconds) and
with them (f_1 seconds, K manoeuvres). Of a leg planned for t seconds and l kilometres, (12) says

    f_0 = t + N(0, (drift t)^2),    f_1 = f_0 + K manoeuvre_time,    K ~ Poisson(rate l).

Maximum likelihood gives drift^2 as the mean of ((f_0 - t) / t)^2 and the rate as all manoeuvres
over all kilometres; least squares weighted with 1 / K, which a sum of K independent losses has as
its variance, give manoeuvre_time as all seconds lost over all manoeuvres. The Gaussian term
of (12) has mean 0: a vehicle that is late on the average adds to the drift, and the mean delay
is told besides, so that it can be seen how much of the drift it is.

Legs that are sailed one after the other are late together. `drift_of_walks` therefore takes the
drift with which independent legs would scatter together as walks of several legs do. And in a
current that the plan did not know it is the pace t / f_0 that is nearly normal, with a mean
and a standard deviation that hardly depend on t; the time f_0 has a far heavier upper tail, which
counts where nothing can be corrected any more.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.instance import Uncertainty
from fiveroute.ocean.barriers import Barriers
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.vehicle.dynamics import Vehicle
from fiveroute.vehicle.guidance import Guidance
from fiveroute.vehicle.obstacle_avoidance import Avoidance
from fiveroute.vehicle.sailed_track import Outcome, SailedTrack
from fiveroute.vehicle.tracking import sail_track

__all__ = ["Estimate", "Fit", "SailedLegs", "drift_of_walks", "fit_uncertainty", "sail_legs"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class SailedLegs:
    """Legs as planned and as sailed; all arrays have the shape (legs,).

    Parameters
    ----------
    planned
        Planned times t in seconds.
    lengths_km
        Lengths l in kilometres.
    unhindered
        Times f_0 in seconds without unknown obstacles; infinite where a vehicle did not arrive.
    sailed
        Times f_1 in seconds with them; likewise.
    manoeuvres
        Numbers K of avoidance manoeuvres.
    """

    planned: Floats
    lengths_km: Floats
    unhindered: Floats
    sailed: Floats
    manoeuvres: NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Estimate:
    """An estimate and its standard error."""

    value: float
    error: float


@dataclass(frozen=True, slots=True)
class Fit:
    """What (12) should assume of a vehicle.

    Parameters
    ----------
    drift, manoeuvres_per_km, manoeuvre_time
        Its parameters, as `Uncertainty` has them.
    delay
        Mean of (f_0 - t) / t: what the plan leaves out on the average.
    pace, scatter
        Mean and standard deviation of t / f_0, which is 0 for a leg that was not sailed to its end.
    legs
        Number of legs that were sailed to their ends both ways, and enter the fit.
    failed
        Number of legs that were not.
    """

    drift: Estimate
    manoeuvres_per_km: Estimate
    manoeuvre_time: Estimate
    delay: Estimate
    pace: Estimate
    scatter: Estimate
    legs: int
    failed: int

    @property
    def uncertainty(self) -> Uncertainty:
        """To plan with."""
        return Uncertainty(
            drift=self.drift.value,
            manoeuvres_per_km=self.manoeuvres_per_km.value,
            manoeuvre_time=max(self.manoeuvre_time.value, 0.0),
        )


def sail_legs(
    tracks: Sequence[Floats],
    planned: Sequence[float],
    grids: Sequence[CurrentGrid],
    barriers: Sequence[Barriers],
    vehicle: Vehicle,
    *,
    guidance: Guidance | None = None,
    avoidance: Avoidance | None = None,
) -> SailedLegs:
    """Sail each leg without and with its unknown obstacles.

    Parameters
    ----------
    tracks, planned
        Waypoints of each leg in metres, shape (k, 2), and its planned time in seconds.
    grids, barriers
        The true current and the obstacles of each leg.
    vehicle, guidance, avoidance
        As for `sail_track`.
    """
    free, hindered = (
        [
            sail_track(grid, track, vehicle, barriers=there, guidance=guidance, avoidance=avoidance)
            for track, grid, there in zip(tracks, grids, places, strict=True)
        ]
        for places in ([None] * len(tracks), barriers)
    )
    return SailedLegs(
        np.array(planned, dtype=np.float64),
        np.array([np.hypot(*np.diff(track, axis=0).T).sum() / 1000.0 for track in tracks]),
        np.array([_time(leg) for leg in free]),
        np.array([_time(leg) for leg in hindered]),
        np.array([leg.manoeuvres for leg in hindered], dtype=np.int64),
    )


def fit_uncertainty(legs: SailedLegs) -> Fit:
    """Estimate the parameters of (12) from legs that were sailed."""
    done = np.isfinite(legs.unhindered) & np.isfinite(legs.sailed)
    count = int(done.sum())
    if count < 2:
        raise InputError(
            "takes two legs at least that were sailed to their ends", field="legs", value=count
        )
    share = (legs.unhindered - legs.planned)[done] / legs.planned[done]
    manoeuvres, kilometres = legs.manoeuvres[done], float(legs.lengths_km[done].sum())
    lost, total = legs.sailed[done] - legs.unhindered[done], int(manoeuvres.sum())
    drift, each = math.sqrt(float((share**2).mean())), float(lost.sum()) / max(total, 1)
    residuals = lost - each * manoeuvres
    pace, tried = legs.planned / legs.unhindered, len(done)
    scatter = float(pace.std())
    return Fit(
        Estimate(drift, drift / math.sqrt(2.0 * count)),
        Estimate(total / kilometres, math.sqrt(max(total, 1)) / kilometres),
        Estimate(each, math.sqrt(float((residuals**2).sum())) / max(total, 1)),
        Estimate(float(share.mean()), float(share.std(ddof=1)) / math.sqrt(count)),
        Estimate(float(pace.mean()), scatter / math.sqrt(tried)),
        Estimate(scatter, scatter / math.sqrt(2.0 * tried)),
        count,
        len(done) - count,
    )


def drift_of_walks(legs: SailedLegs, walk: NDArray[np.int64], delay: float) -> Estimate:
    """The drift of independent legs that scatter together as walks of legs do.

    It is the root of the mean over all walks of (sum of f_0 - (1 + delay) t)^2 / sum of t^2.

    Parameters
    ----------
    legs
        Legs of all walks.
    walk
        Number of the walk of each leg, counted from 0, shape (legs,).
    delay
        Mean of (f_0 - t) / t.
    """
    arrived = np.isfinite(legs.unhindered)
    planned, of = legs.planned[arrived], np.unique(walk[arrived], return_inverse=True)[1]
    late = np.bincount(of, legs.unhindered[arrived] - (1.0 + delay) * planned)
    drift = math.sqrt(float((late**2 / np.bincount(of, planned**2)).mean()))
    return Estimate(drift, drift / math.sqrt(2.0 * len(late)))


def _time(leg: SailedTrack) -> float:
    return leg.duration if leg.outcome is Outcome.ARRIVED else math.inf
