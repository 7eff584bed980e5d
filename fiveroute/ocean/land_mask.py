"""Distances to the land of a mask.

A mask tells for every cell of a regular grid whether it is land. Land is the union of its square
cells, and the signed distance to its coast is exact at the centres, edges and corners of all
cells: the nearest point of a square cell to any of them is one of them too, so that the Euclidean
distance transform on the grid of half the spacing finds it. It is positive in the water, negative
on land, and zero along the coast; interpolated bilinearly it has the right sign everywhere.

References
----------
C. R. Maurer, R. Qi and V. Raghavan, "A linear time algorithm for computing exact Euclidean
distance transforms of binary images in arbitrary dimensions", IEEE Transactions on Pattern
Analysis and Machine Intelligence 25 (2003), doi 10.1109/TPAMI.2003.1177156.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError

__all__ = ["LandDistance", "land_distance"]

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


class LandDistance(NamedTuple):
    """Signed distances to land at the points of a regular grid.

    Parameters
    ----------
    distance
        In metres, negative on land, rows to the north and columns to the east; shape (0, 0) where
        there is no land.
    west, south
        Position of the first column and row in metres.
    step
        Spacing in metres.
    """

    distance: Floats
    west: float
    south: float
    step: float


def land_distance(is_land: Mask, west: float, south: float, step: float) -> LandDistance:
    """Signed distances to the land of a mask.

    Parameters
    ----------
    is_land
        Whether each cell is land, rows to the north and columns to the east, shape (rows, columns).
    west, south
        Centre of the first cell in metres.
    step
        Side of a cell in metres.

    Returns
    -------
    LandDistance
        On the grid of half the spacing that reaches to the outer edges of the outermost cells.

    Raises
    ------
    InputError
        If the mask is no grid of truth values, or leaves no water.
    """
    _require_water(is_land, step)
    if not is_land.any():
        return LandDistance(np.zeros((0, 0)), west, south, step)
    distance = _distance_to(is_land, step) - _distance_to(~is_land, step)
    return LandDistance(distance, west - step / 2.0, south - step / 2.0, step / 2.0)


def _distance_to(cells: Mask, step: float) -> Floats:
    """Distance to the nearest of the marked cells, zero on their edges and corners."""
    from scipy.ndimage import distance_transform_edt

    rows, columns = cells.shape
    outside = np.ones((2 * rows + 1, 2 * columns + 1), dtype=np.bool_)
    for i in range(3):
        for j in range(3):
            outside[i : i + 2 * rows : 2, j : j + 2 * columns : 2] &= ~cells
    return np.asarray(distance_transform_edt(outside, sampling=step / 2.0), dtype=np.float64)


def _require_water(is_land: Mask, step: float) -> None:
    if is_land.ndim != 2 or is_land.size == 0 or is_land.dtype != np.bool_:
        raise InputError(
            "must be a two-dimensional array of truth values, one a cell",
            field="is_land",
            value=(is_land.shape, str(is_land.dtype)),
        )
    if not 0.0 < step < np.inf:
        raise InputError("cells need a positive side", field="step", value=step)
    if is_land.all():
        raise InputError(
            "there is no water at all; check which value of the mask means land", field="is_land"
        )
