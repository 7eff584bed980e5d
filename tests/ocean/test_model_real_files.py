"""Two real files: NorKyst-800 (MET Norway) and WCOFS (NOAA); the folder is FIVEROUTE_DATA."""

from collections.abc import Callable
from pathlib import Path

import h5py  # type: ignore[import-untyped]
import numpy as np
import pyproj
import pytest
from numpy.typing import NDArray

from fiveroute.ocean.model_current import read_current
from fiveroute.ocean.model_file import open_model_file
from fiveroute.ocean.model_source import Source, read_source

Floats = NDArray[np.float64]

NAMES = ("currents/norkyst800_60x60x25h.nc", "currents/WCOFS_subset.nc")

Public = Callable[[str], Path]


def source(path: Path) -> Source:
    with open_model_file(path) as data:
        return read_source(data, origin=None, depth=0.0, u=None, v=None, reach=250e3)


def on_the_map(read: Source, lon: Floats, lat: Floats, w: NDArray[np.complex128]) -> Floats:
    """Velocities on Earth carried to the map along geodesics of a hundred seconds."""
    azimuth, length = np.degrees(np.arctan2(w.real, w.imag)), np.abs(w) * 100.0
    after = pyproj.Geod(ellps="WGS84").fwd(lon, lat, azimuth, length)[:2]
    steps = [
        b - a for a, b in zip(read.plane.project(lon, lat), read.plane.project(*after), strict=True)
    ]
    return np.asarray(steps) / 100.0


def test_norkyst_stands_65_degrees_from_east(public_file: Public) -> None:
    path = public_file(NAMES[0])
    read = source(path)
    assert "65.2 degrees anticlockwise" in read.notes["rotation"]
    with h5py.File(path) as raw:
        proj = pyproj.Proj(raw["projection_stere"].attrs["proj4"].decode())
        x, y = np.meshgrid(raw["X"][:], raw["Y"][:])
        u, v = (np.where(raw[c][:, 0] == -32767, np.nan, raw[c][:, 0] * 0.001) for c in "uv")
    lon, lat = proj(x, y, inverse=True)
    ahead = proj(x + 10.0, y, inverse=True)
    turn = np.arctan2(ahead[1] - lat, (ahead[0] - lon) * np.cos(np.radians(lat)))
    np.testing.assert_allclose(np.degrees(turn), 70.0 - lon, atol=1e-3)  # lon_0 of the map
    expected = on_the_map(read, lon, lat, (u[12] + 1j * v[12]) * np.exp(1j * turn))
    assert (np.isnan(expected[0]) == np.isnan(u[12] + v[12])).all()
    # on the ellipsoid the axes of the sphere's map turn by 0.03 degrees
    np.testing.assert_allclose(read.cells.w[12].real, expected[0], atol=1e-3)
    np.testing.assert_allclose(read.cells.w[12].imag, expected[1], atol=1e-3)
    np.testing.assert_allclose(np.abs(read.cells.w), np.hypot(u, v), rtol=1e-6)


def test_wcofs_is_brought_to_its_cells_and_turned(public_file: Public) -> None:
    path = public_file(NAMES[1])
    read = source(path)
    with h5py.File(path) as raw:
        names = ("u_sur", "v_sur", "angle", "lon_rho", "lat_rho", "mask_rho")
        u, v, angle, lon, lat, wet = (raw[name][:] for name in names)
    u, v = np.where(u > 1e30, 0.0, u), np.where(v > 1e30, 0.0, v)
    checked = 0
    for j in range(1, 67):
        for i in range(1, 36):
            cell = read.cells.w[1, j - 1, i - 1]
            assert np.isnan(cell) == (wet[j, i] == 0)
            if wet[j, i] and (7 * j + i) % 11 == 0:
                along = (u[1, j, i - 1] + u[1, j, i]) / 2, (v[1, j - 1, i] + v[1, j, i]) / 2
                east = along[0] * np.cos(angle[j, i]) - along[1] * np.sin(angle[j, i])
                north = along[0] * np.sin(angle[j, i]) + along[1] * np.cos(angle[j, i])
                expected = on_the_map(read, lon[j, i], lat[j, i], np.array(east + 1j * north))
                assert (cell.real, cell.imag) == pytest.approx(tuple(expected), abs=1e-4)
                checked += 1
    assert checked > 100


@pytest.mark.parametrize("name", NAMES)
def test_the_map_keeps_what_the_cells_hold(name: str, public_file: Public) -> None:
    path = public_file(name)
    read, current = source(path), read_current(path)
    assert np.isfinite(current.grid.uv).all()
    wet = ~read.cells.land
    t = float(current.times[1])
    u, v = current(read.cells.x[wet], read.cells.y[wet], t)
    off = np.abs(u + 1j * v - read.cells.w[1][wet])
    rms = np.sqrt(np.mean(np.abs(read.cells.w[1][wet]) ** 2))
    assert np.sqrt(np.mean(off**2)) < 0.03 * rms
    j, i = (
        np.rint((place - first) / current.step).astype(int)
        for place, first in ((read.cells.y, current.south), (read.cells.x, current.west))
    )
    np.testing.assert_array_equal(current.land[j, i], read.cells.land)
