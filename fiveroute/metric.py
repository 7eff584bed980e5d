"""Distances between points, by the rule that a file states.

Euclidean distance is the rule of the paper, equation (1). The others are those of TSPLIB
(G. Reinelt, "TSPLIB 95", 1995, section 2), with its own constants, so that lengths agree
to the last unit with published optima.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

__all__ = ["Metric", "distances"]

Metric = Literal["euclidean", "EUC_2D", "CEIL_2D", "GEO", "ATT", "explicit"]

Matrix = NDArray[np.float64]


def distances(metric: Metric, points: Matrix) -> Matrix:
    """All distances between points.

    Parameters
    ----------
    metric
        The rule; ``explicit`` has none, since its distances are given.
    points
        Coordinates, shape (k, 2): metres for ``euclidean``, file units for the others
        (``GEO``: degrees and minutes, DDD.MM, latitude first).

    Returns
    -------
    Matrix
        Distances, shape (k, k), in the unit of the points (``GEO``: kilometres).
    """
    return _RULES[metric](points)


def _euclidean(points: Matrix) -> Matrix:
    from scipy.spatial.distance import cdist

    matrix: Matrix = cdist(points, points)
    return matrix


def _nearest_integer(matrix: Matrix) -> Matrix:
    matrix += 0.5
    return np.floor(matrix, out=matrix)


def _euc_2d(points: Matrix) -> Matrix:
    return _nearest_integer(_euclidean(points))


def _ceil_2d(points: Matrix) -> Matrix:
    return np.ceil(_euclidean(points))


def _att(points: Matrix) -> Matrix:
    """Pseudo-Euclidean: divided by sqrt(10) and rounded up."""
    from scipy.spatial.distance import cdist

    return np.ceil(np.sqrt(cdist(points, points, "sqeuclidean") / 10.0))


def _geo(points: Matrix) -> Matrix:
    """Great-circle kilometres on TSPLIB's sphere, with its truncated value of pi.

    Every two places are at least a kilometre apart, but a place is not from itself.
    """
    pi, radius = 3.141592, 6378.388
    degrees = np.trunc(points)
    latitude, longitude = (pi * (degrees + 5.0 * (points - degrees) / 3.0) / 180.0).T
    q1 = np.cos(longitude[:, None] - longitude[None, :])
    q2 = np.cos(latitude[:, None] - latitude[None, :])
    q3 = np.cos(latitude[:, None] + latitude[None, :])
    cosine = np.clip(0.5 * ((1.0 + q1) * q2 - (1.0 - q1) * q3), -1.0, 1.0)
    one_place = (q1 == 1.0) & (q2 == 1.0)
    return np.where(one_place, 0.0, np.trunc(radius * np.arccos(cosine) + 1.0))


def _explicit(points: Matrix) -> Matrix:
    raise ValueError("explicit distances are given, not computed")


_RULES: dict[str, Callable[[Matrix], Matrix]] = {
    "euclidean": _euclidean,
    "EUC_2D": _euc_2d,
    "CEIL_2D": _ceil_2d,
    "GEO": _geo,
    "ATT": _att,
    "explicit": _explicit,
}
