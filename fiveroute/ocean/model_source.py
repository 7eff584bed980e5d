"""Reading the cells of an ocean model's file, brought to a local map.

The order of the steps: positions of the cells, the window of them near the origin, the level, the
two components, from faces to cells where the grid is staggered, the land, the rotation to the map.
Each says in a note what it understood.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.local_plane import LocalPlane
from fiveroute.ocean.model_axes import Axes, find_axes
from fiveroute.ocean.model_fields import Window, read_component, read_mask, read_window
from fiveroute.ocean.model_file import decoded_times
from fiveroute.ocean.model_grid import CellGrid, cells_from_faces, direction_of_rows, is_left_handed
from fiveroute.ocean.model_levels import Level, choose_level
from fiveroute.ocean.model_positions import Positions, read_positions
from fiveroute.ocean.model_variables import Velocity, find_cells, find_velocity

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Source", "read_source"]

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Integers = NDArray[np.int64]
Times = NDArray[np.datetime64]

_AGREEMENT = 5.0  # degrees between the angle that a file gives and that of its own grid
_CELL_MASKS = ("mask_rho", "tmask", "tmaskutil", "sea_binary_mask", "land_binary_mask")
_STAGGER_NOTES = {
    "": "none, both components lie at the same points",
    "ROMS": "C-grid of ROMS, brought from the faces to the centres of the cells",
    "NEMO": "C-grid of NEMO, brought from the eastern and northern faces to the cells",
}
_FACE_MASKS = {"u": ("mask_u", "umask"), "v": ("mask_v", "vmask")}


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """What was read of a file.

    Parameters
    ----------
    velocity
        The variables.
    plane
        The map.
    cells
        The velocities in the cells, on the map.
    times
        Their times; None for a single field without one.
    lon, lat
        Ranges of the cells' centres in degrees.
    level
        The level, and those that there are.
    notes
        What was understood, by subject.
    """

    velocity: Velocity
    plane: LocalPlane
    cells: CellGrid
    times: Times | None
    lon: tuple[float, float]
    lat: tuple[float, float]
    level: Level
    notes: dict[str, str]


def read_source(
    data: xr.Dataset,
    *,
    origin: tuple[float, float] | None,
    depth: float,
    u: str | None,
    v: str | None,
    reach: float,
) -> Source:
    """Read the velocities near the origin, with all that is needed to understand them.

    Parameters
    ----------
    data
        The file.
    origin
        Longitude and latitude of the map's origin; None takes the middle of the data.
    depth
        In metres, positive down.
    u, v
        Names of the variables; None finds them.
    reach
        Distance from the origin in metres within which the data are read.
    """
    velocity = find_velocity(data, u, v)
    axes = find_axes(data, velocity.u), find_axes(data, velocity.v)
    dims = find_cells(data, velocity, *axes)
    plane, positions = _near(read_positions(data, velocity.u, dims, origin), origin, reach)
    if velocity.stagger:
        positions = _with_all_faces(data, positions, axes)
    if min(positions.lon.shape) < 2:
        raise InputError("has fewer than two rows or columns to read", field=velocity.u)
    levels = tuple(
        choose_level(data, name, of, depth)
        for name, of in zip((velocity.u, velocity.v), axes, strict=True)
    )
    u_cell, v_cell = _components(data, velocity, axes, levels, positions)
    w = u_cell + 1j * v_cell
    land_note = _take_off_land(data, w, dims, levels[0], positions)
    x, y = plane.project(positions.lon, positions.lat)
    angle, rotation_note = _rotation(data, velocity, dims, positions, plane)
    times = _times(data, velocity.u, axes[0])
    notes = {
        "variables": f"{velocity.u}, {velocity.v}",
        "positions": positions.note,
        "staggering": _STAGGER_NOTES[velocity.stagger],
        "rotation": rotation_note,
        "depth": levels[0].note,
        "land": land_note,
        "plane": plane.proj,
    }
    cells = CellGrid(x, y, w * np.exp(1j * angle))
    lon = plane.lon + (positions.lon - plane.lon + 180.0) % 360.0 - 180.0
    lons, lats = ((float(np.nanmin(z)), float(np.nanmax(z))) for z in (lon, positions.lat))
    return Source(velocity, plane, cells, times, lons, lats, levels[0], notes)


def _near(
    positions: Positions, origin: tuple[float, float] | None, reach: float
) -> tuple[LocalPlane, Positions]:
    """The map, and the positions within reach of its origin."""
    if origin is not None:
        plane = LocalPlane(*origin)
        return plane, positions.within(plane, reach)
    if positions.extent() > reach:
        raise InputError(
            f"the data reach {positions.extent() / 1e3:.0f} km from their middle, more than the "
            f"{reach / 1e3:g} km that are read; give the longitude and latitude of the mission",
            field="origin",
        )
    return LocalPlane(*positions.centre()), positions


def _with_all_faces(data: xr.Dataset, positions: Positions, axes: tuple[Axes, Axes]) -> Positions:
    """The cells of a C-grid that have both faces in both components."""
    if positions.rows[0] > positions.rows[-1] or positions.columns[0] > positions.columns[-1]:
        raise InputError("has rows or columns in descending order, which a C-grid must not have")
    rows = min(data.sizes[of.rows] for of in axes)
    columns = min(data.sizes[of.columns] for of in axes)
    kept = [
        np.flatnonzero((part >= 1) & (part < count))
        for part, count in ((positions.rows, rows), (positions.columns, columns))
    ]
    if min(len(part) for part in kept) < 2:
        raise InputError("has fewer than two rows or columns of cells with all their faces")
    return positions.cut(*(slice(part[0], part[-1] + 1) for part in kept))


def _components(
    data: xr.Dataset,
    velocity: Velocity,
    axes: tuple[Axes, Axes],
    levels: tuple[Level, ...],
    positions: Positions,
) -> tuple[Floats, Floats]:
    """Both components in the cells, shape (times, rows, columns)."""
    windows: list[Window] = [(positions.rows, positions.columns)] * 2
    if velocity.stagger:
        windows = [
            (positions.rows, _from_one_before(positions.columns)),
            (_from_one_before(positions.rows), positions.columns),
        ]
    names = velocity.u, velocity.v
    u, v = (
        read_component(data, name, of, level, window)
        for name, of, level, window in zip(names, axes, levels, windows, strict=True)
    )
    if len(u) != len(v):
        raise InputError(f"has {len(v)} times, but {velocity.u} has {len(u)}", field=velocity.v)
    if not velocity.stagger:
        return u, v
    closed = (
        read_mask(data, _FACE_MASKS[side], (of.rows, of.columns), level, window)[0]
        for side, of, level, window in zip("uv", axes, levels, windows, strict=True)
    )
    return cells_from_faces(u, v, *closed)


def _from_one_before(indices: Integers) -> Integers:
    return np.arange(indices[0] - 1, indices[-1] + 1)


def _take_off_land(
    data: xr.Dataset, w: Complexes, dims: tuple[str, str], level: Level, positions: Positions
) -> str:
    """Put NaN where a mask tells land, and say where land is known from."""
    window = positions.rows, positions.columns
    masked, name = read_mask(data, _CELL_MASKS, dims, level, window)
    if masked is not None:
        w[:, masked] = np.nan
    land = ~np.isfinite(w).all(axis=0)
    if land.all():
        raise InputError("no water within reach of the origin at this depth", field="depth")
    count = f"{land.sum()} of {land.size} cells"
    if masked is not None:
        return f"{count}, by {name} and missing values"
    if land.any():
        return f"{count}, by missing values"
    still = int((w == 0.0).all(axis=0).sum())
    return f"no mask and no missing values: all is water, {still} cells of which never move"


def _rotation(
    data: xr.Dataset,
    velocity: Velocity,
    dims: tuple[str, str],
    positions: Positions,
    plane: LocalPlane,
) -> tuple[Floats, str]:
    """Angle in radians from the map's x axis to that of the components, and how it is known."""
    east = plane.turn(positions.lon, positions.lat)
    if not velocity.is_along_grid:
        return east, "none, the components stand to the east and north"
    x, y = plane.project(positions.lon, positions.lat)
    if is_left_handed(x, y):
        raise InputError(
            "stands along the axes of a grid whose rows are counted southward of its columns' way, "
            "so that its sign is unknown; turn the rows of the file round",
            field=velocity.v,
        )
    rows = direction_of_rows(x, y)
    window = positions.rows, positions.columns
    given, how = _given_angle(data, dims, window)
    if given is None:
        return rows, _turned(rows - east, "the direction of the grid's rows")
    apart = np.degrees(np.abs(np.angle(np.exp(1j * (given + east - rows)))))
    if np.nanmedian(apart) > _AGREEMENT:
        raise InputError(
            f"is {np.nanmedian(apart):.1f} degrees off the direction of the grid's own rows",
            field=how,
        )
    return given + east, _turned(given, how)


