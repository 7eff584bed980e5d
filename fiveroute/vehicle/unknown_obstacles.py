"""Obstacles that no plan knew: discs strewn about a track at random.

Their centres are a Poisson process of a given density on all points from which a disc could come
near the track. A vehicle that keeps the distance d from a disc of radius r has to give way on a
straight track if the centre is within r + d of it: on every kilometre of a long track

    density * 2 (E r + d)

discs do, in units of kilometres, Poisson distributed as the manoeuvres of equation (12).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import Barriers, no_barriers

__all__ = ["strewn_discs"]

Floats = NDArray[np.float64]


def strewn_discs(
    track: ArrayLike,
    per_km2: float,
    radii: tuple[float, float],
    rng: np.random.Generator,
    *,
    around: float = 200.0,
    clear: float = 60.0,
) -> Barriers:
    """Draw discs about a track.

    Parameters
    ----------
    track
        Waypoints in metres, shape (k, 2).
    per_km2
        Mean number of discs in a square kilometre.
    radii
        Least and largest radius in metres, all between equally likely.
    rng
        Source of randomness.
    around
        Metres beyond the rectangle around the track within which centres may lie.
    clear
        Metres of water around the first and the last waypoint: a disc that would come nearer
        is not there, as nobody puts nodes or starts next to one.
    """
    points = np.array(track, dtype=np.float64)
    if not (0.0 < radii[0] <= radii[1] < np.inf):
        raise InputError("must be positive and in order", field="radii", value=radii)
    if not 0.0 <= per_km2 < np.inf:
        raise InputError("must be finite and not negative", field="per_km2", value=per_km2)
    low, high = points.min(axis=0) - around, points.max(axis=0) + around
    number = rng.poisson(per_km2 * float(np.prod(high - low)) / 1e6)
    circles = np.column_stack([rng.uniform(low, high, (number, 2)), rng.uniform(*radii, number)])
    for end in (points[0], points[-1]):
        distance = np.hypot(*(circles[:, :2] - end).T)
        circles = circles[distance > circles[:, 2] + clear]
    return no_barriers()._replace(circles=np.ascontiguousarray(circles))
