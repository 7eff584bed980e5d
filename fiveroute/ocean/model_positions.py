"""Where the cells of an ocean model lie, and which of them are near.

Cells have longitudes and latitudes along the two axes of their grid, or in two dimensions, or
the coordinates of a projection that the file describes (a CF grid mapping, or a PROJ string).
Rows and columns are put in the order of growing coordinates, longitudes round the origin's:
latitudes may descend and longitudes run from 0 to 360.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.model_axes import find_coordinate
from fiveroute.ocean.model_file import decoded

if TYPE_CHECKING:
    import pyproj
    import xarray as xr

__all__ = ["Positions", "read_positions"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_TOO_MANY = 200_000_000  # cells
_WIDEST = 540.0  # degrees of longitude; PROJ takes ten radians
_EARTH = 6.371e6  # mean radius in metres
_LENGTHS = {"m": 1.0, "meter": 1.0, "meters": 1.0, "metre": 1.0, "metres": 1.0, "km": 1e3}
_PROJ = ("proj4", "proj4_params", "proj4text")  # attributes that hold a PROJ string
_ANGLES = ("degree", "degrees", "degrees_east", "degrees_north")


@dataclass(frozen=True, slots=True, eq=False)
class Positions:
    """Positions of cells.

    Parameters
    ----------
    lon, lat
        In degrees, shape (rows, columns).
    rows, columns
        Which rows and columns of the file these are.
    note
        How they were found.
    """

    lon: Floats
    lat: Floats
    rows: Integers
    columns: Integers
    note: str

    def centre(self) -> tuple[float, float]:
        """Longitude and latitude of the middle of all cells."""
        east, north, up = (np.nanmean(part) for part in _on_sphere(self.lon, self.lat))
        lon = np.degrees(np.arctan2(north, east))
        lat = np.degrees(np.arctan2(up, np.hypot(east, north)))
        return round(float(lon), 6), round(float(lat), 6)

    def within(self, plane: LocalPlane, reach: float) -> Positions:
        """The rows and columns that come within `reach` metres of the origin of a map."""
        distances = self._distances(plane.lon, plane.lat)
        near = distances <= reach
        rows, columns = np.flatnonzero(near.any(axis=1)), np.flatnonzero(near.any(axis=0))
        if len(rows) < 2 or len(columns) < 2:
            raise InputError(
                f"the origin ({plane.lon:g}, {plane.lat:g}) is {np.nanmin(distances) / 1e3:.0f} "
                f"km from the data, which cover longitudes {_range(self.lon)} and latitudes "
                f"{_range(self.lat)}",
                field="origin",
            )
        return self.cut(slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))

    def extent(self) -> float:
        """Largest distance in metres of a cell from the middle of all."""
        return float(np.nanmax(self._distances(*self.centre())))

    def _distances(self, lon: float, lat: float) -> Floats:
        """Straight distances in metres of all cells from a point."""
        here, there = _on_sphere(np.array(lon), np.array(lat)), _on_sphere(self.lon, self.lat)
        squares = [(a - b) ** 2 for a, b in zip(here, there, strict=True)]
        return np.asarray(_EARTH * np.sqrt(sum(squares)))

    def cut(self, rows: slice, columns: slice) -> Positions:
        """A part of the cells."""
        return Positions(
            self.lon[rows, columns],
            self.lat[rows, columns],
            self.rows[rows],
            self.columns[columns],
            self.note,
        )


def _on_sphere(lon: Floats, lat: Floats) -> tuple[Floats, Floats, Floats]:
    """Positions on the unit sphere."""
    east, north = np.radians(lon), np.radians(lat)
    return np.cos(north) * np.cos(east), np.cos(north) * np.sin(east), np.sin(north)


def _range(values: Floats) -> str:
    return f"{np.nanmin(values):g} .. {np.nanmax(values):g}"


def read_positions(
    data: xr.Dataset, name: str, dims: tuple[str, str], origin: tuple[float, float] | None
) -> Positions:
    """Find and read the positions of the cells.

    Parameters
    ----------
    data
        The file.
    name
        A variable in the cells, that may name its projection.
    dims
        Dimensions of rows and of columns.
    origin
        Longitude and latitude round which longitudes are put in order.

    Raises
    ------
    InputError
        If there are none, or not on Earth, or the grid is unstructured.
    """
    if data.sizes[dims[0]] * data.sizes[dims[1]] > _TOO_MANY:
        raise InputError(f"has more than {_TOO_MANY:.0e} cells; cut a part out", field=name)
    positions = _found(data, name, dims, origin)
    with np.errstate(invalid="ignore"):
        absurd = (np.abs(positions.lat) > 90.001) | (np.abs(positions.lon) > _WIDEST)
    if absurd.any() or not np.isfinite(positions.lon + positions.lat).any():
        raise InputError(
            "has cells at no longitudes and latitudes of the Earth; copy the file again", field=name
        )
    return positions


def _found(
    data: xr.Dataset, name: str, dims: tuple[str, str], origin: tuple[float, float] | None
) -> Positions:
    lon, lat = find_coordinate(data, "lon", dims), find_coordinate(data, "lat", dims)
    if lon is None or lat is None:
        return _projected(data, name, dims)
    if data[lon].ndim == 2 and data[lat].ndim == 2:
        return _in_two_dimensions(data, lon, lat, dims)
    if {*data[lon].dims, *data[lat].dims} != set(dims):
        raise InputError(
            "has longitudes and latitudes along one dimension: a track or an unstructured grid; "
            "interpolate it to a grid of longitudes and latitudes first",
            field=name,
        )
    if data[lon].ndim != 1 or data[lat].ndim != 1:
        raise InputError(f"has {lon} and {lat} in different dimensions", field=name)
    _require_axes(data, name, lon, lat, dims)
    return _in_one_dimension(data, lon, lat, origin)


def _require_axes(data: xr.Dataset, name: str, x: str, y: str, dims: tuple[str, str]) -> None:
    """Refuse coordinates along the other's axis, as attributes that contradict their names say."""
    rows, columns = dims
    if (data[x].dims, data[y].dims) != ((columns,), (rows,)):
        raise InputError(
            f"has {x} along its rows or {y} along its columns; do their axis, units and standard "
            "names contradict each other?",
            field=name,
        )


