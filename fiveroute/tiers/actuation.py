"""Tier 4, the actuation tier: what a leg takes when it is sailed.

The actuation tier tracks the path of tier 3 and meets the ocean as it is. The paper's own
abstraction of it is equation (12): an AUV that was to take t_ij seconds takes

    f(t_ij) = max(floor t_ij, t_ij + dt_c + dt_m),

where the current adds the Gaussian dt_c ~ N(0, (drift t_ij)^2), and manoeuvres round
obstacles that nobody foresaw add dt_m = K times a fixed time, K being Poisson distributed with
a mean in proportion to the length of the leg. The floor, which the paper does not have, keeps
times positive. Far above it

    E f = t_ij + rate length manoeuvre_time,
    Var f = (drift t_ij)^2 + rate length manoeuvre_time^2,

which is what an AUV that knows the law, but not its luck, expects of a leg. The vehicle that the
law stands for is `fiveroute.vehicle`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.generate import DEFAULT_UNCERTAINTY
from fiveroute.instance import Instance, Uncertainty
from fiveroute.kernels import kernel

__all__ = [
    "LegLaw",
    "actual_leg",
    "expected_legs",
    "leg_law",
    "manoeuvre_count",
    "overruns",
    "uncertainty_of",
]

Floats = NDArray[np.float64]


class LegLaw(NamedTuple):
    """The distribution (12) of every leg, as kernels take it.

    Parameters
    ----------
    planned
        Planned leg times t_ij in seconds, shape (n + 2, n + 2).
    encounters
        Mean number of manoeuvres on every leg, same shape.
    drift
        Standard deviation of dt_c as a share of t_ij.
    manoeuvre_time
        Seconds lost in a manoeuvre.
    floor
        Least share of t_ij that a leg can take.
    """

    planned: Floats
    encounters: Floats
    drift: float
    manoeuvre_time: float
    floor: float


def leg_law(planned: ArrayLike, lengths_km: ArrayLike, uncertainty: Uncertainty) -> LegLaw:
    """The law of every leg.

    Parameters
    ----------
    planned
        Planned leg times t_ij in seconds, shape (n + 2, n + 2).
    lengths_km
        Lengths of the legs in kilometres, same shape.
    uncertainty
        The two terms of (12).
    """
    return LegLaw(
        np.array(planned, dtype=np.float64),
        uncertainty.manoeuvres_per_km * np.array(lengths_km, dtype=np.float64),
        float(uncertainty.drift),
        float(uncertainty.manoeuvre_time),
        float(uncertainty.floor),
    )


def uncertainty_of(instance: Instance) -> Uncertainty:
    """The terms of (12) of an instance, or, where it states none, `DEFAULT_UNCERTAINTY`."""
    stated = instance.uncertainty
    return DEFAULT_UNCERTAINTY if stated == Uncertainty() else stated


def expected_legs(law: LegLaw) -> tuple[Floats, Floats]:
    """Mean in seconds and variance in s^2 of every leg, the floor left out of account."""
    mean = law.planned + law.encounters * law.manoeuvre_time
    variance = (law.drift * law.planned) ** 2 + law.encounters * law.manoeuvre_time**2
    return mean, variance


def overruns(law: LegLaw, j: int, times: Floats) -> Floats:
    """Probabilities that the leg from each vertex to j takes longer, shape (n + 2, len(times))."""
    from scipy.special import ndtr

    planned, mean = law.planned[:, j, None], law.encounters[:, j, None]
    deviation = np.maximum(law.drift * planned, 1e-9)
    late, probability = np.zeros((len(planned), len(times))), np.exp(-mean)
    most = float(mean.max())
    for count in range(math.ceil(most + 6.0 * math.sqrt(most)) + 6):
        spare = times - planned - count * law.manoeuvre_time
        late += probability * ndtr(-spare / deviation)
        probability = probability * mean / (count + 1)
    return np.where(law.floor * planned > times, 1.0, late)


@kernel
def actual_leg(law: LegLaw, i: int, j: int, normal: float, manoeuvres: int) -> float:
    """f(t_ij) in seconds, (12), for a standard normal number and a number of manoeuvres."""
    planned = law.planned[i, j]
    late = normal * law.drift * planned + manoeuvres * law.manoeuvre_time
    return float(max(law.floor * planned, planned + late))


@kernel
def manoeuvre_count(mean: float, uniform: float, normal: float) -> int:
    """A Poisson number by inversion of a uniform one; normal where its mean is large."""
    if mean > 100.0:
        return max(round(mean + math.sqrt(mean) * normal), 0)
    probability = math.exp(-mean)
    reached, count = probability, 0
    while uniform > reached and probability > 0.0:
        count += 1
        probability *= mean / count
        reached += probability
    return count
