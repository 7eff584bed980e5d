"""Seas that are no seas: well-formed netCDF files whose contents make no sense.

`spoilt_sea` takes one of five layouts that ocean models write (longitudes and latitudes along the
axes, in two dimensions, the staggered grids of ROMS and NEMO, a projection) and gives it one to
five faults: dimensions of other sizes or lost, variables lost, renamed, turned, of another type,
filled with what is no number, too large, or in no order; attributes lost, of another variable, or
absurd: units, calendars, fill values, scale factors, standard names, projections.
"""

from __future__ import annotations

import io
import random
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

__all__ = ["LAYOUTS", "file_of", "spoilt_sea"]

FILL = np.float32(9.96921e36)
NUMBERS: list[Any] = [
    *(0.0, -0.0, 1.0, -1.0, 1e-3, 1e-300, 1e308, -1e308, 1e37, FILL, np.nan, np.inf, -np.inf),
    *(0, 1, -1, -32767, 2**31 - 1, 360.0, -180.0, 90.0, 1e10, 1e5, np.array([1.0, 2.0]), "x", ""),
]
UNITS = [
    *(
        "m s-1",
        "m/s",
        "cm/s",
        "knots",
        "1",
        "",
        "%",
        "m",
        "km",
        "degrees",
        "degrees_east",
        "radian",
    ),
    *(
        "degrees_north",
        "degree",
        "seconds since 2020-01-01",
        "days since 0000-00-00",
        "hours since",
    ),
    *("hours since 2020-03-01 00:00:00 +99:00", "months since 1900-01-01", "days since 9999-12-31"),
    *(
        "since",
        " since ",
        "seconds since 1e9",
        "days since -4713-01-01",
        "fortnights since 2020-1-1",
    ),
    *("microseconds since 1677-01-01", "s since 2020-01-01T00:00:00Z", "\u00e9", "x" * 2000),
]
CALENDARS = ["standard", "gregorian", "julian", "360_day", "noleap", "none", "", "x", "366_day"]
STANDARD_NAMES = [
    *("eastward_sea_water_velocity", "northward_sea_water_velocity", "sea_water_x_velocity"),
    *("sea_water_y_velocity", "longitude", "latitude", "projection_x_coordinate", "time", "depth"),
    *(
        "ocean_s_coordinate_g2",
        "height",
        "grid_longitude",
        "sea_binary_mask",
        "land_binary_mask",
        "",
    ),
]
MAPPINGS = [
    *("polar_stereographic", "transverse_mercator", "rotated_latitude_longitude", "mercator"),
    *("latitude_longitude", "lambert_conformal_conic", "geostationary", "nonsense", ""),
]
PROJ = ["+proj=stere +lat_0=90 +lat_ts=60", "+proj=utm +zone=99", "+proj=x", "", "+init=epsg:4326"]
NAMES = [
    *(
        "u",
        "v",
        "uo",
        "vo",
        "vozocrtx",
        "vomecrty",
        "lon",
        "lat",
        "x",
        "y",
        "time",
        "depth",
        "angle",
    ),
    *("mask_rho", "mask_u", "umask", "tmask", "s_rho", "sigma", "ocean_time", "nav_lon", "crs"),
]


@dataclass
class Sea:
    """A file as dictionaries: sizes of dimensions; dimensions, values and attributes by name."""

    sizes: dict[str, int]
    variables: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, Any]]] = field(
        default_factory=dict
    )

    def add(self, name: str, dims: tuple[str, ...], values: Any, **attributes: Any) -> None:
        self.variables[name] = dims, np.asarray(values), attributes


def _velocity(sea: Sea, names: tuple[str, str], dims: list[tuple[str, ...]], **more: Any) -> None:
    for name, of in zip(names, dims, strict=True):
        shape = tuple(sea.sizes[dim] for dim in of)
        values = np.linspace(-0.5, 0.5, int(np.prod(shape))).reshape(shape).astype(np.float32)
        values[..., 0, 0] = FILL
        sea.add(name, of, values, units="m s-1", _FillValue=FILL, **more)


