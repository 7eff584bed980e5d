"""Which variables of an ocean model's file are the velocity, and on what grid it lies.

Velocities are known by their CF standard names (https://cfconventions.org), and by the names that
models give them where they have none. They stand to the east and north, or along the axes of
the grid; those on the faces of the cells of a C-grid (Arakawa and Lamb 1977) lie apart:

    ROMS    u (eta_u, xi_u), one column less than the cells, v (eta_v, xi_v), one row less
    NEMO    u on the eastern and v on the northern faces, in arrays as large as the cells'

References
----------
A. Arakawa and V. R. Lamb, "Computational design of the basic dynamical processes of the UCLA
general circulation model", Methods in Computational Physics 17 (1977),
doi 10.1016/B978-0-12-460817-7.50009-4.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fiveroute.errors import InputError
from fiveroute.ocean.model_axes import Axes, attribute, coordinate_rank, find_axes

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Velocity", "find_cells", "find_velocity"]

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
        held = [str(n) for n, a in data.variables.items() if attribute(a.attrs) == standard_name]
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
    standard_name = attribute(data[name].attrs)
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
            if held.shape == shape and coordinate_rank("lon", str(name), held.attrs) < 3:
                return str(held.dims[0]), str(held.dims[1])
    raise InputError(
        f"u ({sizes[u.rows]} x {sizes[u.columns]}) and v ({sizes[v.rows]} x {sizes[v.columns]}) "
        "are not on the faces of cells whose longitudes the file holds (lon_rho)",
        field=f"{velocity.u}, {velocity.v}",
    )
