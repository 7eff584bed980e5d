"""Axes and coordinates of the variables in an ocean model's file.

They are known by `axis`, standard name and units before their name, as the CF conventions
(https://cfconventions.org) have it; models that write none of these are known by the
names that they give.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fiveroute.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Axes", "attribute", "coordinate_rank", "find_axes", "find_coordinate", "is_sigma"]

_SIGMA = {"s_rho", "sigma", "siglay"}
_UNSTRUCTURED = {"node", "nele", "cell", "ncells", "ncol", "nod2", "elem"}
_TIMES = {"time", "ocean_time", "time_counter", "mt"}
_DEPTHS = {"depth", "deptht", "depthu", "depthv", "lev", "level", "z", *_SIGMA}
_COORDINATES = {
    "lon": (
        ("longitude",),
        ("degrees_east", "degree_east", "degrees_e", "degree_e", "degreese", "degreee"),
        ("lon", "longitude", "nav_lon", "lon_rho", "glamt"),
    ),
    "lat": (
        ("latitude",),
        ("degrees_north", "degree_north", "degrees_n", "degree_n", "degreesn", "degreen"),
        ("lat", "latitude", "nav_lat", "lat_rho", "gphit"),
    ),
    "x": (("projection_x_coordinate", "grid_longitude"), (), ("x", "xc", "rlon")),
    "y": (("projection_y_coordinate", "grid_latitude"), (), ("y", "yc", "rlat")),
}


@dataclass(frozen=True, slots=True)
class Axes:
    """Dimensions of a variable; those that it has not are None.

    Parameters
    ----------
    rows, columns
        The horizontal ones.
    time, depth
        The others.
    time_variable, depth_variable
        Names of the variables with the values along them.
    """

    rows: str
    columns: str
    time: str | None
    depth: str | None
    time_variable: str | None
    depth_variable: str | None


def find_axes(data: xr.Dataset, name: str) -> Axes:
    """Tell the dimensions of a variable apart.

    Raises
    ------
    InputError
        If the grid is unstructured, or a dimension is not understood.
    """
    variable, dims = data[name], [str(dim) for dim in data[name].dims]
    time = next((dim for dim in dims if _along(data, dim, _is_time, _TIMES)), None)
    depth = next(
        (dim for dim in dims if dim != time and _along(data, dim, _is_depth, _DEPTHS)), None
    )
    flat = [dim for dim in dims if dim not in (time, depth)]
    if "mesh" in variable.attrs or len(flat) < 2 or _UNSTRUCTURED & {dim.lower() for dim in flat}:
        raise InputError(
            f"lies on an unstructured grid ({', '.join(dims)}); interpolate it to a grid of "
            "longitudes and latitudes first",
            field=name,
        )
    *others, rows, columns = flat
    for dim in others:
        if variable.sizes[dim] != 1:
            raise InputError(
                f"has a dimension of size {variable.sizes[dim]} that is neither time, depth nor "
                "horizontal; cut one member out of the file",
                field=f"{name}.{dim}",
            )
    for kinds in (("lon", "lat"), ("x", "y")):
        if _is_along(data, kinds[0], rows) or _is_along(data, kinds[1], columns):
            rows, columns = columns, rows
            break
    return Axes(
        rows,
        columns,
        time,
        depth,
        _held(data, _along(data, time, _is_time, _TIMES)),
        _held(data, _along(data, depth, _is_depth, _DEPTHS)),
    )


def _is_along(data: xr.Dataset, kind: str, dim: str) -> bool:
    return any(coordinate_rank(kind, n, data[n].attrs) < 3 for n in _lines(data, dim))


def _along(
    data: xr.Dataset,
    dim: str | None,
    matches: Callable[[Mapping[Any, Any]], bool],
    names: set[str],
) -> str:
    """Name of the variable along a dimension that matches, or of the dimension if listed."""
    if dim is None:
        return ""
    found = (name for name in _lines(data, dim) if matches(data[name].attrs))
    return next(found, dim if dim.lower() in names else "")


def _held(data: xr.Dataset, name: str) -> str | None:
    return name if name in data.variables else None


def _lines(data: xr.Dataset, dim: str) -> list[str]:
    """Variables along one dimension alone, that of its own name first."""
    names = [str(name) for name, held in data.variables.items() if held.dims == (dim,)]
    return sorted(names, key=lambda name: name != dim)


def _is_time(attributes: Mapping[Any, Any]) -> bool:
    return " since " in attribute(attributes, "units")


def _is_depth(attributes: Mapping[Any, Any]) -> bool:
    return (
        attribute(attributes, "axis") == "z"
        or "positive" in attributes
        or attribute(attributes) in ("depth", "height")
        or _is_named_sigma(attributes)
    )


def is_sigma(variable: xr.DataArray) -> bool:
    """Whether the levels along a variable follow the terrain."""
    return str(variable.name).lower() in _SIGMA or _is_named_sigma(variable.attrs)


def _is_named_sigma(attributes: Mapping[Any, Any]) -> bool:
    return attribute(attributes).startswith(
        ("ocean_s_coordinate", "ocean_sigma", "ocean_double_sigma")
    )


def find_coordinate(data: xr.Dataset, kind: str, dims: tuple[str, str]) -> str | None:
    """Find a horizontal coordinate.

    Parameters
    ----------
    data
        The file.
    kind
        "lon", "lat", or "x", "y" of a projection.
    dims
        Dimensions along which it may vary, rows and columns.

    Returns
    -------
    str or None
        Name of the variable: of several that which is known by the better sign.
    """
    ranked = [
        (coordinate_rank(kind, str(name), held.attrs), str(name))
        for name, held in data.variables.items()
        if held.dims and set(held.dims) <= set(dims)
    ]
    rank, name = min(ranked, default=(3, ""))
    return name if rank < 3 else None


def coordinate_rank(kind: str, name: str, attributes: Mapping[Any, Any]) -> int:
    """How a variable is known to be such a coordinate: 0 is the best sign, 3 is none."""
    standard_names, units, names = _COORDINATES[kind]
    signs = (
        attribute(attributes) in standard_names,
        attribute(attributes, "units") in units or attribute(attributes, "axis") == kind,
        name.lower() in names,
    )
    return next((rank for rank, sign in enumerate(signs) if sign), 3)


def attribute(attributes: Mapping[Any, Any], name: str = "standard_name") -> str:
    """An attribute as text in small letters; empty if it is absent."""
    return str(attributes.get(name, "")).strip().lower()
