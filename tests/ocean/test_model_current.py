import dataclasses
from pathlib import Path
from types import SimpleNamespace

import h5py  # type: ignore[import-untyped]
import numpy as np
import pyproj
import pytest
import xarray as xr
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.model_current import ModelCurrent, read_current

Floats = NDArray[np.float64]

LONS: Floats = 4.8 + np.arange(-8.0, 9.0) * 0.02
LATS: Floats = 60.8 + np.arange(-9.0, 10.0) * 0.01


def written(data: xr.Dataset, folder: Path, engine: str = "h5netcdf") -> Path:
    path = folder / "model.nc"
    data.to_netcdf(path, engine="scipy" if engine == "scipy" else "h5netcdf")
    return path


def on_the_map(current: ModelCurrent, sea: SimpleNamespace, x: Floats, y: Floats) -> list[Floats]:
    """The true velocity on the map: where the water gets along a geodesic in ten seconds."""
    lon, lat = current.plane.unproject(x, y)
    east, north = sea.truth(lon, lat)
    way = np.degrees(np.arctan2(east, north)), np.hypot(east, north) * 10.0
    after = pyproj.Geod(ellps="WGS84").fwd(lon, lat, *way)[:2]
    return [(b - a) / 10.0 for a, b in zip((x, y), current.plane.project(*after), strict=True)]


def open_water(current: ModelCurrent, count: int = 200) -> tuple[Floats, Floats]:
    """Positions well within the data and clear of land."""
    rng = np.random.default_rng(7)
    y, x = np.nonzero(~current.closed)
    inner = np.array(
        [
            not current.closed[max(j - 5, 0) : j + 6, max(i - 5, 0) : i + 6].any()
            and 5 <= j < current.land.shape[0] - 5
            and 5 <= i < current.land.shape[1] - 5
            for j, i in zip(y, x, strict=True)
        ]
    )
    chosen = rng.choice(np.flatnonzero(inner), count)
    wobble = rng.uniform(-0.5, 0.5, (2, count))
    return (
        current.west + current.step * (x[chosen] + wobble[0]),
        current.south + current.step * (y[chosen] + wobble[1]),
    )


FILES = {
    "cmems": lambda sea: sea.cmems(LONS, LATS),
    "descending latitudes": lambda sea: sea.cmems(LONS, LATS[::-1]),
    "0 to 360": lambda sea: sea.hycom(LONS % 360.0 + 360.0, LATS),
    "latitude last": lambda sea: sea.cmems(LONS, LATS).transpose(
        "longitude", "time", "latitude", "depth"
    ),
    "hycom": lambda sea: sea.hycom(LONS, LATS),
    "norkyst": lambda sea: sea.norkyst(),
    "kilometres": lambda sea: sea.norkyst(kilometres=True),
    "descending x": lambda sea: sea.norkyst().isel(X=slice(None, None, -1)),
    "descending y": lambda sea: sea.norkyst().isel(Y=slice(None, None, -1)),
    "roms": lambda sea: sea.roms(),
    "no angle": lambda sea: sea.roms().drop_vars("angle"),
    "no masks": lambda sea: sea.roms().drop_vars(["mask_u", "mask_v", "mask_rho"]),
    "nemo": lambda sea: sea.nemo(),
}


@pytest.mark.parametrize("kind", FILES)
def test_reads_the_true_current(kind: str, sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(FILES[kind](sea), tmp_path), origin=(4.83, 60.77))
    x, y = open_water(current)
    u, v = current(x, y, 0.0)
    true_u, true_v = on_the_map(current, sea, x, y)
    # packing rounds both components to 0.0005 m/s; the truth bends on the map by less than 1e-4
    np.testing.assert_allclose(u, true_u, atol=8e-4)
    np.testing.assert_allclose(v, true_v, atol=8e-4)


