"""An uncertain ocean: the forecast that plans are made for is not the truth they are sailed in.

The truth is drawn from the forecast. In a forecast of vortices each vortex is somewhere else,
stronger or weaker than was thought, or not there at all, and there are others that nobody knew
of. An ocean that nobody forecast at all is one with every vortex missing and as many new.

A truth takes the same random numbers for each vortex of the forecast whatever the uncertainty:
twice the displacement moves the same vortices twice as far in the same directions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from fiveroute.errors import InputError
from fiveroute.ocean.currents import LambVortices
from fiveroute.ocean.random_vortices import EFFECTIVE, VortexKind, draw_vortices

__all__ = ["VortexUncertainty", "draw_truth"]


@dataclass(frozen=True, slots=True)
class VortexUncertainty:
    """How far a forecast of vortices may be from the truth. The default is no uncertainty.

    Parameters
    ----------
    displacement
        Standard deviation in metres of the true centre from the forecast one, in x and in y.
    strength
        Standard deviation of the logarithm of the factor from the forecast circulation to the true
        one; the factor is 1 in the mean, and never turns a vortex round.
    missing
        Probability that a vortex of the forecast is not there.
    unforeseen
        Mean number of vortices that the forecast does not know; it is a Poisson number.
    unforeseen_kind
        How strong and how large these are.
    """

    displacement: float = 0.0
    strength: float = 0.0
    missing: float = 0.0
    unforeseen: float = 0.0
    unforeseen_kind: VortexKind = EFFECTIVE

    def __post_init__(self) -> None:
        most = {"displacement": math.inf, "strength": 5.0, "missing": 1.0, "unforeseen": 1e6}
        for field, limit in most.items():
            value = getattr(self, field)
            if not (0.0 <= value <= limit and value < math.inf):
                raise InputError(
                    f"must be finite and from 0 to {limit:g}", field=field, value=value
                )


def draw_truth(
    forecast: LambVortices,
    uncertainty: VortexUncertainty,
    region: tuple[float, float, float, float],
    rng: np.random.Generator,
) -> LambVortices:
    """Draw what the ocean is really like.

    Parameters
    ----------
    forecast
        What is forecast.
    uncertainty
        How far the truth may be from it.
    region
        West, south, east and north of the rectangle of the unforeseen vortices, in metres.
    rng
        Source of the random numbers.
    """
    count = len(forecast.x)
    east, north = uncertainty.displacement * rng.standard_normal((2, count))
    deviation = uncertainty.strength * rng.standard_normal(count)
    factor = np.exp(deviation - uncertainty.strength**2 / 2.0)
    there = rng.random(count) >= uncertainty.missing
    more = draw_vortices(
        uncertainty.unforeseen_kind, int(rng.poisson(uncertainty.unforeseen)), region, rng
    )
    return LambVortices(
        np.concatenate([(forecast.x + east)[there], more.x]),
        np.concatenate([(forecast.y + north)[there], more.y]),
        np.concatenate([(forecast.circulation * factor)[there], more.circulation]),
        np.concatenate([forecast.radius[there], more.radius]),
    )