def _given_angle(
    data: xr.Dataset, dims: tuple[str, str], window: Window
) -> tuple[Floats | None, str]:
    """Angle in radians from east to the grid's x axis as the file gives it."""
    if "angle" not in data.variables or set(data["angle"].dims) != set(dims):
        return None, ""
    variable = data["angle"]
    angle = read_window(variable, dims, window)
    if not np.isfinite(angle).any():
        raise InputError("has no values", field="angle")
    is_degrees = str(variable.attrs.get("units", "")).lower().startswith("degree")
    return (np.radians(angle) if is_degrees else angle), "angle"


def _turned(angle: Floats, how: str) -> str:
    middle = np.degrees(np.angle(np.nanmean(np.exp(1j * angle))))
    return f"by {how}, x axis {middle:.1f} degrees anticlockwise from east on average"


def _times(data: xr.Dataset, name: str, axes: Axes) -> Times | None:
    """Times of the fields; None for a single one without."""
    if axes.time is None:
        return None
    if axes.time_variable not in data.variables:
        if data.sizes[axes.time] == 1:
            return None
        raise InputError("has several times, but the file does not tell which", field=name)
    times = decoded_times(data[axes.time_variable])
    if not (np.diff(times) > np.timedelta64(0, "ns")).all():
        raise InputError("must grow from one to the next", field=axes.time_variable)
    return times
