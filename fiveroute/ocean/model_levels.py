"""Which level of an ocean model holds a depth.

Depths are positive down. Between two levels the velocity is linear in the depth. The highest level
stands for the water above it. Levels that follow the terrain lie at another depth in every
cell, so that of them only the surface can be told.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.model_axes import Axes, is_sigma
from fiveroute.ocean.model_file import decoded

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Level", "choose_level"]

Floats = NDArray[np.float64]

_NEAR_SURFACE = 20.0  # m; a highest level no deeper than this stands for the surface
_METRES = ("m", "meter", "meters", "metre", "metres")


@dataclass(frozen=True, slots=True)
class Level:
    """Where a depth lies among the levels of a variable.

    Parameters
    ----------
    dimension
        The dimension of the levels; None if there is none.
    upper, lower
        The levels above and below; the same if the depth is that of a level.
    share
        Weight of the lower one.
    count
        Number of levels.
    depths
        Depths of the highest and the lowest level in metres; None if they have no depth.
    note
        What was understood.
    """

    dimension: str | None
    upper: int
    lower: int
    share: float
    count: int
    depths: tuple[float, float] | None
    note: str


def choose_level(data: xr.Dataset, name: str, axes: Axes, depth: float) -> Level:
    """Find the level of a variable at a depth in metres.

    Raises
    ------
    InputError
        If the depth is outside the levels, or cannot be told.
    """
    if not depth >= 0.0:
        raise InputError("must be at least 0 metres, counted down", field="depth", value=depth)
    if axes.depth is None:
        _only_surface(name, depth, "has no levels")
        return Level(None, 0, 0, 0.0, 0, None, "the file has one level, its depth unstated")
    values = data[axes.depth_variable] if axes.depth_variable in data.variables else None
    if values is None or is_sigma(values):
        _only_surface(name, depth, "lies on levels that follow the terrain")
        top = _top_of_sigma(values, axes.depth)
        return Level(
            axes.depth,
            top,
            top,
            0.0,
            data.sizes[axes.depth],
            None,
            "the surface layer, terrain-following",
        )
    return _between(name, axes.depth, _depths(values, axes.depth), depth)


def _only_surface(name: str, depth: float, reason: str) -> None:
    if depth > 0.0:
        raise InputError(
            f"{depth:g} m asked, but the variable {reason}, of which only the surface (depth 0) "
            "can be read; interpolate it to depths in metres first",
            field=name,
        )


def _top_of_sigma(values: xr.DataArray | None, dimension: str) -> int:
    """The layer nearest to the surface: s = 0 there, -1 at the bottom; ROMS's last one."""
    if values is None:
        return -1
    return int(np.argmin(np.abs(_along(values, dimension))))


def _depths(values: xr.DataArray, dimension: str) -> Floats:
    """Depths of levels in metres, positive down."""
    units = str(values.attrs.get("units", "")).strip().lower()
    is_unstated = units == "" and str(values.name).lower().startswith("depth")
    if units not in _METRES and not is_unstated:
        raise InputError(
            "is no unit of depth that can be read; give metres", field=str(values.name), value=units
        )
    depths = _along(values, dimension)
    up = str(values.attrs.get("positive", "")).lower() == "up"
    if up or (depths <= 0.0).all():
        depths = -depths
    return depths + 0.0


def _along(values: xr.DataArray, dimension: str) -> Floats:
    """Depths, or levels that follow the terrain, one for each level."""
    if values.dims != (dimension,) or values.size == 0:
        raise InputError(
            "must hold a depth for each level, along one dimension",
            field=str(values.name),
            value=values.shape,
        )
    depths = decoded(values)
    if not np.isfinite(depths).all():
        raise InputError("has levels without a depth", field=str(values.name))
    return depths


def _between(name: str, dimension: str, depths: Floats, depth: float) -> Level:
    order = np.argsort(depths)
    levels = depths[order]
    top, bottom = float(levels[0]), float(levels[-1])
    if depth > bottom or (depth < top and top > _NEAR_SURFACE):
        raise InputError(
            f"depth {depth:g} m asked, but the file has {top:g} .. {bottom:g} m", field=name
        )
    below = int(np.searchsorted(levels, depth))
    above = max(below - 1, 0) if levels[below] != depth else below
    share = 0.0
    if above != below:
        share = float((depth - levels[above]) / (levels[below] - levels[above]))
    note = f"level {levels[below]:g} m"
    if above != below:
        note = f"between levels {levels[above]:g} and {levels[below]:g} m"
    return Level(
        dimension,
        int(order[above]),
        int(order[below]),
        share,
        len(levels),
        (top, bottom),
        f"{depth:g} m: {note}",
    )
