"""The chart of a mission's sea: the current on a coarse grid and the land of its file's mask.

It is made to be looked at. Planners and the judge take the current from where it comes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.instance import Circle, Instance
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.currents import Current, Superposition
from fiveroute.ocean.model_current import ModelCurrent

__all__ = ["LAND", "NO_DATA", "WATER", "Chart", "chart_of", "region_of", "seen_current"]

Floats = NDArray[np.float64]
Codes = NDArray[np.uint8]

WATER, LAND, NO_DATA = 0, 1, 2

_MARGIN = 0.12
"""Rim of the chart around all that is on it, as a share of the diagonal."""

_POINTS, _POINTS_IN_TIME = 176, 88
"""Points of the current along the longer side; where it varies, at every time."""

_TIMES = 13
"""Times at which a current that varies is shown."""

_FARTHEST = 1e12
"""Coordinates that are drawn are smaller than this."""

_DIAGONAL = np.array([(-1.0, -1.0), (1.0, 1.0)])

_SURROUND = 0.75
"""Half a chart's side, as a share of the region's longer side: maps are wider or higher than it."""


_CELLS = 400
"""Cells of the mask along the longer side."""


class Mask(NamedTuple):
    """What there is in the cells of a regular grid.

    Parameters
    ----------
    codes
        `WATER`, `LAND` or `NO_DATA`, rows to the north, shape (rows, columns).
    west, south
        Centre of the first cell in metres.
    step
        Side of a cell in metres.
    """

    codes: Codes
    west: float
    south: float
    step: float


@dataclass(frozen=True, slots=True, eq=False)
class Chart:
    """The current of a region, and its land.

    Parameters
    ----------
    uv
        Velocities in metres per second, rows to the north and columns to the east, shape
        (times, rows, columns, 2).
    times
        Seconds since the mission began, shape (times,).
    west, south
        Position of the first column and row in metres.
    step
        Spacing in metres.
    mask
        Land of a file's mask; None without one.
    """

    uv: Floats
    times: Floats
    west: float
    south: float
    step: float
    mask: Mask | None

    @property
    def fastest(self) -> float:
        """Largest speed of the water in metres per second."""
        return float(np.hypot(self.uv[..., 0], self.uv[..., 1]).max())


def region_of(instance: Instance, tracks: list[Floats]) -> Region:
    """The rectangle around stops, obstacles and tracks, with a rim.

    Raises
    ------
    InputError
        If something is too far away to be drawn.
    """
    corners = [instance.points, *tracks]
    for shape in instance.ocean.obstacles:
        if isinstance(shape, Circle):
            corners.append(np.array([(shape.x, shape.y)]) + shape.radius * _DIAGONAL)
        else:
            corners.append(np.array(shape.polygon))
    points = np.concatenate(corners)
    if not (np.abs(points) < _FARTHEST).all():
        raise InputError(
            f"coordinates of {_FARTHEST:.0e} and more cannot be drawn; correct them",
            value=float(np.abs(points).max()),
        )
    return Region.around(points, _MARGIN * float(np.hypot(*np.ptp(points, axis=0))) or 1.0)


def seen_current(current: Superposition) -> Superposition:
    """The same current for pictures: beyond a file's data it goes on as at their edge."""
    return Superposition(
        tuple(
            replace(part, extends=True) if isinstance(part, ModelCurrent) else part
            for part in current.parts
        )
    )


def chart_of(current: Superposition, region: Region, duration: float) -> Chart:
    """Put a current on a chart.

    Parameters
    ----------
    current
        The current, as `seen_current` leaves it.
    region
        What must be seen; the chart is a larger square.
    duration
        How long the mission takes, in seconds.
    """
    times = _times(current, duration)
    region = _surroundings(region)
    step = max(region.east - region.west, region.north - region.south) / (
        _POINTS if len(times) == 1 else _POINTS_IN_TIME
    )
    x, y = _axis(region.west, region.east, step), _axis(region.south, region.north, step)
    uv = np.stack([np.stack(current(x[None, :], y[:, None], t), axis=-1) for t in times])
    return Chart(uv, times, region.west, region.south, step, _mask(current, region))


def _surroundings(region: Region) -> Region:
    x, y = (region.west + region.east) / 2.0, (region.south + region.north) / 2.0
    reach = _SURROUND * max(region.east - region.west, region.north - region.south)
    return Region(x - reach, y - reach, x + reach, y + reach)


def _axis(first: float, last: float, step: float) -> Floats:
    count = math.ceil((last - first) / step - 1e-9) + 1
    return np.linspace(first, first + (count - 1) * step, count)


def _times(current: Current, duration: float) -> Floats:
    """Times of the mission that the current is shown at, none beyond the end of a file."""
    if current.is_steady or duration <= 0.0:
        return np.zeros(1)
    last = duration
    for part in getattr(current, "parts", ()):
        if isinstance(part, ModelCurrent) and not part.is_steady:
            last = min(last, float(part.times[-1]))
    return np.linspace(0.0, last, _TIMES) if last > 0.0 else np.zeros(1)


def _mask(current: Superposition, region: Region) -> Mask | None:
    """Where files have land or no data, by the nearest point of their grids."""
    models = [part for part in current.parts if isinstance(part, ModelCurrent)]
    if not models:
        return None
    step = max(region.east - region.west, region.north - region.south) / _CELLS
    x, y = _axis(region.west, region.east, step), _axis(region.south, region.north, step)
    codes = np.zeros((len(y), len(x)), dtype=np.uint8)
    for model in models:
        known = np.where(model.land, LAND, np.where(model.closed, NO_DATA, WATER))
        framed = np.pad(known, 1, constant_values=NO_DATA).astype(np.uint8)
        rows = _nearest(y, model.south, model.step, len(framed))
        columns = _nearest(x, model.west, model.step, len(framed[0]))
        codes = np.maximum(codes, framed[np.ix_(rows, columns)])
    return Mask(codes, region.west, region.south, step)


def _nearest(positions: Floats, first: float, step: float, lines: int) -> NDArray[np.int64]:
    """Nearest lines of a grid that has a frame of one line around it, and begins at `first`."""
    nearest = np.rint((positions - first) / step).astype(np.int64) + 1
    return np.clip(nearest, 0, lines - 1)
