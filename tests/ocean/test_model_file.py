from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.ocean.model_file import decoded, decoded_times, open_model_file


def test_unpacks_numbers_and_drops_fills() -> None:
    packed = np.array([0, 100, -32767, -5], dtype=np.int16)
    attributes = {"_FillValue": np.int16(-32767), "scale_factor": 0.01, "add_offset": 5.0}
    values = decoded(xr.DataArray(packed, attrs=attributes))
    np.testing.assert_allclose(values, [5.0, 6.0, np.nan, 4.95])


@pytest.mark.parametrize("fill", [1e37, 1.2676506e30, 9.96921e36, -9.99e33, np.inf, np.nan])
def test_knows_fills_that_are_not_declared(fill: float) -> None:
    values = decoded(xr.DataArray(np.array([0.1, fill, -0.2], dtype=np.float32)))
    np.testing.assert_array_equal(np.isnan(values), [False, True, False])


def test_compares_fills_in_the_precision_they_are_stored_in() -> None:
    stored = np.array([-999.9, 0.25], dtype=np.float32)
    values = decoded(xr.DataArray(stored, attrs={"missing_value": -999.9}))
    np.testing.assert_array_equal(values, [np.nan, 0.25])


def test_takes_several_missing_values_and_ignores_texts() -> None:
    attributes = {"_FillValue": -1.0, "missing_value": np.array([-2.0, -3.0]), "scale_factor": "x"}
    values = decoded(xr.DataArray([-1.0, -2.0, -3.0, -4.0], attrs=attributes))
    np.testing.assert_array_equal(values, [np.nan, np.nan, np.nan, -4.0])


@pytest.mark.parametrize(
    ("units", "number", "expected"),
    [
        ("seconds since 1970-01-01 00:00:00", 1447632000.0, "2015-11-16"),
        ("hours since 1950-01-01", 577536, "2015-11-20"),
        ("days since 1900-12-31 00:00:00", 41958.5, "2015-11-16T12:00"),
        ("hours since 2000-01-01 00:00:00 +0200", 26, "2000-01-02"),
    ],
)
def test_reads_times(units: str, number: float, expected: str) -> None:
    variable = xr.DataArray([number], dims="t", attrs={"units": units}, name="t")
    assert decoded_times(variable)[0] == np.datetime64(expected)


@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ({"units": "seconds since yesterday"}, r"t.units: 'seconds since yesterday': .*CF writes"),
        ({"units": "days since 2000-01-01", "calendar": "360_day"}, r"t.calendar: '360_day'"),
        ({"units": "fortnights"}, "holds what is not a time"),
    ],
)
def test_refuses_what_is_no_time(attributes: dict[str, str], message: str) -> None:
    with pytest.raises(InputError, match=message):
        decoded_times(xr.DataArray([1.0], dims="t", attrs=attributes, name="t"))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"time,u,v\n0,1,2\n", "is not a netCDF file"),
        (b"", "is not a netCDF file"),
        (b"CDF\x05" + bytes(40), "nccopy -k nc4"),
        (b"CDF\x01" + bytes(7), "cannot be read as netCDF"),
        (b"\x89HDF\r\n\x1a\n" + bytes(40), "cannot be read as netCDF"),
    ],
)
def test_refuses_what_is_no_netcdf(content: bytes, message: str, tmp_path: Path) -> None:
    path = tmp_path / "model.nc"
    path.write_bytes(content)
    with pytest.raises(InputError, match=message), open_model_file(path):
        pass


def test_refuses_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be opened"), open_model_file(tmp_path / "none.nc"):
        pass
    with pytest.raises(InputError, match="cannot be opened"), open_model_file(tmp_path):
        pass


def test_letters_are_no_times() -> None:
    """Letters that are scaled become one number, however many there are."""
    packed = {"units": "hours since 2020-03-01", "scale_factor": 1.0, "add_offset": 0.0}
    letters = np.array([b"7"], dtype="S1")
    with pytest.raises(InputError, match="t: holds what is not a time"):
        decoded_times(xr.DataArray(letters, dims="t", attrs=packed, name="t"))
