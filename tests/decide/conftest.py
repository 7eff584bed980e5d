"""A sea in a file."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

LON, LAT = 4.8, 60.6


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    """Write a sea of an even current to the east, which grows by as much every hour."""

    def to_file(
        name: str,
        east: float = 0.2,
        *,
        west: float = -0.1,
        cells: int = 21,
        names: tuple[str, str] = ("uo", "vo"),
        begin: str = "2020-03-01T00:00",
        hours: int = 3,
        land: slice | None = None,
    ) -> Path:
        lon, lat = LON + np.linspace(west, 0.1, cells), LAT + np.linspace(-0.05, 0.05, cells)
        u = np.multiply.outer(np.arange(1.0, hours + 1.0), np.full((cells, cells), east))
        if land is not None:
            u[:, :, land] = np.nan
        kinds = ("eastward_sea_water_velocity", "northward_sea_water_velocity")
        data = {
            each: (("time", "lat", "lon"), values, {"standard_name": kind, "units": "m s-1"})
            for each, kind, values in zip(names, kinds, (u, 0.0 * u), strict=True)
        }
        places = {
            "time": np.datetime64(begin, "ns") + np.arange(hours) * np.timedelta64(1, "h"),
            "lat": ("lat", lat, {"units": "degrees_north"}),
            "lon": ("lon", lon, {"units": "degrees_east"}),
        }
        path = tmp_path / name
        xr.Dataset(data, places).to_netcdf(path, engine="h5netcdf")
        return path

    return to_file
