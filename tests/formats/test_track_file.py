"""Files of tracks: read back by another library, they say what was written."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.formats.track_file import require_tracks, trajectories, write_tracks
from fiveroute.generate import generate
from fiveroute.instance import Currents, Instance, Ocean

PLACE = "+proj=aeqd +lat_0=60.6 +lon_0=4.8 +datum=WGS84 +units=m"
ONE = np.array([[0.0, 0.0, 0.0], [10.0, 8.0, 6.0], [20.5, 16.0, 12.0]])
TWO = np.array([[0.0, 0.0, 0.0], [60.0, 0.0, -50.0]])
RUNS = [(0, (ONE, TWO)), (3, (TWO, np.zeros((0, 3))))]


@pytest.fixture
def here() -> Instance:
    currents = Currents(begin="2016-01-31T12:00")
    return replace(generate(nodes=2, seed=1), crs=PLACE, ocean=Ocean(currents))


def test_it_comes_back_as_it_went(here: Instance, tmp_path: Path) -> None:
    path = tmp_path / "tracks.nc"
    write_tracks(here, RUNS, path)
    with xr.open_dataset(path, engine="h5netcdf") as data:
        assert data.attrs["featureType"] == "trajectory"
        assert data["trajectory"].attrs["cf_role"] == "trajectory_id"
        assert data["row_size"].attrs["sample_dimension"] == "obs"
        assert data["row_size"].to_numpy().tolist() == [3, 2, 2]
        assert data["run"].to_numpy().tolist() == [0, 0, 3]
        assert data["auv"].to_numpy().tolist() == [0, 1, 0]
        first = slice(0, 3)
        assert data["x"][first].to_numpy() == pytest.approx(ONE[:, 1])
        assert data["y"][first].to_numpy() == pytest.approx(ONE[:, 2])
        seconds = (data["time"] - np.datetime64("2016-01-31T12:00")) / np.timedelta64(1, "ms")
        assert seconds[first].to_numpy() == pytest.approx(1000.0 * ONE[:, 0])
        assert data["lon"][0].item() == pytest.approx(4.8)
        assert data["lat"][4].item() == pytest.approx(60.6 - 50.0 / 111_400.0, abs=1e-6)
    assert [file.name for file in tmp_path.iterdir()] == ["tracks.nc"]


def test_without_a_place_on_earth_there_are_metres_only() -> None:
    data = trajectories(generate(nodes=2, seed=1), RUNS)
    assert "lon" not in data.coords
    assert "not known" in data["time"].attrs["comment"]


def test_a_fleet_that_never_moved_has_an_empty_file(here: Instance, tmp_path: Path) -> None:
    write_tracks(here, [(0, (np.zeros((0, 3)),))], tmp_path / "none.nc")
    with xr.open_dataset(tmp_path / "none.nc", engine="h5netcdf") as data:
        assert data.sizes["obs"] == 0


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"ends in \.nc"):
        require_tracks(tmp_path / "tracks.csv")
