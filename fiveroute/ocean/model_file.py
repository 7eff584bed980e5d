"""Files of ocean models as they lie on the disk: opening them, decoding numbers and times.

Files are opened through xarray, but decoded here, and only the variables that are needed: files
of ocean models carry more than one missing value, fill values that are not declared, and times
of variables nobody asks for that no calendar knows.

A packed number n stands for scale_factor n + add_offset; the fill value is compared before that.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.hdf5_heaps import endless_heap

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["decoded", "decoded_times", "open_model_file"]

Floats = NDArray[np.float64]
Times = NDArray[np.datetime64]

_ENGINES = {b"\x89HDF": "h5netcdf", b"CDF\x01": "scipy", b"CDF\x02": "scipy"}
_MISSING = 1e10  # what is larger is a fill value, declared or not (1e37, 1.2676506e30, ...)
_TOO_MANY = 200_000_000  # numbers, 1.6 GB of them; a few bytes can claim any number of zeros
_ROUNDING = 1e-7  # relative, between a fill value and the same stored in single precision
_CALENDARS = ("standard", "gregorian", "proleptic_gregorian")


@contextmanager
def open_model_file(path: Path | str) -> Iterator[xr.Dataset]:
    """Open a netCDF file, nothing of it decoded; close it at the end.

    Raises
    ------
    InputError
        If it is not there, or not a netCDF file.
    """
    import xarray as xr

    engine = _engine(Path(path))
    try:
        if engine == "h5netcdf":
            _require_hdf5(path)
        data = xr.open_dataset(path, engine=engine, decode_cf=False)
    except Exception as error:  # the libraries trust what they read: a spoilt file ends in anything
        raise _unreadable(error, path) from error
    with data:
        yield data


def _require_hdf5(path: Path | str) -> None:
    """Look at a file as h5netcdf will: its own failure is heard twice, on standard error too."""
    import h5py  # type: ignore[import-untyped]

    if (at := endless_heap(path)) is not None:
        raise OSError(f"the heap at byte {at} is damaged")
    with h5py.File(path, "r") as held:
        held.attrs.get("_nc3_strict")


def _unreadable(error: Exception, path: Path | str) -> InputError:
    told = " ".join(str(error).split())[:200] or type(error).__name__
    return InputError(f"cannot be read as netCDF ({told}); copy the file again", file=path)


def _engine(path: Path) -> str:
    """The engine of xarray that reads a file, by the file's first bytes."""
    try:
        with path.open("rb") as file:
            head = file.read(4)
    except OSError as error:
        raise InputError(f"cannot be opened ({error.strerror})", file=path) from error
    if head == b"CDF\x05":
        raise InputError("is netCDF-3 with 64-bit data; convert it with `nccopy -k nc4`", file=path)
    if head not in _ENGINES:
        raise InputError("is not a netCDF file", file=path)
    return _ENGINES[head]


def decoded(variable: xr.DataArray) -> Floats:
    """Values of a variable in its units, NaN where there is none.

    Raises
    ------
    InputError
        If it does not hold numbers, or they cannot be read.
    """
    if variable.dtype.kind not in "iuf":
        raise InputError("does not hold numbers", field=str(variable.name))
    if variable.size > _TOO_MANY:
        raise InputError(
            f"has more than {_TOO_MANY:.0e} numbers to read; cut a part out of the file",
            field=str(variable.name),
            value=variable.shape,
        )
    try:
        values = np.array(variable.values, dtype=np.float64)
    except (OSError, RuntimeError, ValueError, MemoryError) as error:
        raise InputError(f"is damaged ({error})", field=str(variable.name)) from error
    missing = ~(np.abs(values) < _MISSING)
    for attribute in ("_FillValue", "missing_value"):
        for fill in _numbers(variable.attrs.get(attribute)):
            missing |= np.abs(values - fill) <= _ROUNDING * abs(fill)
    values[missing] = np.nan
    with np.errstate(over="ignore", invalid="ignore"):
        for scale in _numbers(variable.attrs.get("scale_factor")):
            values *= scale
        for offset in _numbers(variable.attrs.get("add_offset")):
            values += offset
    if not (np.isfinite(values) | missing).all():
        raise InputError(
            "is no number with its scale_factor and add_offset", field=str(variable.name)
        )
    return values


def _numbers(attribute: Any) -> list[float]:
    """Numbers of an attribute; none if it is absent or a text."""
    array = np.atleast_1d([] if attribute is None else attribute)
    return [float(number) for number in array] if array.dtype.kind in "iuf" else []


def decoded_times(variable: xr.DataArray) -> Times:
    """Times of a CF time coordinate, in UTC, one at least."""
    import xarray as xr

    if variable.ndim != 1 or variable.size == 0:
        raise InputError(
            "must hold a time for each field, along one dimension",
            field=str(variable.name),
            value=variable.shape,
        )

    calendar = str(variable.attrs.get("calendar", "standard")).lower()
    if calendar not in _CALENDARS:
        raise InputError(
            "is no calendar of real days; only the Gregorian calendar can be read",
            field=f"{variable.name}.calendar",
            value=calendar,
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of fill values, with which what they hit is no time
            held = xr.Dataset({"time": (variable.dims, variable.values, variable.attrs)})
            read = xr.decode_cf(held)["time"].values
    except (ValueError, OverflowError, TypeError, ImportError) as error:  # cftime has no place here
        raise InputError(
            "cannot be read as times; CF writes 'seconds since 1970-01-01 00:00:00'",
            field=f"{variable.name}.units",
            value=variable.attrs.get("units"),
        ) from error
    is_time = read.dtype.kind == "M" and read.shape == variable.shape  # letters become words
    if not is_time or np.isnat(read).any():
        raise InputError("holds what is not a time", field=str(variable.name))
    return np.asarray(read.astype("datetime64[ns]"))
