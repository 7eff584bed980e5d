"""From the grid of an ocean model to a regular grid in metres.

A velocity is a complex number w = u + i v, so that components along axes that stand at the angle
a to the map's are brought to the map by a factor, w exp(i a).

Faces to cells: on a C-grid a cell (j, i) has u on its western and eastern face and v on its
southern and northern one,

    u_cell(j, i) = (u(j, i-1) + u(j, i)) / 2,    v_cell(j, i) = (v(j-1, i) + v(j, i)) / 2,

where a face that is closed by land counts as zero: no water flows through it. The outermost cells,
which have one face only, are left out.

Cells to the map: each point of the map's grid finds its fractional row and column among the cells
by Newton's method, and takes the bilinear interpolation of the four
cells around it. Cells on land lend the velocity of the nearest wet cell; which they are is kept.
A cell reaches half a row and half a column to each side, and there the data end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError

__all__ = [
    "CellGrid",
    "MapGrid",
    "bilinear",
    "cells_from_faces",
    "direction_of_rows",
    "is_left_handed",
    "resample",
]

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Booleans = NDArray[np.bool_]

_FINER = 2, 4  # points of the map's grid in the spacing of the model's, at least and at most
_MANY, _TOO_MANY = 8e6, 1e8  # velocities that the map's grid is made finer for, and may hold
_SPARSE = 1e4, 1e2  # points in the spacing of the model's that any file may take, and each cell
_NEWTON_STEPS = 12
_CLOSE = 1e-6  # cells within which Newton's method has arrived


@dataclass(frozen=True, slots=True, eq=False)
class CellGrid:
    """Velocities in the cells of a model, on the map.

    Parameters
    ----------
    x, y
        Centres of the cells in metres, shape (rows, columns).
    w
        Velocity u + i v in metres per second, shape (times, rows, columns); NaN on land.
    """

    x: Floats
    y: Floats
    w: Complexes

    @property
    def land(self) -> Booleans:
        """Cells that are without water at any time, shape (rows, columns)."""
        return np.asarray(~np.isfinite(self.w).all(axis=0))

    @property
    def spacing(self) -> float:
        """Median distance in metres of neighbours in rows or in columns, the smaller; or NaN."""
        steps = (np.hypot(np.diff(self.x, axis=k), np.diff(self.y, axis=k)) for k in (0, 1))
        known = (step[np.isfinite(step)] for step in steps)
        return float(min(np.median(step) if step.size else np.nan for step in known))

    def filled(self) -> Complexes:
        """The velocities, those on land taken from the nearest wet cell."""
        return _nearest_filled(self.w, self.land)


@dataclass(frozen=True, slots=True, eq=False)
class MapGrid:
    """Velocities on a regular grid of the map.

    Parameters
    ----------
    uv
        Components to the east and north of the map in metres per second, shape (times, rows,
        columns, 2); without gaps.
    land
        Whether a point lies on land, shape (rows, columns).
    covered
        Whether the data reach to a point, same shape.
    west, south
        Position of the first column and row in metres.
    step
        Spacing in metres.
    spacing
        Spacing of the model's cells in metres.
    """

    uv: Floats
    land: Booleans
    covered: Booleans
    west: float
    south: float
    step: float
    spacing: float


def cells_from_faces(
    u: Floats, v: Floats, closed_u: Booleans | None = None, closed_v: Booleans | None = None
) -> tuple[Floats, Floats]:
    """Bring the velocities on the faces of cells to their centres.

    Parameters
    ----------
    u
        Components through the western and eastern faces of n columns of cells, shape
        (times, rows, n + 1), NaN where there is none.
    v
        Components through the southern and northern faces of m rows, shape
        (times, m + 1, columns).
    closed_u, closed_v
        Faces at the coast and on land, shapes without the times; None takes those
        that never have a velocity.

    Returns
    -------
    u, v : array
        Components in the cells, shape (times, m, n); NaN where all faces are closed.
    """
    shut_u = np.asarray(np.isnan(u).all(axis=0)) if closed_u is None else closed_u
    shut_v = np.asarray(np.isnan(v).all(axis=0)) if closed_v is None else closed_v
    open_u, open_v = np.where(shut_u, 0.0, u), np.where(shut_v, 0.0, v)
    in_u = (open_u[..., :-1] + open_u[..., 1:]) / 2.0
    in_v = (open_v[..., :-1, :] + open_v[..., 1:, :]) / 2.0
    shut = shut_u[:, :-1] & shut_u[:, 1:] & shut_v[:-1] & shut_v[1:]
    return np.where(shut, np.nan, in_u), np.where(shut, np.nan, in_v)


def direction_of_rows(x: Floats, y: Floats) -> Floats:
    """Angle in radians from the map's x axis to the way in which columns are counted."""
    order: Literal[1, 2] = 2 if x.shape[1] > 2 else 1
    east, north = (np.gradient(part, axis=1, edge_order=order) for part in (x, y))
    return np.asarray(np.arctan2(north, east), dtype=np.float64)