def _clock(sea: Sea, name: str = "time") -> None:
    count = sea.sizes[name]
    sea.add(name, (name,), 6.0 * np.arange(count), units="hours since 2020-03-01 00:00:00")


def _along_axes() -> Sea:
    sea = Sea({"time": 2, "depth": 2, "latitude": 4, "longitude": 5})
    _velocity(sea, ("uo", "vo"), [("time", "depth", "latitude", "longitude")] * 2)
    _clock(sea)
    sea.add("depth", ("depth",), [0.5, 10.0], units="m", positive="down", axis="Z")
    sea.add("latitude", ("latitude",), 60.0 + 0.01 * np.arange(4), units="degrees_north")
    sea.add("longitude", ("longitude",), 5.0 + 0.02 * np.arange(5), units="degrees_east")
    return sea


def _positions(sea: Sea, names: tuple[str, str], dims: tuple[str, str]) -> None:
    rows, columns = (sea.sizes[dim] for dim in dims)
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    sea.add(names[0], dims, 5.0 + 0.02 * i - 0.002 * j, units="degrees_east")
    sea.add(names[1], dims, 60.0 + 0.01 * j + 0.001 * i, units="degrees_north")


def _in_two_dimensions() -> Sea:
    sea = Sea({"time": 1, "j": 4, "i": 5})
    names = ("eastward_sea_water_velocity", "northward_sea_water_velocity")
    _velocity(sea, ("east", "north"), [("time", "j", "i")] * 2)
    for name, standard_name in zip(("east", "north"), names, strict=True):
        sea.variables[name][2]["standard_name"] = standard_name
    _clock(sea)
    _positions(sea, ("lon", "lat"), ("j", "i"))
    return sea


def _roms() -> Sea:
    sea = Sea(
        {"ocean_time": 2, "s_rho": 2, "eta_rho": 5, "xi_rho": 6}
        | {"eta_u": 5, "xi_u": 5, "eta_v": 4, "xi_v": 6}
    )
    first = ("ocean_time", "s_rho")
    _velocity(sea, ("u", "v"), [(*first, "eta_u", "xi_u"), (*first, "eta_v", "xi_v")])
    _clock(sea, "ocean_time")
    sea.add("s_rho", ("s_rho",), [-0.75, -0.25], standard_name="ocean_s_coordinate_g2")
    _positions(sea, ("lon_rho", "lat_rho"), ("eta_rho", "xi_rho"))
    sea.add("mask_rho", ("eta_rho", "xi_rho"), np.ones((5, 6)))
    sea.add("angle", ("eta_rho", "xi_rho"), np.full((5, 6), 0.1), units="radians")
    return sea


def _nemo() -> Sea:
    sea = Sea({"time_counter": 1, "deptht": 2, "y": 5, "x": 6})
    _velocity(sea, ("vozocrtx", "vomecrty"), [("time_counter", "deptht", "y", "x")] * 2)
    _clock(sea, "time_counter")
    sea.add("deptht", ("deptht",), [0.5, 3.0], units="m", positive="down")
    _positions(sea, ("nav_lon", "nav_lat"), ("y", "x"))
    return sea


def _projected() -> Sea:
    sea = Sea({"time": 1, "y": 4, "x": 5})
    _velocity(sea, ("u", "v"), [("time", "y", "x")] * 2, grid_mapping="stereo")
    _clock(sea)
    for name, start in (("x", 3e5), ("y", -2.3e6)):
        values = start + 800.0 * np.arange(sea.sizes[name])
        sea.add(name, (name,), values, units="m", standard_name=f"projection_{name}_coordinate")
    sea.add(
        *("stereo", (), np.int32(0)),
        grid_mapping_name="polar_stereographic",
        straight_vertical_longitude_from_pole=0.0,
        latitude_of_projection_origin=90.0,
        standard_parallel=60.0,
    )
    return sea