def _in_one_dimension(
    data: xr.Dataset, lon: str, lat: str, origin: tuple[float, float] | None
) -> Positions:
    longitudes = np.unwrap(_complete(data[lon]), period=360.0)
    if origin is not None:
        longitudes = origin[0] + (longitudes - origin[0] + 180.0) % 360.0 - 180.0
    with np.errstate(over="ignore"):  # what is so large is refused later
        longitudes, columns = np.unique(np.round(longitudes, 9), return_index=True)
    latitudes, rows = np.unique(_complete(data[lat]), return_index=True)
    lon_2d, lat_2d = np.meshgrid(longitudes, latitudes)
    return Positions(lon_2d, lat_2d, rows, columns, f"{lon}, {lat} along the axes of the grid")


def _in_two_dimensions(data: xr.Dataset, lon: str, lat: str, dims: tuple[str, str]) -> Positions:
    rows, columns = (_order(data, dim) for dim in dims)
    lon_2d, lat_2d = (decoded(data[part].transpose(*dims)) for part in (lon, lat))
    note = f"{lon}, {lat} in two dimensions"
    return Positions(lon_2d[rows][:, columns], lat_2d[rows][:, columns], rows, columns, note)


def _order(data: xr.Dataset, dim: str) -> Integers:
    """Indices along a dimension in the order of its coordinate, if it has one."""
    count = data.sizes[dim]
    values = decoded(data[dim]) if dim in data.variables else np.arange(float(count))
    forward = np.arange(count)
    return forward[::-1] if count > 1 and (np.diff(values) < 0.0).all() else forward


def _projected(data: xr.Dataset, name: str, dims: tuple[str, str]) -> Positions:
    x, y = find_coordinate(data, "x", dims), find_coordinate(data, "y", dims)
    crs = _projection(data, name)
    if x is None or y is None or crs is None or data[x].ndim != 1 or data[y].ndim != 1:
        raise InputError(
            "has no longitudes and latitudes, nor projection coordinates with a grid mapping; "
            f"the file holds {', '.join(str(held) for held in data.variables)}",
            field=name,
        )
    _require_axes(data, name, x, y, dims)
    import pyproj

    across, columns = np.unique(_scaled(data[x]), return_index=True)
    up, rows = np.unique(_scaled(data[y]), return_index=True)
    to_degrees = pyproj.Transformer.from_crs(crs, crs.geodetic_crs, always_xy=True)
    lon, lat = to_degrees.transform(*np.meshgrid(across, up), errcheck=True)
    note = f"{x}, {y} in the projection {data[name].attrs.get('grid_mapping')} ({crs.name})"
    return Positions(np.asarray(lon), np.asarray(lat), rows, columns, note)


def _projection(data: xr.Dataset, name: str) -> pyproj.CRS | None:
    """The projection that the grid mapping of a variable describes."""
    mapping = str(data[name].attrs.get("grid_mapping", "")).partition(":")[0].strip()
    if mapping not in data.variables:
        return None
    import pyproj

    attributes = {str(key): _plain(value) for key, value in data[mapping].attrs.items()}
    proj = next((attributes[key] for key in _PROJ if key in attributes), None)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of ways to write it that went out of fashion
            if proj is None:
                return pyproj.CRS.from_cf(attributes)
            return pyproj.CRS.from_proj4(str(proj))
    except (pyproj.exceptions.CRSError, KeyError) as error:
        raise InputError(f"is no projection that can be read ({error})", field=mapping) from error


def _plain(value: object) -> object:
    """A number or a text of an attribute that netCDF holds as an array of one."""
    return value.item() if isinstance(value, np.ndarray) and value.size == 1 else value


def _scaled(variable: xr.DataArray) -> Floats:
    """Coordinates of a projection in metres, or in degrees on a rotated globe."""
    units = str(variable.attrs.get("units", "m")).strip().lower()
    values = _complete(variable)
    if units in _ANGLES:
        return values
    if units not in _LENGTHS:
        raise InputError(
            "is no unit of length that can be read; give m or km",
            field=str(variable.name),
            value=units,
        )
    return values * _LENGTHS[units]


def _complete(variable: xr.DataArray) -> Floats:
    values = decoded(variable)
    if not np.isfinite(values).all():
        raise InputError("has missing values", field=str(variable.name))
    return values