def is_left_handed(x: Floats, y: Floats) -> bool:
    """Whether rows are counted to the right of the way in which columns are."""
    east_j, north_j, east_i, north_i = (np.gradient(z, axis=k) for k in (0, 1) for z in (x, y))
    return bool(np.nanmedian(east_i * north_j - north_i * east_j) < 0.0)


def resample(cells: CellGrid) -> MapGrid:
    """Bring the velocities of cells to a regular grid that covers them all.

    No data reach to its outermost points, so that a path that keeps to the data keeps inside.
    """
    spacing = cells.spacing
    step = spacing / _fineness(cells)
    x, y = np.meshgrid(_along(cells.x, spacing, step), _along(cells.y, spacing, step))
    row, column = (part.reshape(x.shape) for part in _find_cells(cells, x.ravel(), y.ravel()))
    covered = np.isfinite(row)
    covered[[0, -1]] = covered[:, [0, -1]] = False
    row, column = row[covered], column[covered]
    land = np.zeros(x.shape, dtype=bool)
    land[covered] = _on(cells.land, row, column)
    w = np.zeros((len(cells.w), *x.shape), dtype=np.complex128)
    w[:, covered] = bilinear(cells.filled(), row, column)
    w = _nearest_filled(w, ~covered)
    uv = np.stack((w.real, w.imag), axis=-1)
    return MapGrid(uv, land, covered, float(x[0, 0]), float(y[0, 0]), step, spacing)


def _on(land: Booleans, row: Floats, column: Floats) -> Booleans:
    """Whether positions lie in cells of land, the borders of these included."""
    last = land.shape[0] - 1, land.shape[1] - 1
    found = np.zeros(len(row), dtype=bool)
    for down in (-_CLOSE, _CLOSE):
        j = np.clip(np.rint(row + down), 0, last[0]).astype(np.int64)
        for right in (-_CLOSE, _CLOSE):
            i = np.clip(np.rint(column + right), 0, last[1]).astype(np.int64)
            found |= land[j, i]
    return found


def _fineness(cells: CellGrid) -> float:
    """Points of the map's grid in the spacing of the cells: as many as are cheap."""
    area = float(np.prod([np.nanmax(part) - np.nanmin(part) for part in (cells.x, cells.y)]))
    if not (cells.spacing > 0.0 and area > 0.0):
        raise InputError("has cells in one place or on one line; copy the file again", field="grid")
    points = area / cells.spacing**2
    coarse = len(cells.w) * points
    if coarse * _FINER[0] ** 2 > _TOO_MANY:
        raise InputError(
            f"takes {coarse * _FINER[0] ** 2:.1e} velocities, more than {_TOO_MANY:.0e}; "
            "read a smaller surrounding or cut times out of the file",
            field="reach",
        )
    if points > _SPARSE[0] + _SPARSE[1] * cells.x.size:
        raise InputError(
            f"takes {points:.1e} points for {cells.x.size} cells; some lie far from the others, "
            "copy the file again",
            field="grid",
        )
    return float(np.clip(math.floor(math.sqrt(_MANY / coarse)), *_FINER))


def _along(coordinate: Floats, spacing: float, step: float) -> Floats:
    """Coordinates of the map's grid: multiples of its spacing, one more than needed each way."""
    first = math.floor((float(np.nanmin(coordinate)) - spacing / 2.0) / step) - 1
    last = math.ceil((float(np.nanmax(coordinate)) + spacing / 2.0) / step) + 1
    return step * np.arange(first, last + 1, dtype=np.float64)