@pytest.mark.parametrize(
    "kind", ["0 to 360", "descending latitudes", "descending x", "roms", "nemo"]
)
def test_reads_no_further_than_its_reach(kind: str, sea: SimpleNamespace, tmp_path: Path) -> None:
    path = written(FILES[kind](sea), tmp_path)
    near, far = (read_current(path, origin=(4.83, 60.79), reach=reach) for reach in (3e3, 1e5))
    assert near.coverage.lon[0] > far.coverage.lon[0]
    x, y = np.random.default_rng(5).uniform(-1e3, 1e3, (2, 50))
    np.testing.assert_allclose(near(x, y), far(x, y), atol=1e-3)


def test_knows_longitudes_beside_a_projection(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.norkyst()
    lon, lat, _ = sea.stereographic(*np.meshgrid(data["X"], data["Y"]))
    data["lon"] = ("Y", "X"), lon, {"standard_name": "longitude"}
    data["lat"] = ("Y", "X"), lat, {"standard_name": "latitude"}
    one = read_current(written(data, tmp_path), origin=(4.83, 60.79))
    assert "two dimensions" in one.provenance["positions"]
    other = read_current(written(data.drop_vars(["lon", "lat"]), tmp_path), origin=(4.83, 60.79))
    np.testing.assert_allclose(one.grid.uv, other.grid.uv, atol=1e-6)
    turned = data.isel(X=slice(None, None, -1), Y=slice(None, None, -1))
    third = read_current(written(turned, tmp_path), origin=(4.83, 60.79))
    np.testing.assert_allclose(third.grid.uv, other.grid.uv, atol=1e-6)


def test_reads_netcdf_3(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.cmems(LONS, LATS)
    one = read_current(written(data, tmp_path, "scipy"))
    other = read_current(written(data, tmp_path))
    np.testing.assert_array_equal(one.grid.uv, other.grid.uv)


@pytest.mark.parametrize("lon", [0.0, -180.0, 179.99])
def test_joins_a_globe_where_its_longitudes_begin(
    lon: float, sea: SimpleNamespace, tmp_path: Path
) -> None:
    lons, lats = np.arange(0.0, 360.0, 0.5), np.arange(58.0, 64.0, 0.5)
    data = sea.cmems(lons, lats)
    data["uo"].values[:], data["vo"].values[:] = 0.25, 0.0
    current = read_current(written(data, tmp_path), origin=(lon, 61.0))
    assert current.coverage.lon[0] < lon < current.coverage.lon[1]
    assert current.grid.covered[10:-10, 10:-10].all()
    assert current(0.0, 0.0, 0.0)[0] == pytest.approx(0.25, abs=1e-6)
    with pytest.raises(InputError, match="give the longitude and latitude of the mission"):
        read_current(written(data, tmp_path))


def test_keeps_land_and_takes_nothing_of_it(sea: SimpleNamespace, tmp_path: Path) -> None:
    land = np.zeros((19, 17), dtype=bool)
    land[5:9, 3:8] = True
    data = sea.cmems(LONS, LATS, land)
    data["uo"].values[:] = np.where(land, data["uo"].values, 0.4)
    data["vo"].values[:] = np.where(land, data["vo"].values, 0.0)
    current = read_current(written(data, tmp_path))
    assert np.isfinite(current.grid.uv).all()
    speed = np.hypot(*np.moveaxis(current.grid.uv[0], -1, 0))
    np.testing.assert_allclose(speed, 0.4, atol=2e-4)  # bilinear: directions differ a little
    j, i = (part.astype(np.float64) for part in np.nonzero(current.land))
    lon, lat = current.plane.unproject(
        current.west + current.step * i, current.south + current.step * j
    )
    assert lon.min() == pytest.approx(LONS[3] - 0.01, abs=0.011)
    assert lon.max() == pytest.approx(LONS[7] + 0.01, abs=0.011)
    assert lat.min() == pytest.approx(LATS[5] - 0.005, abs=0.006)
    assert lat.max() == pytest.approx(LATS[8] + 0.005, abs=0.006)
    assert "20 of 323" in current.provenance["land"]


def test_zeros_are_land_only_by_a_mask(sea: SimpleNamespace, tmp_path: Path) -> None:
    wet = np.ones((14, 17), dtype=bool)
    wet[4:7, 5:9] = False
    data = sea.nemo(wet)
    bare = read_current(written(data, tmp_path))
    assert not bare.land.any()
    assert "6 cells of which never move" in bare.provenance["land"]
    data["tmask"] = ("t", "y", "x"), wet[None].astype(np.int8)
    masked = read_current(written(data, tmp_path))
    cells = masked.land.sum() * (masked.step / masked.grid.spacing) ** 2
    assert cells == pytest.approx(12.0, abs=1.0)
    assert "12 of 208 cells, by tmask" in masked.provenance["land"]


def test_land_binary_mask_is_one_on_land(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.norkyst()
    land = np.zeros((14, 17), dtype=np.int8)
    land[0, 0] = 1
    data["m"] = ("Y", "X"), land, {"standard_name": "land_binary_mask"}
    assert "1 of 238 cells" in read_current(written(data, tmp_path)).provenance["land"]


def test_is_linear_in_depth_and_time(sea: SimpleNamespace, tmp_path: Path) -> None:
    path = written(sea.cmems(LONS, LATS), tmp_path)
    surface = read_current(path)
    u, _ = surface(100.0, 200.0, 0.0)
    assert surface(100.0, 200.0, 1.5 * 3600.0)[0] == pytest.approx(1.25 * u)
    assert surface(100.0, 200.0, 6.0 * 3600.0)[0] == pytest.approx(2.0 * u)
    deeper = read_current(path, depth=5.5)
    assert deeper(100.0, 200.0, 0.0)[0] == pytest.approx(0.75 * u, rel=1e-6)
    assert read_current(path, depth=10.5)(100.0, 200.0)[0] == pytest.approx(0.5 * u, rel=1e-6)
    assert surface.coverage.depth == (0.5, 10.5)
    with pytest.raises(InputError, match=r"uo: depth 11 m asked, .* has 0.5 \.\. 10.5 m"):
        read_current(path, depth=11.0)


def test_counts_time_from_the_mission_s_begin(sea: SimpleNamespace, tmp_path: Path) -> None:
    path = written(sea.cmems(LONS, LATS), tmp_path)
    first, later = read_current(path), read_current(path, begin="2020-03-01T03:00")
    assert later(0.0, 0.0, 0.0)[0] == first(0.0, 0.0, 3.0 * 3600.0)[0]
    with pytest.raises(InputError, match=r"begin: .*within the times of the file, 2020-03-01T00"):
        read_current(path, begin="2021-01-01")


def test_says_what_is_asked_and_what_there_is(sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(sea.cmems(LONS, LATS), tmp_path))
    east = float(current.plane.project(LONS[-1:], LATS[9:10])[0][0])
    with pytest.raises(InputError, match=r"uo, vo: x = 0 \.\. 30000 m asked, .* cover x = -"):
        current([0.0, 30000.0], 0.0, 0.0)
    with pytest.raises(InputError, match=r"y = -30000 m asked, .* cover y = -"):
        current(0.0, -30000.0, 0.0)
    with pytest.raises(InputError, match=r"t = 21601 s .* t = 0 \.\. 21600 s \(2020-03-01T00"):
        current(0.0, 0.0, 21601.0)
    with pytest.raises(InputError, match="x = nan"):
        current(np.nan, 0.0, 0.0)
    assert np.isfinite(current(east, 0.0, 21600.0)).all()


def test_a_turned_grid_ends_at_its_own_edge(sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(sea.norkyst(), tmp_path))
    ranges = current.coverage
    with pytest.raises(InputError, match="beyond the edge of the data"):
        current(ranges.x[0], ranges.y[0], 0.0)
    extended = dataclasses.replace(current, extends=True)
    assert np.isfinite(extended(ranges.x[0] - 1e5, ranges.y[0], 0.0)).all()
    assert current.closed[0, 0]
    assert not current.land[0, 0]
    with pytest.raises(InputError, match="nan"):
        extended(np.nan, 0.0)


def test_a_single_field_is_steady(sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(sea.norkyst(), tmp_path))
    assert current.is_steady
    assert current(0.0, 0.0, 1e9)[0] == current(0.0, 0.0, 0.0)[0]


def test_broadcasts_like_every_current(sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(sea.cmems(LONS, LATS), tmp_path))
    x, y, t = np.array([[0.0, 500.0]]), np.array([[0.0], [100.0], [200.0]]), 4000.0
    u, v = current(x, y, t)
    assert u.shape == v.shape == (3, 2)
    assert (u[2, 1], v[2, 1]) == tuple(float(part) for part in current(500.0, 200.0, 4000.0))
    assert current(0.0, 0.0, np.array([0.0, 60.0, 120.0]))[0].shape == (3,)


def test_planners_can_grid_it(sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(sea.norkyst(), tmp_path))
    grid = grid_current(current, Region(-2000.0, -2000.0, 2000.0, 2000.0))
    assert grid.step <= current.grid.spacing / 2.0 + 1e-6
    u, _ = current(500.0, -700.0)
    assert grid.uv.shape[0] == 1
    assert abs(grid.uv[..., 0] - u).max() < 0.2


def test_names_what_it_found(tmp_path: Path) -> None:
    data = xr.Dataset({"salt": ("x", [1.0]), "temp": ("x", [2.0])})
    with pytest.raises(InputError, match=r"model.nc, u, v: no velocities .* salt, temp; name them"):
        read_current(written(data, tmp_path))


def test_a_mask_of_another_name_for_its_levels_is_read_at_the_depth(
    sea: SimpleNamespace, tmp_path: Path
) -> None:
    data = sea.nemo().expand_dims(deptht=np.array([1.0, 50.0, 90.0]), axis=1)
    data["deptht"].attrs["positive"] = "down"
    for name in ("nav_lon", "nav_lat", "time_counter"):
        data[name] = (
            data[name].isel(deptht=0, drop=True) if "deptht" in data[name].dims else data[name]
        )
    wet = np.ones((1, 3, 14, 17), dtype=np.int8)
    wet[0, 1:, 5, 5] = wet[0, 2, 7, 7] = 0
    data["tmask"] = ("t", "z", "y", "x"), wet
    path = written(data, tmp_path)
    for depth, dry in ((0.0, "0 of"), (50.0, "1 of"), (60.0, "2 of")):
        assert read_current(path, depth=depth).provenance["land"].startswith(dry)


def test_refuses_an_angle_that_is_not_the_grid_s(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.roms()
    data["angle"] += 0.3
    with pytest.raises(InputError, match=r"angle: is 17.2 degrees off the direction"):
        read_current(written(data, tmp_path))
    data["angle"] = (
        data["angle"].dims,
        np.degrees(data["angle"].values - 0.3),
        {"units": "degrees"},
    )
    assert "by angle" in read_current(written(data, tmp_path)).provenance["rotation"]


def test_refuses_a_grid_whose_rows_run_the_wrong_way(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.nemo().isel(y=slice(None, None, -1))
    with pytest.raises(InputError, match="turn the rows of the file round"):
        read_current(written(data, tmp_path))


@pytest.mark.parametrize("kept", [0.3, 0.6, 0.9, 0.99])
def test_a_file_cut_short_is_an_error(kept: float, sea: SimpleNamespace, tmp_path: Path) -> None:
    path = written(sea.cmems(LONS, LATS), tmp_path)
    content = path.read_bytes()
    path.write_bytes(content[: int(kept * len(content))])
    with pytest.raises(InputError, match=r"model\.nc"):
        read_current(path)
    path = written(sea.cmems(LONS, LATS), tmp_path, "scipy")
    content = path.read_bytes()
    path.write_bytes(content[: int(kept * len(content))])
    with pytest.raises(InputError, match=r"model\.nc"):
        read_current(path)


def test_is_explicit_about_variables(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.cmems(LONS, LATS).rename(uo="eta", vo="theta")
    for name in ("eta", "theta"):
        del data[name].attrs["standard_name"]
    path = written(data, tmp_path)
    assert read_current(path, u="eta", v="theta").provenance["variables"] == "eta, theta"
    with pytest.raises(InputError, match="needs both components"):
        read_current(path, u="eta")
    with pytest.raises(InputError, match="zeta: is not in the file, which holds"):
        read_current(path, u="zeta", v="theta")


@pytest.mark.parametrize("origin", [(4.8, 95.0), (np.nan, 60.0), (5.0, -40.0)])
def test_refuses_an_origin_away_from_the_data(
    origin: tuple[float, float], sea: SimpleNamespace, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="origin"):
        read_current(written(sea.cmems(LONS, LATS), tmp_path), origin=origin)


def test_refuses_numbers_that_no_sea_has(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.hycom(LONS, LATS)
    del data["water_u"].attrs["scale_factor"]
    with pytest.raises(InputError, match=r"water_u: holds speeds .* scale factor"):
        read_current(written(data, tmp_path))
    data = sea.cmems(LONS, LATS)
    data["uo"].attrs["units"] = "knots"
    with pytest.raises(InputError, match=r"uo: 'knots': is no unit of speed"):
        read_current(written(data, tmp_path))
    data["uo"].attrs["units"] = data["vo"].attrs["units"] = "cm/s"
    u, _ = read_current(written(data, tmp_path))(0.0, 0.0)
    assert u == pytest.approx(0.003, abs=1e-5)


def test_clips_a_region_to_the_data(sea: SimpleNamespace, tmp_path: Path) -> None:
    current = read_current(written(sea.cmems(LONS, LATS), tmp_path))
    (west, east), (south, _) = current.coverage.x, current.coverage.y
    assert current.clip(Region(-1e6, -1e6, 1e6, 50.0)) == (west, south, east, 50.0)
    with pytest.raises(InputError, match=r"uo, vo: x = 20000 .. 30000 m and y = -50 .. 50 m asked"):
        current.clip(Region(2e4, -50.0, 3e4, 50.0))


def test_a_damaged_chunk_is_an_error(sea: SimpleNamespace, tmp_path: Path) -> None:
    path = tmp_path / "model.nc"
    sea.cmems(LONS, LATS).to_netcdf(path, engine="h5netcdf", encoding={"uo": {"zlib": True}})
    with h5py.File(path) as raw:
        chunk = raw["uo"].id.get_chunk_info(0)
    content = bytearray(path.read_bytes())
    content[chunk.byte_offset : chunk.byte_offset + chunk.size] = bytes(chunk.size)
    path.write_bytes(content)
    with pytest.raises(InputError, match="uo: is damaged"):
        read_current(path)


def test_needs_a_grid(sea: SimpleNamespace, tmp_path: Path) -> None:
    data = sea.cmems(LONS, LATS)
    with pytest.raises(InputError, match="uo: has fewer than two rows or columns"):
        read_current(written(data.isel(latitude=[3]), tmp_path))
    track = data.isel(depth=0, latitude=slice(0, 17)).drop_vars(["latitude", "longitude"])
    track["lon"] = ("longitude", LONS, {"units": "degrees_east"})
    track["lat"] = ("longitude", LATS[:17], {"units": "degrees_north"})
    with pytest.raises(InputError, match=r"uo: .* unstructured grid"):
        read_current(written(track, tmp_path))
    with pytest.raises(InputError, match=r"uo: has no longitudes and latitudes, nor projection"):
        read_current(written(track.drop_vars(["lon", "lat"]), tmp_path))
