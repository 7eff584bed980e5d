"""What the variables of an ocean model's file are: velocities, axes, coordinates, masks.

Velocities are known by their CF standard names, and by the names that models give them where
they have none. Axes and coordinates are known by `axis`, standard name and units before their
name. Velocities stand to the east and north, or along the axes of the grid; those on
the faces of the cells of a C-grid (Arakawa and Lamb 1977) have axes of their own:

    ROMS    u (eta_u, xi_u), one column less than the cells, v (eta_v, xi_v), one row less
    NEMO    u on the eastern and v on the northern faces, in arrays as large as the cells'

References
----------
Climate and Forecast metadata conventions, https://cfconventions.org.
A. Arakawa and V. R. Lamb, "Computational design of the basic dynamical processes of the UCLA
general circulation model", Methods in Computational Physics 17 (1977),
doi 10.1016/B978-0-12-460817-7.50009-4.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fiveroute.errors import InputError

if TYPE_CHECKING:
    import xarray as xr

__all__ = [
    "Axes",
    "Velocity",
    "find_axes",
    "find_cells",
    "find_coordinate",
    "find_velocity",
    "is_sigma",
]

_STANDARD_NAMES = (
    ("eastward_sea_water_velocity", "northward_sea_water_velocity"),
    ("surface_eastward_sea_water_velocity", "surface_northward_sea_water_velocity"),
    ("x_sea_water_velocity", "y_sea_water_velocity"),
    ("sea_water_x_velocity", "sea_water_y_velocity"),
)
_NAMES = (
    ("uo", "vo"),
    ("utotal", "vtotal"),
    ("water_u", "water_v"),
    ("u_eastward", "v_northward"),
    ("u", "v"),
    ("u_sur", "v_sur"),
    ("vozocrtx", "vomecrty"),
)
_NEMO = ("vozocrtx", "vomecrty")
_ALONG_THE_GRID = {"u", "v", "u_sur", "v_sur", *_NEMO}  # if no standard name says otherwise

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
class Velocity:
    """The two components of the water's velocity.

    Parameters
    ----------
    u, v
        Names of their variables.
    is_along_grid
        Whether they stand along the axes of the grid rather than to the east and north.
    stagger
        The C-grid on whose faces they lie, "ROMS" or "NEMO"; empty where they lie together.
    """

    u: str
    v: str
    is_along_grid: bool
    stagger: str


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


def find_velocity(data: xr.Dataset, u: str | None = None, v: str | None = None) -> Velocity:
    """Find the components of the velocity, or take those that are named.

    Raises
    ------
    InputError
        If there are none, naming what there is.
    """
    if (u is None) != (v is None):
        raise InputError("needs both components: give u and v", field="u" if u is None else "v")
    if u is None or v is None:
        u, v = _by_standard_name(data) or _by_name(data) or _not_found(data)
    for name in (u, v):
        if name not in data.variables:
            _not_found(data, name)
    along = _is_along_grid(data, u)
    if along != _is_along_grid(data, v):
        raise InputError("u and v do not stand along the same axes", value=f"{u}, {v}")
    return Velocity(u, v, along, _stagger(data, u, v, along))


def _by_standard_name(data: xr.Dataset) -> tuple[str, str] | None:
    named = [name for pair in _NAMES for name in pair]

    def holder(standard_name: str) -> str | None:
        """The variable of a standard name; of several, that whose name comes first in our list."""
        held = [str(n) for n, a in data.variables.items() if _text(a.attrs) == standard_name]
        held.sort(key=lambda name: named.index(name) if name in named else len(named))
        return held[0] if held else None

    for pair in _STANDARD_NAMES:
        u, v = holder(pair[0]), holder(pair[1])
        if u is not None and v is not None:
            return u, v
    return None


def _by_name(data: xr.Dataset) -> tuple[str, str] | None:
    held = {str(name).lower(): str(name) for name in data.variables}
    return next(((held[u], held[v]) for u, v in _NAMES if u in held and v in held), None)


def _not_found(data: xr.Dataset, name: str | None = None) -> Any:
    found = ", ".join(str(name) for name in data.data_vars) or "no variables"
    if name is not None:
        raise InputError(f"is not in the file, which holds {found}", field=name)
    raise InputError(
        f"no velocities of sea water among {found}; name them with u= and v=",
        field="u, v",
    )


def _is_along_grid(data: xr.Dataset, name: str) -> bool:
    standard_name = _text(data[name].attrs)
    if "eastward" in standard_name or "northward" in standard_name:
        return False
    if {"x", "y"} & set(standard_name.split("_")):
        return True
    return name.lower() in _ALONG_THE_GRID


def _stagger(data: xr.Dataset, u: str, v: str, along: bool) -> str:
    """The C-grid of two components: ROMS's have other axes, NEMO's only other names."""
    axes_u, axes_v = find_axes(data, u), find_axes(data, v)
    if (axes_u.rows, axes_u.columns) != (axes_v.rows, axes_v.columns):
        return "ROMS"
    is_nemo = along and (u.lower(), v.lower()) == _NEMO
    return "NEMO" if is_nemo else ""


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
        _along(data, time, _is_time, set()) or None,
        _along(data, depth, _is_depth, set()) or None,
    )


def _is_along(data: xr.Dataset, kind: str, dim: str) -> bool:
    return any(_kind_rank(kind, n, data[n].attrs) < 3 for n in _lines(data, dim))


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


def _lines(data: xr.Dataset, dim: str) -> list[str]:
    """Variables along one dimension alone, that of its own name first."""
    names = [str(name) for name, held in data.variables.items() if held.dims == (dim,)]
    return sorted(names, key=lambda name: name != dim)


def _is_time(attributes: Mapping[Any, Any]) -> bool:
    return " since " in _text(attributes, "units")


def _is_depth(attributes: Mapping[Any, Any]) -> bool:
    return (
        _text(attributes, "axis") == "z"
        or "positive" in attributes
        or _text(attributes) in ("depth", "height")
        or is_sigma(attributes)
    )


def is_sigma(attributes: Mapping[Any, Any]) -> bool:
    """Whether levels follow the terrain."""
    return _text(attributes).startswith(("ocean_s_coordinate", "ocean_sigma", "ocean_double_sigma"))


def find_cells(data: xr.Dataset, velocity: Velocity, u: Axes, v: Axes) -> tuple[str, str]:
    """Dimensions of the rows and columns of the cells on whose grid the velocities lie.

    Raises
    ------
    InputError
        If the components lie on grids that do not belong to the same cells.
    """
    if velocity.stagger != "ROMS":
        return u.rows, u.columns
    sizes = data.sizes
    shape = sizes[v.rows] + 1, sizes[u.columns] + 1
    if (sizes[u.rows], sizes[v.columns]) == shape:
        for name, held in data.variables.items():
            if held.shape == shape and _kind_rank("lon", str(name), held.attrs) < 3:
                return str(held.dims[0]), str(held.dims[1])
    raise InputError(
        f"u ({sizes[u.rows]} x {sizes[u.columns]}) and v ({sizes[v.rows]} x {sizes[v.columns]}) "
        "are not on the faces of cells whose longitudes the file holds (lon_rho)",
        field=f"{velocity.u}, {velocity.v}",
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
        (_kind_rank(kind, str(name), held.attrs), str(name))
        for name, held in data.variables.items()
        if held.dims and set(held.dims) <= set(dims)
    ]
    rank, name = min(ranked, default=(3, ""))
    return name if rank < 3 else None


def _kind_rank(kind: str, name: str, attributes: Mapping[Any, Any]) -> int:
    """How a variable is known to be such a coordinate: 0 is the best sign, 3 is none."""
    standard_names, units, names = _COORDINATES[kind]
    signs = (
        _text(attributes) in standard_names,
        _text(attributes, "units") in units or _text(attributes, "axis") == kind,
        name.lower() in names,
    )
    return next((rank for rank, sign in enumerate(signs) if sign), 3)


def _text(attributes: Mapping[Any, Any], name: str = "standard_name") -> str:
    return str(attributes.get(name, "")).strip().lower()
