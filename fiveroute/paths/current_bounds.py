"""What a current on a grid cannot exceed, between its points too: its speed and its gradient.

Along one axis cubic convolution weights four values by weights whose sizes sum to 5/4 at most; its
derivative is the difference across the cell and at most half a second difference, in steps. In the
plane it does so along one axis, and then along the other.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.current_grid import CurrentGrid, Region

__all__ = ["fastest_bound", "gradient_bound", "gradient_within"]

Floats = NDArray[np.float64]

_OVERSHOOT = 1.25  # of cubic convolution over the largest value, along an axis


def fastest_bound(grid: CurrentGrid) -> float:
    """Bound on the speed of the water anywhere and at any time, in metres per second."""
    return _OVERSHOOT**2 * grid.fastest


def gradient_bound(grid: CurrentGrid) -> float:
    """Bound on the change of the current with the distance, anywhere and at any time, in 1/s."""
    region: Region = grid.region
    bounds = [gradient_within(grid, k, *region) for k in range(len(grid.uv))]
    return max(bounds)


@kernel
def gradient_within(
    grid: CurrentGrid, k: int, west: float, south: float, east: float, north: float
) -> float:
    """Bound on the change with the distance in a rectangle at the grid's time k, in 1/s."""
    rows, columns = grid.uv.shape[1], grid.uv.shape[2]
    first_row, last_row = _lines(south - grid.south, north - grid.south, grid.step, rows)
    first, last = _lines(west - grid.west, east - grid.west, grid.step, columns)
    rise_east = rise_north = bend_east = bend_north = 0.0
    for i in range(first_row, last_row):
        for j in range(first, last):
            here = grid.uv[k, i, j]
            right, left = grid.uv[k, i, min(j + 1, columns - 1)], grid.uv[k, i, max(j - 1, 0)]
            above, below = grid.uv[k, min(i + 1, rows - 1), j], grid.uv[k, max(i - 1, 0), j]
            rise_east = max(rise_east, math.hypot(right[0] - here[0], right[1] - here[1]))
            rise_north = max(rise_north, math.hypot(above[0] - here[0], above[1] - here[1]))
            bend_east = max(bend_east, _bend(left, here, right))
            bend_north = max(bend_north, _bend(below, here, above))
    steepest = math.hypot(rise_east + 0.5 * bend_east, rise_north + 0.5 * bend_north)
    return _OVERSHOOT * steepest / grid.step


@kernel
def _lines(low: float, high: float, step: float, count: int) -> tuple[int, int]:
    """Grid lines, from and before, that interpolation between two coordinates takes."""
    first = max(math.floor(min(max(low / step, 0.0), count - 1.0)) - 1, 0)
    return first, min(math.floor(min(max(high / step, 0.0), count - 1.0)) + 3, count)


@kernel
def _bend(before: Floats, here: Floats, after: Floats) -> float:
    """Size of a second difference."""
    return math.hypot(before[0] - 2.0 * here[0] + after[0], before[1] - 2.0 * here[1] + after[1])
