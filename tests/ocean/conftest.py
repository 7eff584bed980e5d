"""A small sea with a known current, written the way that ocean models write theirs."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]

EARTH = 6.371e6
LON, LAT = 4.8, 60.8
SCALE, MERIDIAN = 0.9330127, 70.0  # of the polar stereographic map of NorKyst-800
EAST = {"standard_name": "eastward_sea_water_velocity", "units": "m s-1"}
NORTH = {"standard_name": "northward_sea_water_velocity", "units": "m s-1"}


def truth(lon: Floats, lat: Floats) -> tuple[Floats, Floats]:
    """The current to the east and north on Earth in m/s; linear, so easy to interpolate."""
    across, up = (np.asarray(lon) - LON + 180.0) % 360.0 - 180.0, np.asarray(lat) - LAT
    return 0.3 + 0.4 * across - 0.6 * up, -0.1 + 0.2 * across + 0.8 * up


def packed(values: Floats, fill: int, attributes: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
    """Velocities as int16 thousandths."""
    numbers = np.where(np.isnan(values), fill, np.rint(np.nan_to_num(values) / 0.001))
    more = {"_FillValue": np.int16(fill), "scale_factor": 0.001, "add_offset": 0.0}
    return numbers.astype(np.int16), attributes | more


def hours(dim: str, count: int) -> tuple[str, Any, dict[str, str]]:
    units = {"units": "hours since 2020-03-01 00:00:00", "standard_name": "time"}
    return dim, np.arange(count) * 6.0, units


def cmems(lon: Floats, lat: Floats, land: Booleans | None = None) -> xr.Dataset:
    """Single precision, fill 9.96921e36; twice as fast at the second time, half at depth."""
    u, v = truth(*np.meshgrid(lon, lat))
    if land is not None:
        u, v = np.where(land, np.nan, u), np.where(land, np.nan, v)
    factors = np.outer([1.0, 2.0], [1.0, 0.5])[:, :, None, None]
    fill = np.float32(9.96921e36)
    single = [np.where(np.isnan(z), fill, factors * z).astype(np.float32) for z in (u, v)]
    dims = ("time", "depth", "latitude", "longitude")
    return xr.Dataset(
        {
            "uo": (dims, single[0], EAST | {"_FillValue": fill}),
            "vo": (dims, single[1], NORTH | {"_FillValue": fill}),
            "time": hours("time", 2),
            "depth": ("depth", [0.5, 10.5], {"units": "m", "positive": "down", "axis": "Z"}),
            "latitude": ("latitude", lat, {"units": "degrees_north"}),
            "longitude": ("longitude", lon, {"units": "degrees_east"}),
        }
    )


def hycom(lon: Floats, lat: Floats) -> xr.Dataset:
    """Packed, with two kinds of missing value; axes known by their names only."""
    u, v = truth(*np.meshgrid(lon, lat))
    dims = ("time", "depth", "lat", "lon")
    twice = {"missing_value": np.int16(-30001)}
    held = {
        name: (dims, *packed(part[None, None], -30000, attributes | twice))
        for name, part, attributes in (("water_u", u, EAST), ("water_v", v, NORTH))
    }
    more = {"time": hours("time", 1), "depth": ("depth", [0.0], {"units": "m"})}
    return xr.Dataset({**held, **more, "lat": ("lat", lat), "lon": ("lon", lon)})


def stereographic(x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
    """Longitude, latitude and the angle from east to the x axis, in closed form on a sphere."""
    turned = np.arctan2(x, -y)
    lat = 90.0 - 2.0 * np.degrees(np.arctan(np.hypot(x, y) / (2.0 * EARTH * SCALE)))
    return MERIDIAN + np.degrees(turned), lat, -turned


def axes(rows: int, columns: int, step: float = 800.0) -> tuple[Floats, Floats]:
    """Coordinates on the stereographic map, about (LON, LAT)."""
    far = 2.0 * EARTH * SCALE * np.tan(np.radians(90.0 - LAT) / 2.0)
    turned = np.radians(LON - MERIDIAN)
    x, y = far * np.sin(turned), -far * np.cos(turned)
    return (
        x + step * (np.arange(columns) - columns // 2),
        y + step * (np.arange(rows) - rows // 2),
    )


def along_grid(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The truth in components along the axes of the stereographic map."""
    lon, lat, angle = stereographic(x, y)
    east, north = truth(lon, lat)
    return (
        east * np.cos(angle) + north * np.sin(angle),
        north * np.cos(angle) - east * np.sin(angle),
    )


