"""Random fields of Lamb vortices, as in the paper's experiments.

Section IV-A prints Gamma ~ N(0, 50) and delta ~ N(80, 100) for its twenty vortices, without units.
Read as m2/s with the standard deviation 50, and as metres with the variance 100 (the standard
deviation 100 would make a fifth of the radii negative), this is `PRINTED`. It is negligible: over
the region of 10 km x 10 km the root mean square of the speed is 0.017 m/s (the mean of 1,500
fields; 0.003 from field to field), which changes the times of legs of 1 km at 1 m/s by 1 %, and
nothing that the paper reports of its currents can come from it. `EFFECTIVE`, twenty times the
circulation and ten times the radius, has 0.21 m/s (0.06) and changes leg times by 17 %.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from fiveroute.errors import InputError
from fiveroute.ocean.currents import LambVortices

__all__ = ["EFFECTIVE", "PRINTED", "VortexKind", "draw_vortices", "normal"]


@dataclass(frozen=True, slots=True)
class VortexKind:
    """How strong and how large vortices are.

    Parameters
    ----------
    circulation
        Distribution of Gamma in m2/s.
    radius
        Distribution of the core radius delta in metres; one metre is the least.
    """

    circulation: NormalDist
    radius: NormalDist


PRINTED = VortexKind(NormalDist(0.0, 50.0), NormalDist(80.0, 10.0))
"""The paper's figures, Section IV-A; negligible: 0.017 m/s in the root mean square."""

EFFECTIVE = VortexKind(NormalDist(0.0, 1000.0), NormalDist(800.0, 100.0))
"""Strong enough to matter: 0.21 m/s in the root mean square."""


def draw_vortices(
    kind: VortexKind,
    count: int,
    region: tuple[float, float, float, float],
    rng: np.random.Generator,
) -> LambVortices:
    """Draw vortices with uniform centres.

    Four uniform numbers are drawn for each vortex whatever its kind: fields of another kind from
    the same seed have the same centres and signs.

    Parameters
    ----------
    kind
        How strong and how large they are.
    count
        Number of vortices.
    region
        West, south, east and north of the rectangle of their centres, in metres.
    rng
        Source of the random numbers.
    """
    if count < 0:
        raise InputError("must not be negative", field="count", value=count)
    west, south, east, north = region
    if not (-math.inf < west <= east < math.inf and -math.inf < south <= north < math.inf):
        raise InputError("must be a finite rectangle", field="region", value=tuple(region))
    x, y, circulation, radius = rng.random((count, 4)).T
    return LambVortices(
        west + (east - west) * x,
        south + (north - south) * y,
        np.array([normal(share, kind.circulation) for share in circulation.tolist()]),
        np.array([max(normal(share, kind.radius), 1.0) for share in radius.tolist()]),
    )


def normal(uniform: float, distribution: NormalDist) -> float:
    """A normal number out of a uniform one in [0, 1)."""
    return distribution.inv_cdf(min(max(uniform, 1e-16), 1.0 - 1e-16))