LAYOUTS: tuple[Callable[[], Sea], ...] = (_along_axes, _in_two_dimensions, _roms, _nemo, _projected)


# --- faults ---------------------------------------------------------------------------------------


def _values(sea: Sea, rng: random.Random) -> None:
    """Numbers written over, put out of order, or of another type."""
    name = rng.choice(list(sea.variables))
    dims, values, attributes = sea.variables[name]
    wide = np.array(values, dtype=np.float64)
    number = rng.choice([n for n in NUMBERS if np.ndim(n) == 0 and not isinstance(n, str)])
    way = rng.randrange(8)
    if way == 0:
        wide[...] = number
    elif way == 1 and wide.size:
        wide.flat[rng.randrange(wide.size)] = number
    elif way == 2 and wide.ndim:
        wide = np.flip(wide, rng.randrange(wide.ndim))
    elif way == 3:
        wide = (
            np.random.default_rng(rng.getrandbits(32)).permutation(wide.ravel()).reshape(wide.shape)
        )
    elif way == 4:
        with np.errstate(invalid="ignore"):
            wide = wide * rng.choice((0.0, -1.0, 1e-3, 1e3, 1e30))
    elif way == 5:
        wide = wide + rng.choice((180.0, 360.0, -360.0, 90.0, 1e6))
    elif way == 6:
        wide = np.round(wide)
    with np.errstate(all="ignore"):
        kind = rng.choice(("f4", "f8", values.dtype, values.dtype, "i2", "i4", "i1", "S1"))
        if kind == "S1":
            values = np.full(values.shape, b"7", dtype="S1")
        else:
            sane = wide if np.dtype(kind).kind == "f" else np.nan_to_num(wide) % 100
            values = np.array(sane, dtype=kind)
    sea.variables[name] = dims, values, attributes


def _attribute(sea: Sea, rng: random.Random) -> None:
    """An attribute lost, another one's, or absurd."""
    attributes = sea.variables[rng.choice(list(sea.variables))][2]
    way = rng.random()
    if way < 0.25 and attributes:
        del attributes[rng.choice(list(attributes))]
        return
    name, choices = rng.choice(_ATTRIBUTES)
    if name == "any" and attributes:
        name = rng.choice(list(attributes))
    attributes[name] = rng.choice(choices if way < 0.9 else NUMBERS)


_ATTRIBUTES: tuple[tuple[str, list[Any]], ...] = (
    ("units", UNITS),
    ("units", UNITS),
    ("calendar", CALENDARS),
    ("standard_name", STANDARD_NAMES),
    ("standard_name", STANDARD_NAMES),
    ("_FillValue", NUMBERS),
    ("missing_value", NUMBERS),
    ("scale_factor", NUMBERS),
    ("add_offset", NUMBERS),
    ("positive", ["up", "down", "", "sideways"]),
    ("axis", ["X", "Y", "Z", "T", "x", ""]),
    ("grid_mapping", [*NAMES, "stereo", "stereo: x y", ":", ""]),
    ("grid_mapping_name", MAPPINGS),
    ("proj4", PROJ),
    ("standard_parallel", NUMBERS),
    ("mesh", ["mesh2d"]),
    ("any", NUMBERS),
)


def _variable(sea: Sea, rng: random.Random) -> None:
    """A variable lost, renamed, copied, turned, or of other dimensions."""
    name = rng.choice(list(sea.variables))
    dims, values, attributes = sea.variables[name]
    way = rng.randrange(6)
    if way == 0:
        del sea.variables[name]
    elif way == 1:
        sea.variables[rng.choice(NAMES)] = sea.variables.pop(name)
    elif way == 2:
        sea.variables[rng.choice(NAMES)] = dims, values.copy(), dict(attributes)
    elif way == 3 and values.ndim > 1:
        order = rng.sample(range(values.ndim), values.ndim)
        turned = tuple(dims[k] for k in order)
        sea.variables[name] = turned, np.transpose(values, order), attributes
    elif way == 4 and values.ndim:
        lost = rng.randrange(values.ndim)
        if values.shape[lost]:
            kept = (*dims[:lost], *dims[lost + 1 :])
            sea.variables[name] = kept, np.take(values, 0, axis=lost), attributes
    elif way == 5:
        sea.sizes.setdefault("member", rng.choice((1, 2)))
        if "member" not in dims:
            more = np.broadcast_to(values, (sea.sizes["member"], *values.shape))
            sea.variables[name] = ("member", *dims), more, attributes


