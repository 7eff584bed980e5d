"""The current that a mission states: a file is read once, until it is another one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.instance import Currents, Fleet, Instance, Ocean, Point, Uniform
from fiveroute.ocean.currents import Current
from fiveroute.ocean.stated import stated_current


@pytest.fixture
def mission(sea: SimpleNamespace, tmp_path: Path) -> Instance:
    write(sea, tmp_path, 1.0)
    return Instance(
        "bay",
        (),
        Point(0.0, 0.0),
        Point(2000.0, 0.0),
        Fleet(1, 1.0, 9000.0),
        ocean=Ocean(Currents(file="sea.nc")),
        crs=f"+proj=aeqd +lat_0={sea.lat} +lon_0={sea.lon}",
    )


def write(sea: SimpleNamespace, folder: Path, factor: float) -> None:
    lon, lat = sea.lon + np.linspace(-0.1, 0.1, 9), sea.lat + np.linspace(-0.1, 0.1, 9)
    data = sea.cmems(lon, lat)
    for name in ("uo", "vo"):
        data[name].values *= np.float32(factor)
    data.to_netcdf(folder / "sea.nc", engine="h5netcdf")


def filed(mission: Instance, folder: Path, **currents: Any) -> Current:
    ocean = replace(mission.ocean, currents=replace(mission.ocean.currents, **currents))
    return stated_current(replace(mission, ocean=ocean), folder).parts[-1]


def test_a_file_is_read_once(mission: Instance, tmp_path: Path) -> None:
    first = filed(mission, tmp_path)
    assert filed(mission, tmp_path) is first
    assert filed(mission, tmp_path, uniform=Uniform(0.1, 0.0)) is first


def test_another_depth_is_another_current(mission: Instance, tmp_path: Path) -> None:
    speeds = [filed(mission, tmp_path, depth=depth)(0.0, 0.0, 0.0) for depth in (0.5, 10.5)]
    assert np.array(speeds[0]) == pytest.approx(2.0 * np.array(speeds[1]))


def test_another_file_of_the_name_is_read(
    sea: SimpleNamespace, mission: Instance, tmp_path: Path
) -> None:
    before = filed(mission, tmp_path)(0.0, 0.0, 0.0)
    write(sea, tmp_path, 0.5)
    assert np.array(filed(mission, tmp_path)(0.0, 0.0, 0.0)) == pytest.approx(
        0.5 * np.array(before), rel=1e-6
    )


def test_a_file_that_is_gone_is_missed(mission: Instance, tmp_path: Path) -> None:
    filed(mission, tmp_path)
    (tmp_path / "sea.nc").unlink()
    with pytest.raises(InputError, match=r"sea\.nc"):
        filed(mission, tmp_path)
