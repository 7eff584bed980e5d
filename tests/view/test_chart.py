from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fiveroute.formats.plan_file import PlanFile
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.currents import DoubleGyre, Superposition, UniformCurrent
from fiveroute.ocean.stated import stated_current
from fiveroute.view.chart import chart_of, region_of

REGION = Region(0.0, 0.0, 2000.0, 1000.0)


def test_chart_has_the_current_at_its_points(plan: PlanFile) -> None:
    current = stated_current(plan.instance)
    chart = chart_of(current, REGION, 1000.0)
    _, rows, columns, _ = chart.uv.shape
    x, y = chart.west + 7 * chart.step, chart.south + 9 * chart.step
    assert chart.uv[0, 9, 7] == pytest.approx(np.array(current(x, y, 0.0)).ravel())
    assert chart.west == pytest.approx(-500.0)
    assert chart.south == pytest.approx(-1000.0)
    assert rows == columns
    assert chart.mask is None


def test_current_that_varies_is_shown_over_the_mission() -> None:
    gyre = DoubleGyre(0.3, 1000.0, 0.25, 2e-3)
    chart = chart_of(Superposition((gyre,)), REGION, 3600.0)
    assert chart.times[[0, -1]].tolist() == [0.0, 3600.0]
    assert np.ptp(chart.uv, axis=0).max() > 0.01
    steady = chart_of(Superposition((UniformCurrent(0.3, 0.4),)), REGION, 3600.0)
    assert steady.times.tolist() == [0.0]
    assert steady.fastest == pytest.approx(0.5)


def test_region_holds_stops_obstacles_and_tracks(plan: PlanFile) -> None:
    track = np.array([(-3000.0, 0.0), (0.0, 5000.0)])
    region = region_of(plan.instance, [track])
    assert region.west < -3000.0
    assert region.north > 5000.0
    assert region.east > 4000.0
    here = replace(plan.instance, nodes=(), destination=plan.instance.start)
    lonely = region_of(replace(here, ocean=type(here.ocean)()), [])
    assert lonely.east > lonely.west


def test_mask_of_a_file_tells_land_from_missing_data(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    from fiveroute.ocean.model_current import read_current
    from fiveroute.view.chart import LAND, NO_DATA, WATER, seen_current

    lon, lat = np.linspace(4.7, 4.9, 21), np.linspace(60.5, 60.7, 31)
    u = np.full((31, 21), 0.2, dtype=np.float32)
    u[:, :5] = np.nan
    names = {"u": "eastward_sea_water_velocity", "v": "northward_sea_water_velocity"}
    data = {
        key: (("lat", "lon"), u, {"standard_name": name, "units": "m s-1"})
        for key, name in names.items()
    }
    coordinates = {
        "lat": ("lat", lat, {"standard_name": "latitude", "units": "degrees_north"}),
        "lon": ("lon", lon, {"standard_name": "longitude", "units": "degrees_east"}),
    }
    file = tmp_path / "sea.nc"
    xarray.Dataset(data, coordinates).to_netcdf(file, engine="h5netcdf")
    model = read_current(file, origin=(4.8, 60.6))
    chart = chart_of(
        seen_current(Superposition((model,))), Region(-5000.0, -5000.0, 5000.0, 5000.0), 0.0
    )
    mask = chart.mask
    assert mask is not None

    def code(x: float, y: float) -> int:
        row, column = round((y - mask.south) / mask.step), round((x - mask.west) / mask.step)
        return int(mask.codes[row, column])

    assert code(0.0, 0.0) == WATER
    assert code(-4500.0, 0.0) == LAND
    assert code(7000.0, 0.0) == NO_DATA
    assert np.isfinite(chart.uv).all()