def norkyst(kilometres: bool = False) -> xr.Dataset:
    """Packed, along the axes of a polar stereographic map, without longitudes."""
    x, y = axes(14, 17)
    named = {"grid_mapping": "projection_stere", "units": "meter second-1"}
    held = {
        name: (
            ("time", "depth", "Y", "X"),
            *packed(
                part[None, None], -32767, named | {"standard_name": f"{axis}_sea_water_velocity"}
            ),
        )
        for name, axis, part in zip("uv", "xy", along_grid(*np.meshgrid(x, y)), strict=True)
    }
    mapping = {
        "grid_mapping_name": "polar_stereographic",
        "scale_factor_at_projection_origin": SCALE,
        "straight_vertical_longitude_from_pole": MERIDIAN,
        "latitude_of_projection_origin": 90.0,
        "earth_radius": EARTH,
    }
    unit, units = (1e3, "km") if kilometres else (1.0, "m")
    flat = {"units": units, "standard_name": "projection_x_coordinate"}
    return xr.Dataset(
        {
            **held,
            "projection_stere": ((), 0, mapping),
            "X": ("X", x / unit, flat),
            "Y": ("Y", y / unit, flat | {"standard_name": "projection_y_coordinate"}),
            "depth": ("depth", [0.0], {"units": "m", "positive": "down"}),
            "time": hours("time", 1),
        }
    )


def roms(wet: Booleans | None = None) -> xr.Dataset:
    """C-grid with an angle and masks, fill 1e37, above the surface layer one of nonsense."""
    x, y = axes(14, 17)
    wet = np.ones((14, 17), dtype=bool) if wet is None else wet
    open_u, open_v = wet[:, :-1] & wet[:, 1:], wet[:-1] & wet[1:]
    u = np.where(open_u, along_grid(*np.meshgrid(x[1:] - 400.0, y))[0], 1e37)
    v = np.where(open_v, along_grid(*np.meshgrid(x, y[1:] - 400.0))[1], 1e37)
    layers = [np.stack((np.where(z < 1e30, 9.0, z), z))[None].astype(np.float32) for z in (u, v)]
    lon, lat, angle = stereographic(*np.meshgrid(x, y))
    rho, fill = ("eta_rho", "xi_rho"), {"_FillValue": np.float32(1e37)}
    return xr.Dataset(
        {
            "u": (("ocean_time", "s_rho", "eta_u", "xi_u"), layers[0], fill),
            "v": (("ocean_time", "s_rho", "eta_v", "xi_v"), layers[1], fill),
            "s_rho": ("s_rho", [-0.9, -0.1], {"standard_name": "ocean_s_coordinate_g2"}),
            "lon_rho": (rho, lon, {"units": "degree_east"}),
            "lat_rho": (rho, lat, {"units": "degree_north"}),
            "angle": (rho, angle, {"units": "radians"}),
            "mask_rho": (rho, wet.astype(float)),
            "mask_u": (("eta_u", "xi_u"), open_u.astype(float)),
            "mask_v": (("eta_v", "xi_v"), open_v.astype(float)),
            "ocean_time": ("ocean_time", [0.0], {"units": "seconds since 2016-01-01"}),
        }
    )


def nemo(wet: Booleans | None = None) -> xr.Dataset:
    """C-grid with positions of the cells only, land as zeros."""
    x, y = axes(14, 17)
    wet = np.ones((14, 17), dtype=bool) if wet is None else wet
    lon, lat, _ = stereographic(*np.meshgrid(x, y))
    dims = ("time_counter", "y", "x")
    u = wet * along_grid(*np.meshgrid(x + 400.0, y))[0]
    v = wet * along_grid(*np.meshgrid(x, y + 400.0))[1]
    return xr.Dataset(
        {
            "vozocrtx": (dims, u[None], {"units": "m/s"}),
            "vomecrty": (dims, v[None], {"units": "m/s"}),
            "nav_lon": (("y", "x"), lon, {"units": "degrees_east"}),
            "nav_lat": (("y", "x"), lat, {"units": "degrees_north"}),
            "time_counter": hours("time_counter", 1),
        }
    )


@pytest.fixture
def sea() -> SimpleNamespace:
    """The true current and the files of models that hold it."""
    made = (truth, cmems, hycom, norkyst, roms, nemo, stereographic, axes)
    return SimpleNamespace(lon=LON, lat=LAT, **{part.__name__: part for part in made})
