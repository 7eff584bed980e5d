"""A current on a regular grid: what planners ask millions of times.

In space the components are interpolated by cubic convolution, which passes through the
grid's values, has continuous derivatives and an error of third order in the spacing; in time
linearly. Positions outside the grid take the value at its edge: a grid covers the region that
its paths may use.

`grid_current` refines the grid, in time and in space, until the interpolation errs by less than
is asked for, measured against the current itself. At the share s of a cell of side h the error
of cubic convolution is h^3 f_xxx s (s - 1) (2 s - 1) / 6 and one of fourth order: the first is
largest at s = 1/2 -+ sqrt(3)/6 and vanishes halfway, where the second is largest. The error is
therefore taken at these three shares.

References
----------
R. G. Keys, "Cubic convolution interpolation for digital image processing", IEEE Transactions on
Acoustics, Speech, and Signal Processing 29 (1981), doi 10.1109/TASSP.1981.1163711.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.currents import Current

__all__ = [
    "CurrentGrid",
    "Region",
    "grid_current",
    "interpolation_error",
    "refined",
    "velocity",
]

Floats = NDArray[np.float64]

_POINTS_A_SCALE = 4.0  # grid points in a length scale to begin with
_FEWEST, _MOST = 4, 1500  # grid points along an axis; fewer at most where there are many times
_FINE = 200  # grid points along an axis
_REFINEMENTS = 4
_FEWEST_TIMES, _MOST_TIMES = 13, 193  # grid times over a mission in a current that varies
_PROBES = 50  # points along an axis where the change in time is looked at
_BETWEEN = 0.382  # share between two times, irrational as no current's period hides from it
_SHARES = 0.5 + math.sqrt(3.0) / 6.0 * np.array([-1.0, 0.0, 1.0])  # of a cell, where errors peak


class Region(NamedTuple):
    """A rectangle in metres."""

    west: float
    south: float
    east: float
    north: float

    @classmethod
    def around(cls, points: Floats, margin: float) -> Region:
        """The rectangle around points, shape (n, 2), and `margin` metres more on each side."""
        west, south = points.min(axis=0) - margin
        east, north = points.max(axis=0) + margin
        return cls(float(west), float(south), float(east), float(north))


class CurrentGrid(NamedTuple):
    """Velocities at the points of a regular grid; a tuple, as kernels need it.

    Parameters
    ----------
    uv
        Components in metres per second at times, rows to the north and columns to the east,
        shape (times, rows, columns, 2).
    west, south
        Position of the first column and row in metres.
    step
        Spacing in metres, the same both ways.
    begin, every
        First time, and time between two, in seconds.
    """

    uv: Floats
    west: float
    south: float
    step: float
    begin: float
    every: float

    @property
    def region(self) -> Region:
        """The rectangle that the grid covers."""
        rows, columns = self.uv.shape[1:3]
        return Region(
            self.west,
            self.south,
            self.west + (columns - 1) * self.step,
            self.south + (rows - 1) * self.step,
        )

    @property
    def is_steady(self) -> bool:
        """Whether the time makes no difference."""
        return len(self.uv) == 1

    @property
    def fastest(self) -> float:
        """Largest speed of the water at any grid point and time, in metres per second."""
        return float(np.sqrt((self.uv**2).sum(axis=-1).max()))


def grid_current(
    current: Current,
    region: Region,
    *,
    duration: float = 0.0,
    tolerance: float = 1e-3,
    step: float | None = None,
) -> CurrentGrid:
    """Put a current on a grid.

    Parameters
    ----------
    current
        The current.
    region
        Where it is needed.
    duration
        How long it is needed, in seconds; a steady current takes one grid whatever it is.
    tolerance
        Largest error of the interpolation in metres per second that is refined away.
    step
        Spacing in metres; None chooses it by `tolerance`.
    """
    width = max(region.east - region.west, region.north - region.south, 1.0)
    times = _grid_times(current, region, duration, tolerance)
    some_times = times[:: len(times) // _FEWEST_TIMES or 1]
    finest = width * math.sqrt(len(times)) / _MOST
    chosen = step or min(current.length_scale / _POINTS_A_SCALE, width / _FEWEST)
    chosen = max(chosen, finest)
    for _ in range(_REFINEMENTS):
        grid = _sampled(current, region, chosen, times)
        if step is not None or chosen <= finest:
            break
        if max(_error_at(grid, current, t) for t in some_times) <= tolerance:
            break
        chosen = max(chosen / 2.0, finest)
    return grid


def interpolation_error(grid: CurrentGrid, current: Current) -> float:
    """Largest error found in metres per second, at the grid's times and between them.

    The outermost cells, which lie beyond the region that was asked for, do not count.
    """
    times = grid.begin + grid.every * np.arange(len(grid.uv))
    between = times[:-1] + _BETWEEN * grid.every
    return max(_error_at(grid, current, t) for t in (*times, *between))


def refined(grid: CurrentGrid, step: float) -> CurrentGrid:
    """The same current at points that are at most `step` metres apart, in the same region."""
    if grid.step <= step:
        return grid
    parts = math.ceil(grid.step / step)
    fine = grid.step / parts
    rows, columns = (parts * (lines - 1) + 1 for lines in grid.uv.shape[1:3])
    x, y = grid.west + fine * np.arange(columns), grid.south + fine * np.arange(rows)
    uv = np.empty((len(grid.uv), rows, columns, 2))
    for k, known in enumerate(uv):
        _fill(grid, x, y, grid.begin + k * grid.every, known)
    return grid._replace(uv=uv, step=fine)


def _error_at(grid: CurrentGrid, current: Current, t: float) -> float:
    """Largest error at one time."""
    rows, columns = grid.uv.shape[1:3]
    x, y = grid.west + grid.step * _peaks(columns), grid.south + grid.step * _peaks(rows)
    found = np.empty((len(y), len(x), 2))
    _fill(grid, x, y, t, found)
    u, v = current(x[None, :], y[:, None], t)
    return float(np.hypot(found[..., 0] - u, found[..., 1] - v).max())


def _peaks(lines: int) -> Floats:
    """Where errors peak in all but the outermost cells between grid lines, in cells.

    On a fine grid, where neighbouring cells are alike, every fourth of these places: the three
    shares take turns.
    """
    places: Floats = np.add.outer(np.arange(1.0, lines - 2.0), _SHARES).ravel()
    return places[:: 1 if lines < _FINE else 4]


def _grid_times(current: Current, region: Region, duration: float, tolerance: float) -> Floats:
    """Times so close that linear interpolation between them keeps the tolerance, if enough do."""
    if current.is_steady or duration <= 0.0:
        return np.zeros(1)
    x = np.linspace(region.west, region.east, _PROBES)[None, :]
    y = np.linspace(region.south, region.north, _PROBES)[:, None]
    count = _FEWEST_TIMES
    while True:
        times = np.linspace(0.0, duration, count)
        known = np.array([current(x, y, t) for t in times])
        true = np.array([current(x, y, t) for t in times[:-1] + _BETWEEN * times[1]])
        error = true - known[:-1] - _BETWEEN * np.diff(known, axis=0)
        if np.hypot(error[:, 0], error[:, 1]).max() <= tolerance or count >= _MOST_TIMES:
            return times
        count = 2 * count - 1


def _sampled(current: Current, region: Region, step: float, times: Floats) -> CurrentGrid:
    """The current on a grid that covers the region and one cell more all around."""
    west, south = region.west - step, region.south - step
    columns = max(math.ceil((region.east - region.west) / step - 1e-9), 1) + 3
    rows = max(math.ceil((region.north - region.south) / step - 1e-9), 1) + 3
    x, y = west + step * np.arange(columns), south + step * np.arange(rows)
    uv = np.empty((len(times), rows, columns, 2))
    for k, t in enumerate(times):
        uv[k, ..., 0], uv[k, ..., 1] = current(x[None, :], y[:, None], t)
    every = float(times[1] - times[0]) if len(times) > 1 else 1.0
    return CurrentGrid(uv, west, south, step, float(times[0]), every)


@kernel
def velocity(grid: CurrentGrid, x: float, y: float, t: float) -> tuple[float, float]:
    """Velocity at a position and a time, by interpolation."""
    times = grid.uv.shape[0]
    if times == 1:
        return _in_space(grid, 0, x, y)
    place = min(max((t - grid.begin) / grid.every, 0.0), times - 1.0)
    k = min(int(place), times - 2)
    later = place - k
    u0, v0 = _in_space(grid, k, x, y)
    u1, v1 = _in_space(grid, k + 1, x, y)
    return u0 + later * (u1 - u0), v0 + later * (v1 - v0)


@kernel
def _in_space(grid: CurrentGrid, k: int, x: float, y: float) -> tuple[float, float]:
    rows, columns = grid.uv.shape[1], grid.uv.shape[2]
    across = min(max((x - grid.west) / grid.step, 0.0), columns - 1.0)
    up = min(max((y - grid.south) / grid.step, 0.0), rows - 1.0)
    j, i = min(int(across), columns - 2), min(int(up), rows - 2)
    x0, x1, x2, x3 = _weights(across - j)
    y0, y1, y2, y3 = _weights(up - i)
    j0, j3 = max(j - 1, 0), min(j + 2, columns - 1)
    u = v = 0.0
    for row, weight in ((max(i - 1, 0), y0), (i, y1), (i + 1, y2), (min(i + 2, rows - 1), y3)):
        line = grid.uv[k, row]
        u += weight * (x0 * line[j0, 0] + x1 * line[j, 0] + x2 * line[j + 1, 0] + x3 * line[j3, 0])
        v += weight * (x0 * line[j0, 1] + x1 * line[j, 1] + x2 * line[j + 1, 1] + x3 * line[j3, 1])
    return u, v


@kernel
def _weights(s: float) -> tuple[float, float, float, float]:
    """Cubic convolution with Keys's a = -1/2, at the share s of a cell."""
    return (
        s * (s * (1.0 - 0.5 * s) - 0.5),
        s * s * (1.5 * s - 2.5) + 1.0,
        s * (s * (2.0 - 1.5 * s) + 0.5),
        s * s * (0.5 * s - 0.5),
    )


@kernel
def _fill(grid: CurrentGrid, x: Floats, y: Floats, t: float, uv: Floats) -> None:
    """Interpolate at every pair of the coordinates."""
    for i in range(len(y)):
        for j in range(len(x)):
            uv[i, j, 0], uv[i, j, 1] = velocity(grid, x[j], y[i], t)