def _find_cells(cells: CellGrid, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Fractional rows and columns of positions, shape (n,); NaN beyond the outermost cells."""
    row, column, arrived = _newton(cells, x, y, *_affine_guess(cells, x, y))
    lost = np.flatnonzero(~arrived)
    if len(lost):
        guess = _nearest_cells(cells, x[lost], y[lost])
        row[lost], column[lost], arrived[lost] = _newton(cells, x[lost], y[lost], *guess)
    rows, columns = cells.x.shape
    beyond = np.maximum(
        abs(row - (rows - 1) / 2) - rows / 2, abs(column - (columns - 1) / 2) - columns / 2
    )
    found = arrived & (beyond <= _CLOSE)
    return np.where(found, row, np.nan), np.where(found, column, np.nan)


def _affine_guess(cells: CellGrid, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Rows and columns of positions on the grid of parallelograms closest to the cells'."""
    placed = np.isfinite(cells.x) & np.isfinite(cells.y)
    centres = np.column_stack((cells.x[placed], cells.y[placed], np.ones(placed.sum())))
    fit = np.linalg.lstsq(centres, np.argwhere(placed), rcond=None)[0]
    guess = np.column_stack((x, y, np.ones(len(x)))) @ fit
    return guess[:, 0], guess[:, 1]


def _nearest_cells(cells: CellGrid, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    from scipy.spatial import cKDTree

    placed = np.isfinite(cells.x) & np.isfinite(cells.y)
    centres = np.column_stack((cells.x[placed], cells.y[placed]))
    _, nearest = cKDTree(centres).query(np.column_stack((x, y)))
    found = np.argwhere(placed)[nearest].astype(np.float64)
    return found[:, 0], found[:, 1]


def _newton(
    cells: CellGrid, x: Floats, y: Floats, row: Floats, column: Floats
) -> tuple[Floats, Floats, Booleans]:
    """Newton's method from a guess: rows, columns, and whether it has arrived there."""
    for _ in range(_NEWTON_STEPS):
        down, right = _newton_step(cells, x, y, row, column)
        row, column = row + down, column + right
        arrived = np.hypot(down, right) < _CLOSE
        if arrived.all():
            break
    return row, column, arrived


def _newton_step(
    cells: CellGrid, x: Floats, y: Floats, row: Floats, column: Floats
) -> tuple[Floats, Floats]:
    """Rows and columns still to go, the position being linear in each between cells."""
    rows, columns = cells.x.shape
    j = np.clip(np.nan_to_num(np.floor(row)), 0, rows - 2).astype(np.int64)
    i = np.clip(np.nan_to_num(np.floor(column)), 0, columns - 2).astype(np.int64)
    r, s = row - j, column - i
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        z = cells.x + 1j * cells.y
        z00, z01, z10, z11 = z[j, i], z[j, i + 1], z[j + 1, i], z[j + 1, i + 1]
        along_row = z01 - z00 + r * (z11 - z10 - z01 + z00)
        along_column = z10 - z00 + s * (z11 - z10 - z01 + z00)
        rest = x + 1j * y - (z00 + s * (z01 - z00) + r * along_column)
        area = (along_row.conj() * along_column).imag
        right = (rest.conj() * along_column).imag / area
        down = (along_row.conj() * rest).imag / area
    return down, right


def bilinear(values: Complexes, row: Floats, column: Floats) -> Complexes:
    """Interpolate at fractional rows and columns, constant beyond the first and last.

    Parameters
    ----------
    values
        Shape (times, rows, columns).
    row, column
        Shape (n,).

    Returns
    -------
    array
        Shape (times, n).
    """
    times, rows, columns = values.shape
    row, column = np.clip(row, 0.0, rows - 1.0), np.clip(column, 0.0, columns - 1.0)
    j = np.minimum(row.astype(np.int64), rows - 2)
    i = np.minimum(column.astype(np.int64), columns - 2)
    r, s = row - j, column - i
    flat, first = values.reshape(times, -1), j * columns + i
    result: Complexes = (1.0 - r) * (1.0 - s) * flat.take(first, axis=1)
    result += (1.0 - r) * s * flat.take(first + 1, axis=1)
    result += r * (1.0 - s) * flat.take(first + columns, axis=1)
    result += r * s * flat.take(first + columns + 1, axis=1)
    return result


def _nearest_filled(values: Complexes, gaps: Booleans) -> Complexes:
    """Values, shape (..., rows, columns), with those in gaps taken from the nearest outside."""
    if not gaps.any():
        return values
    from scipy.ndimage import distance_transform_edt

    nearest = distance_transform_edt(gaps, return_distances=False, return_indices=True)
    j, i = np.asarray(nearest)
    return values[..., j, i]
