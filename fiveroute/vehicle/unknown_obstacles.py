"""Obstacles that no plan knew: discs strewn at random, about one track or over a whole sea.

Their centres are a Poisson process of a given density on all points from which a disc could come
near the track. A vehicle that keeps the distance d from a disc of radius r has to give way on a
straight track if the centre is within r + d of it: on every kilometre of a long track

    density * 2 (E r + d)

discs do, in units of kilometres, Poisson distributed as the manoeuvres of equation (12). Over a
whole sea those are left out that would close a passage between two of them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance, distance_to_leg, no_barriers

__all__ = ["near_track", "strewn_about", "strewn_discs"]

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
    low, high = points.min(axis=0) - around, points.max(axis=0) + around
    circles = _drawn(low, high, per_km2, radii, rng)
    return no_barriers()._replace(circles=_clear_of(circles, points[[0, -1]], clear))


def strewn_about(
    barriers: Barriers,
    stops: Floats,
    low: Floats,
    high: Floats,
    per_km2: float,
    radii: tuple[float, float],
    rng: np.random.Generator,
    *,
    clear: float = 60.0,
    passage: float = 80.0,
) -> Barriers:
    """Barriers that are known, and discs in a rectangle that are not.

    Parameters
    ----------
    barriers
        What is known; charts know all within `passage` of it as well.
    stops
        Positions in metres that have `clear` metres of water around them, shape (k, 2).
    low, high
        South-western and north-eastern corner of the rectangle in metres, shape (2,).
    per_km2, radii, rng
        As for `strewn_discs`.
    passage
        Least width of the water between two discs in metres: a vehicle that keeps 10 m from both
        can turn round on 20 m in it.
    """
    circles = _clear_of(_drawn(low, high, per_km2, radii, rng), stops, clear)
    circles = circles[_apart(barriers, circles, passage)]
    return barriers._replace(circles=np.concatenate([barriers.circles, circles]))


@kernel
def near_track(circles: Floats, track: Floats, within: float) -> Floats:
    """The circles that come within so many metres of a track, shape (any, 3)."""
    chosen = np.zeros(len(circles), np.bool_)
    for c in range(len(circles)):
        for k in range(len(track) - 1):
            x0, y0, x1, y1 = track[k, 0], track[k, 1], track[k + 1, 0], track[k + 1, 1]
            x, y, radius = circles[c]
            chosen[c] |= distance_to_leg(x, y, x0, y0, x1, y1) < within + radius
    return circles[chosen]


def _drawn(
    low: Floats,
    high: Floats,
    per_km2: float,
    radii: tuple[float, float],
    rng: np.random.Generator,
) -> Floats:
    """Circles with their centres anywhere in a rectangle, shape (any, 3)."""
    if not (0.0 < radii[0] <= radii[1] < np.inf):
        raise InputError("must be positive and in order", field="radii", value=radii)
    if not 0.0 <= per_km2 < np.inf:
        raise InputError("must be finite and not negative", field="per_km2", value=per_km2)
    number = rng.poisson(per_km2 * float(np.prod(high - low)) / 1e6)
    return np.column_stack([rng.uniform(low, high, (number, 2)), rng.uniform(*radii, number)])


def _clear_of(circles: Floats, points: Floats, clear: float) -> Floats:
    """The circles that leave so many metres of water around all points."""
    for point in points:
        distance = np.hypot(*(circles[:, :2] - point).T)
        circles = circles[distance > circles[:, 2] + clear]
    return np.ascontiguousarray(circles)


@kernel
def _apart(barriers: Barriers, circles: Floats, passage: float) -> NDArray[np.bool_]:
    """Which circles leave a passage to what is known, and to those before them that do."""
    kept = np.zeros(len(circles), np.bool_)
    for c in range(len(circles)):
        x, y, radius = circles[c]
        kept[c] = clearance(barriers, x, y) > radius + passage
        for d in range(c):
            if not kept[c]:
                break
            if kept[d]:
                water = np.hypot(circles[d, 0] - x, circles[d, 1] - y) - circles[d, 2] - radius
                kept[c] = water > passage
    return kept