def _dimension(sea: Sea, rng: random.Random) -> None:
    """A dimension of another size or name."""
    dim = rng.choice(list(sea.sizes))
    if rng.random() < 0.3:
        new = rng.choice([*NAMES, "nele", "node", "station", "lev"])
        if new not in sea.sizes:
            sea.sizes = {new if name == dim else name: n for name, n in sea.sizes.items()}
            for name, (dims, values, attributes) in sea.variables.items():
                named = tuple(new if one == dim else one for one in dims)
                sea.variables[name] = named, values, attributes
        return
    size = rng.choice((0, 1, 2, 3, 7, 40))
    sea.sizes[dim] = size
    for name, (dims, values, attributes) in sea.variables.items():
        if dim in dims:
            along = dims.index(dim)
            if not values.shape[along]:
                values = np.zeros([sea.sizes[one] for one in dims], values.dtype)
            else:
                at = np.arange(size) % values.shape[along]
                values = np.take(values, at, axis=along)
            sea.variables[name] = dims, values, attributes


_FAULTS = (_values, _values, _attribute, _attribute, _attribute, _variable, _dimension)


def _sea(rng: random.Random) -> Sea:
    sea = rng.choice(LAYOUTS)()
    for _ in range(rng.choice((1, 1, 2, 3, 5))):
        if sea.variables:
            rng.choice(_FAULTS)(sea, rng)
    return sea


def spoilt_sea(rng: random.Random) -> bytes:
    """A file with one to five faults; one in ten is netCDF-4, which takes longer to write."""
    return file_of(_sea(rng), rng.random() < 0.1)


def file_of(sea: Sea, is_new: bool = False) -> bytes:
    """A sea as netCDF-3, or as netCDF-4, which h5netcdf cannot write with nothing along an axis."""
    return (_new if is_new and all(sea.sizes.values()) else _old)(sea)


def _old(sea: Sea) -> bytes:
    from scipy.io import netcdf_file

    stream = io.BytesIO()
    held = netcdf_file(stream, "w", version=2)
    for dim, size in sea.sizes.items():
        held.createDimension(dim, size)
    for name, (dims, values, attributes) in sea.variables.items():
        kind = values.dtype if values.dtype.str[1:] in _KINDS else np.dtype("f8")
        variable = held.createVariable(name, kind, dims)
        variable.__dict__["data"] = np.array(values, dtype=kind.newbyteorder(">"), order="C")
        for key, value in attributes.items():
            setattr(variable, key.replace(*_VEIL), _kept(value))
    held.flush()
    return stream.getvalue().replace(*(key.encode() for key in reversed(_VEIL)))


_KINDS = ("f4", "f8", "i2", "i4", "i1", "S1")
_VEIL = "_FillValue", "_FillVeil_"  # scipy would refuse to write some


def _kept(value: Any) -> Any:
    """An attribute as netCDF-3 can hold it."""
    if isinstance(value, str):
        return value.encode() or b" "
    array = np.asarray(value)
    return array.astype(np.float64 if array.dtype.kind == "f" else np.int32)


def _new(sea: Sea) -> bytes:
    import h5netcdf

    stream = io.BytesIO()
    with h5netcdf.File(stream, "w") as held:
        held.dimensions = dict(sea.sizes)
        for name, (dims, values, attributes) in sea.variables.items():
            variable = held.create_variable(name, dims, data=np.ascontiguousarray(values))
            for key, value in attributes.items():
                variable._h5ds.attrs[key] = value  # whatever its type; h5netcdf refuses some
    return stream.getvalue()
