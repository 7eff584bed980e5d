"""Fields of an ocean model's file in a window of rows and columns: velocities and masks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.model_axes import Axes
from fiveroute.ocean.model_file import decoded
from fiveroute.ocean.model_levels import Level

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Window", "read_component", "read_mask", "read_window"]

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]
Integers = NDArray[np.int64]
Window = tuple[Integers, Integers]  # rows and columns of the file, in the order they are wanted

_FASTEST = 20.0  # m/s; no sea runs faster, numbers without their scale factor do
_UNITS = {  # of speeds, in metres per second
    **dict.fromkeys(("", "m/s", "m s-1", "m.s-1", "ms-1", "m s^-1", "m s**-1", "m/sec"), 1.0),
    **dict.fromkeys(("meter second-1", "meter/second", "meter/sec", "meter s-1"), 1.0),
    **dict.fromkeys(("meters second-1", "meters/second", "meters/sec", "meters s-1"), 1.0),
    **dict.fromkeys(("metre second-1", "metre/second", "metres second-1", "metres/second"), 1.0),
    **dict.fromkeys(("cm/s", "cm s-1", "cm/sec", "centimeter second-1"), 0.01),
}
_LAND = "land_binary_mask"


def read_component(data: xr.Dataset, name: str, axes: Axes, level: Level, window: Window) -> Floats:
    """One component of the velocity at its own points.

    Returns
    -------
    array
        In metres per second, NaN where there is none, shape (times, rows, columns).

    Raises
    ------
    InputError
        If its unit is no speed, or its numbers are none of the sea.
    """
    variable = data[name]
    units = str(variable.attrs.get("units", "")).strip().lower()
    if units not in _UNITS:
        raise InputError(
            "is no unit of speed that can be read; give m s-1", field=name, value=units
        )
    dims, times = (axes.rows, axes.columns), () if axes.time is None else (axes.time,)
    values = read_window(variable, dims, window, first=times, level=level, k=level.upper)
    if level.share > 0.0:
        lower = read_window(variable, dims, window, first=times, level=level, k=level.lower)
        values = (1.0 - level.share) * values + level.share * lower
    values = values.reshape(-1, *values.shape[-2:]) * _UNITS[units]
    fastest = float(np.abs(values).max(where=np.isfinite(values), initial=0.0))
    if fastest > _FASTEST:
        raise InputError(
            f"holds speeds up to {fastest:.6g} m/s, which no sea has; "
            "is its scale factor or its fill value missing?",
            field=name,
        )
    return values


def read_window(
    variable: xr.DataArray,
    dims: tuple[str, str],
    window: Window,
    *,
    first: tuple[str, ...] = (),
    level: Level | None = None,
    k: int = 0,
) -> Floats:
    """Values of a variable in a window.

    Parameters
    ----------
    variable
        The variable.
    dims
        Its dimensions of rows and columns.
    window
        Rows and columns to read.
    first
        Dimensions to keep before them.
    level, k
        Levels of the velocities, and which of them to take; of other dimensions the
        first is taken.

    Returns
    -------
    array
        In the units of the variable, NaN where there is none, shape (..., rows, columns).

    Raises
    ------
    InputError
        If the variable is empty.
    """
    if variable.size == 0:
        raise InputError("is empty; cut the file anew", field=str(variable.name))
    cut: dict[str, int | slice] = {}
    for dim in map(str, variable.dims):
        if dim not in (*first, *dims):
            is_level = level is not None and variable.sizes[dim] == level.count
            cut[dim] = k if is_level else 0
    for dim, indices in zip(dims, window, strict=True):
        cut[dim] = slice(int(indices.min()), int(indices.max()) + 1)
    values = decoded(variable.isel(cut).transpose(*first, *dims))
    rows, columns = (indices - indices.min() for indices in window)
    return values[..., rows, :][..., columns]


def read_mask(
    data: xr.Dataset,
    names: tuple[str, ...],
    dims: tuple[str, str],
    level: Level,
    window: Window,
) -> tuple[Booleans | None, str]:
    """Where the first mask found under one of some names tells land, and its own name.

    A mask is 1 in the water and 0 on land, but for CF's land_binary_mask. Where it has no value,
    there is land.

    Returns
    -------
    land : array or None
        Shape (rows, columns); None without a mask.
    name : str
        Of the mask.
    """
    for name in names:
        for held in data.variables:
            signs = (str(held).lower(), str(data[held].attrs.get("standard_name", "")).lower())
            if name in signs and set(dims) <= set(data[held].dims):
                values = read_window(data[held], dims, window, level=level, k=level.lower)
                return (~(values < 0.5) if _LAND in signs else ~(values > 0.5)), str(held)
    return None, ""
