"""The current of an ocean model's file: a forecast to plan in.

    current = read_current("forecast.nc", origin=(4.8, 60.6))
    u, v = current(x, y, t)

The file's velocities are brought to a regular grid in metres about the origin
(`fiveroute.ocean.model_source`, `fiveroute.ocean.model_grid`); between its points they
are bilinear, between its times linear. x and y are metres to the east and north of the origin,
u and v the velocity on that map.

Land is a mask, not a velocity: where there is land the velocity goes on as in the nearest water,
so that interpolation near the coast takes nothing of it, and paths are kept off by `land`.
Where and when there are no data, asking is an error. Planners that grid the current over a
rectangle take `dataclasses.replace(current, extends=True)` and keep their paths off `closed`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.model_file import open_model_file
from fiveroute.ocean.model_grid import MapGrid, resample
from fiveroute.ocean.model_source import Source, read_source
from fiveroute.ocean.model_times import seconds_since

if TYPE_CHECKING:
    from fiveroute.ocean.current_grid import Region

__all__ = ["Coverage", "ModelCurrent", "read_current"]

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]
Range = tuple[float, float]

_REACH = 250e3  # m; as far the map's lengths err by 0.03 % at most


class Coverage(NamedTuple):
    """Ranges of the data.

    Parameters
    ----------
    lon, lat
        Of the centres of the cells, in degrees.
    x, y
        On the map, in metres, to half a cell beyond the centres.
    depth
        Of the levels of the file, in metres; None if it has none.
    time
        First and last, in UTC; None if the current is steady.
    """

    lon: Range
    lat: Range
    x: Range
    y: Range
    depth: Range | None
    time: tuple[np.datetime64, np.datetime64] | None


@dataclass(frozen=True, slots=True, eq=False)
class ModelCurrent:
    """A current on a regular grid in metres about an origin.

    Parameters
    ----------
    grid
        Velocities, land and where there are data.
    times
        Seconds since the mission began, growing, shape (times,); one for a steady current.
    plane
        The map.
    coverage
        Where and when there are data.
    provenance
        What was understood of the file, by subject.
    source
        Variables and file that errors name.
    extends
        Whether positions beyond the data take the velocity of the nearest that has one; for
        planners that keep their paths off `closed`.
    """

    grid: MapGrid
    times: Floats
    plane: LocalPlane
    coverage: Coverage
    provenance: dict[str, str]
    source: tuple[str, str]
    extends: bool = False

    @property
    def land(self) -> Booleans:
        """Whether a point of the grid lies on land, shape (rows, columns), rows to the north."""
        return self.grid.land

    @property
    def closed(self) -> Booleans:
        """Whether a point of the grid lies on land or beyond the data, same shape."""
        return self.grid.land | ~self.grid.covered

    @property
    def west(self) -> float:
        """Position of the grid's first column in metres."""
        return self.grid.west

    @property
    def south(self) -> float:
        """Position of the grid's first row in metres."""
        return self.grid.south

    @property
    def step(self) -> float:
        """Spacing of the grid in metres."""
        return self.grid.step

    @property
    def is_steady(self) -> bool:
        """Whether the file holds one time only."""
        return len(self.times) == 1

    @property
    def length_scale(self) -> float:
        """Twice the spacing of the model's cells: nothing smaller is in the data."""
        return 2.0 * self.grid.spacing

    def clip(self, region: Region) -> Region:
        """The part of a rectangle where the data may reach.

        Raises
        ------
        InputError
            If it has none.
        """
        (west, east), (south, north) = self.coverage.x, self.coverage.y
        part = region._replace(
            west=max(region.west, west),
            south=max(region.south, south),
            east=min(region.east, east),
            north=min(region.north, north),
        )
        if part.west > part.east or part.south > part.north:
            raise self._outside(
                f"x = {_shown(region[::2])} m and y = {_shown(region[1::2])} m asked, but the "
                f"data cover x = {_shown(self.coverage.x)} m and y = {_shown(self.coverage.y)} m"
            )
        return part

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        """Velocity at positions and times.

        Raises
        ------
        InputError
            If there are no data there or then.
        """
        across, up = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        k, later = self._moment(np.asarray(t, dtype=np.float64))
        shape = np.broadcast_shapes(across.shape, up.shape, k.shape)
        grid, (rows, columns) = self.grid, self.grid.land.shape
        column = np.asarray((across - grid.west) / grid.step)
        row = np.asarray((up - grid.south) / grid.step)
        self._require_covered(across, up, row, column)
        column, row = np.clip(column, 0.0, columns - 1.0), np.clip(row, 0.0, rows - 1.0)
        i = np.minimum(column.astype(np.int64), columns - 2)
        j = np.minimum(row.astype(np.int64), rows - 2)
        s, r, later = (part[..., None] for part in (column - i, row - j, later))
        uv = self._in_space(k, j, i, r, s)
        if not self.is_steady:
            uv = uv + later * (self._in_space(k + 1, j, i, r, s) - uv)
        uv = np.broadcast_to(uv, (*shape, 2))
        return uv[..., 0].copy(), uv[..., 1].copy()

    def _in_space(
        self, k: NDArray[np.int64], j: NDArray[np.int64], i: NDArray[np.int64], r: Floats, s: Floats
    ) -> Floats:
        """Bilinear interpolation between four points of the grid."""
        uv = self.grid.uv
        south = (1.0 - s) * uv[k, j, i] + s * uv[k, j, i + 1]
        north = (1.0 - s) * uv[k, j + 1, i] + s * uv[k, j + 1, i + 1]
        return np.asarray((1.0 - r) * south + r * north)

    def _moment(self, t: Floats) -> tuple[NDArray[np.int64], Floats]:
        """The last time that is not later than t, and the share of the step from it to t."""
        if self.is_steady:
            self._require("t", t, (-math.inf, math.inf), "s")
            return np.zeros(t.shape, dtype=np.int64), np.zeros(t.shape)
        times = self.times
        self._require("t", t, (float(times[0]), float(times[-1])), "s")
        k = np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(times) - 2)
        return np.asarray(k), np.asarray((t - times[k]) / (times[k + 1] - times[k]))

    def _require_covered(self, x: Floats, y: Floats, row: Floats, column: Floats) -> None:
        everywhere = (-math.inf, math.inf)
        self._require("x", x, everywhere if self.extends else self.coverage.x, "m")
        self._require("y", y, everywhere if self.extends else self.coverage.y, "m")
        if self.extends:
            return
        rows, columns = self.grid.covered.shape
        j = np.clip(np.rint(row), 0, rows - 1).astype(np.int64)
        i = np.clip(np.rint(column), 0, columns - 1).astype(np.int64)
        if not self.grid.covered[j, i].all():
            raise self._outside(
                f"x = {_shown(x)} m with y = {_shown(y)} m asked, of which a part lies beyond "
                f"the edge of the data in x = {_shown(self.coverage.x)} m, "
                f"y = {_shown(self.coverage.y)} m"
            )

    def _require(self, name: str, asked: Floats, available: Range, unit: str) -> None:
        """Refuse what is outside a range, or is no number."""
        first, last = available
        slack = 1e-9 * (last - first) if math.isfinite(last - first) else 0.0
        if not ((asked >= first - slack) & (asked <= last + slack) & np.isfinite(asked)).all():
            raise self._outside(
                f"{name} = {_shown(asked)} {unit} asked, but the data cover "
                f"{name} = {_shown(available)} {unit}{self._clock(name)}"
            )

    def _clock(self, name: str) -> str:
        if name != "t" or self.coverage.time is None:
            return ""
        first, last = (np.datetime_as_string(time, unit="s") for time in self.coverage.time)
        return f" ({first} .. {last} UTC)"

    def _outside(self, rule: str) -> InputError:
        variables, file = self.source
        return InputError(rule, field=variables, file=file)


