"""Sampled leg times, equation (12), and what a planner makes of them.

A real leg takes f(t) = max(floor t, t + dt_c + dt_m) seconds. The current adds the
Gaussian dt_c ~ N(0, (drift t)^2), avoidance manoeuvres add dt_m = K times a fixed time,
with K Poisson of mean rate times length. Far above the floor

    E f = t + rate * length * manoeuvre_time,
    Var f = (drift t)^2 + rate * length * manoeuvre_time^2.

The legs are drawn once for a whole planning run: routes are compared under common random
numbers, sample by sample.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError

if TYPE_CHECKING:
    from fiveroute.instance import Uncertainty

__all__ = ["RouteStatistic", "SampledLegs", "route_times", "sample_legs"]


@dataclass(frozen=True, slots=True)
class RouteStatistic:
    """The figure that stands for the K sampled durations of a route.

    Parameters
    ----------
    quantile
        Share of the samples that may not take longer, at least one half and at most 1;
        None takes their mean.
    """

    quantile: float | None = None

    def __post_init__(self) -> None:
        if self.quantile is not None and not 0.5 <= self.quantile <= 1.0:
            raise InputError(
                "must lie between 0.5 and 1; leave it out to plan with the mean",
                field="quantile",
                value=self.quantile,
            )

    def needed(self, count: int) -> int:
        """Least number of `count` samples that must be in time; 0 where the mean must."""
        if self.quantile is None:
            return 0
        return max(1, math.ceil(self.quantile * count - 1e-9))

    def of(self, times: ArrayLike) -> float:
        """The statistic of sampled durations, shape (K,), in their unit.

        A quantile is one of the samples: the least that `needed` of them do not exceed.
        """
        values = np.asarray(times, dtype=np.float64)
        if self.quantile is None:
            return float(values.mean())
        last = self.needed(len(values)) - 1
        return float(np.partition(values, last)[last])


@dataclass(frozen=True, slots=True, eq=False)
class SampledLegs:
    """Leg times under uncertainty and how a route is judged by them.

    Parameters
    ----------
    legs
        Sampled leg times in seconds, shape (K, n + 2, n + 2).
    statistic
        Mean or quantile.
    """

    legs: NDArray[np.float64]
    statistic: RouteStatistic

    def duration(self, service: NDArray[np.float64], route: Sequence[int]) -> float:
        """Duration of a route in seconds that must keep within the budget."""
        return self.statistic.of(route_times(self.legs, service, route))


def sample_legs(
    travel: ArrayLike,
    lengths_km: ArrayLike,
    uncertainty: Uncertainty,
    count: int,
    rng: np.random.Generator,
) -> NDArray[np.float64]:
    """Draw every leg `count` times, each direction on its own.

    Parameters
    ----------
    travel
        Planned leg times t_ij in seconds, shape (n + 2, n + 2).
    lengths_km
        Lengths of the legs in kilometres, same shape.
    uncertainty
        The two terms of (12).
    count
        Number K of samples.

    Returns
    -------
    array
        Sampled leg times in seconds, shape (count, n + 2, n + 2).
    """
    planned = np.asarray(travel, dtype=np.float64)
    shape = (count, *planned.shape)
    legs: NDArray[np.float64] = rng.standard_normal(shape)
    legs *= uncertainty.drift * planned
    legs += planned
    encounters = uncertainty.manoeuvres_per_km * np.asarray(lengths_km, dtype=np.float64)
    legs += uncertainty.manoeuvre_time * rng.poisson(encounters, shape)
    return np.maximum(legs, uncertainty.floor * planned, out=legs)


def route_times(
    legs: NDArray[np.float64], service: NDArray[np.float64], route: Sequence[int]
) -> NDArray[np.float64]:
    """Sampled durations of a route in seconds, service included, shape (K,).

    Parameters
    ----------
    legs
        Sampled leg times in seconds, shape (K, n + 2, n + 2).
    service
        Service times in seconds, shape (n + 2,).
    route
        Sensor nodes in the order of the visits, without start and destination.
    """
    stops = np.array([0, *route, legs.shape[1] - 1])
    times: NDArray[np.float64] = legs[:, stops[:-1], stops[1:]].sum(axis=1)
    times += service[stops].sum()
    return times