def _shown(values: ArrayLike) -> str:
    least, most = float(np.min(values)), float(np.max(values))
    return f"{least:.10g}" if least == most else f"{least:.10g} .. {most:.10g}"


def read_current(
    path: Path | str,
    *,
    origin: tuple[float, float] | None = None,
    depth: float = 0.0,
    u: str | None = None,
    v: str | None = None,
    begin: datetime | np.datetime64 | str | None = None,
    reach: float = _REACH,
) -> ModelCurrent:
    """Read the current of an ocean model from a CF netCDF file.

    Parameters
    ----------
    path
        The file.
    origin
        Longitude and latitude in degrees of the point that x and y are measured from; None
        takes the middle of the data.
    depth
        Depth in metres, positive down; 0 is the highest level.
    u, v
        Names of the variables; None finds them.
    begin
        When the mission begins, in UTC unless it says otherwise; None takes the first time.
    reach
        Distance from the origin in metres within which the data are read.

    Raises
    ------
    InputError
        If the file cannot be read or understood, or has no data there or then.
    """
    if not (math.isfinite(reach) and reach > 0.0):
        raise InputError("must be a positive distance in metres", field="reach", value=reach)
    try:
        with open_model_file(path) as data:
            source = read_source(data, origin=origin, depth=depth, u=u, v=v, reach=reach)
        return _current(source, Path(path), begin)
    except InputError as error:
        raise error.at(path) from error.__cause__


def _current(
    source: Source, path: Path, begin: datetime | np.datetime64 | str | None
) -> ModelCurrent:
    times, note = seconds_since(source.times, begin)
    grid = resample(source.cells)
    velocity, notes = source.velocity, source.notes
    return ModelCurrent(
        grid,
        times,
        source.plane,
        Coverage(
            source.lon,
            source.lat,
            _reach_of(grid.covered, grid.west, grid.step),
            _reach_of(grid.covered.T, grid.south, grid.step),
            source.level.depths,
            None if source.times is None else (source.times[0], source.times[-1]),
        ),
        notes | {"times": note},
        (f"{velocity.u}, {velocity.v}", str(path)),
    )


def _reach_of(covered: Booleans, first: float, step: float) -> Range:
    """Range of the coordinates whose nearest column of the grid has data."""
    places = np.flatnonzero(covered.any(axis=0))
    if len(places) == 0:
        raise InputError("has no cells that lie beside each other; copy the file again")
    return first + step * (float(places[0]) - 0.5), first + step * (float(places[-1]) + 0.5)
