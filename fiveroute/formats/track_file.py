"""Tracks of simulated AUVs as a file that other tools read: CF trajectories in netCDF.

The discrete sampling geometry of the CF conventions 1.11, chapter 9, as a contiguous ragged array:
all positions one after the other, and how many of them each trajectory has. A trajectory is one
AUV in one run.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.formats.files import require_writable
from fiveroute.instance import Instance
from fiveroute.whole_files import written_whole

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["require_tracks", "trajectories", "write_tracks"]

Floats = NDArray[np.float64]

_EPOCH = "2000-01-01T00:00:00"
"""When a mission begins that does not say when."""


def require_tracks(path: Path | None, force: bool = False) -> None:
    """Refuse a file of tracks that could not be written, before any time is spent."""
    if path is None:
        return
    if path.suffix != ".nc":
        raise InputError("a file of tracks ends in .nc", field="tracks", value=str(path))
    require_writable(path, force)


def trajectories(instance: Instance, runs: Sequence[tuple[int, Sequence[Floats]]]) -> xr.Dataset:
    """Tracks as a CF data set.

    Parameters
    ----------
    instance
        The mission; it says when it begins, and where on Earth its metres lie.
    runs
        Number of each run, and by AUV its seconds, x and y in metres, shape (any, 3).
    """
    import xarray as xr

    named = [
        (run, auv, track) for run, tracks in runs for auv, track in enumerate(tracks) if len(track)
    ]
    positions = np.concatenate([np.zeros((0, 3)), *(track for _, _, track in named)])
    begin = instance.ocean.currents.begin
    time = {
        "standard_name": "time",
        "units": f"seconds since {begin or _EPOCH}",
        "calendar": "standard",
        "axis": "T",
    }
    if begin is None:
        time["comment"] = "seconds since the mission began; its date is not known"
    data = xr.Dataset(
        {
            "trajectory": (
                "trajectory",
                [f"run {run}, AUV {auv}" for run, auv, _ in named],
                {"cf_role": "trajectory_id"},
            ),
            "run": ("trajectory", [run for run, _, _ in named], {"long_name": "number of the run"}),
            "auv": ("trajectory", [auv for _, auv, _ in named], {"long_name": "number of the AUV"}),
            "row_size": (
                "trajectory",
                [len(track) for _, _, track in named],
                {"long_name": "number of positions", "sample_dimension": "obs"},
            ),
        },
        coords={"time": ("obs", positions[:, 0], time), **_places(instance, positions[:, 1:])},
        attrs={
            "Conventions": "CF-1.11",
            "featureType": "trajectory",
            "title": f"simulated AUV tracks of {instance.name}",
        },
    )
    return data


def write_tracks(
    instance: Instance,
    runs: Sequence[tuple[int, Sequence[Floats]]],
    path: Path,
    force: bool = False,
) -> None:
    """Write tracks, whole or not at all; see `trajectories`."""
    require_tracks(path, force)
    data = trajectories(instance, runs)
    try:
        with written_whole(path) as draft:
            draft.write_bytes(_netcdf(data))
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", file=path) from None


def _netcdf(data: xr.Dataset) -> bytes:
    """A file in memory: on a disk that is full the HDF5 library ends the process."""
    import h5netcdf  # type: ignore[import-untyped]
    from xarray.backends import H5NetCDFStore

    content = io.BytesIO()
    with h5netcdf.File(content, "w") as file:
        data.dump_to_store(H5NetCDFStore(file))
    return content.getvalue()


def _places(instance: Instance, positions: Floats) -> dict[str, Any]:
    """Positions on the map, and where its origin is known on Earth as well."""
    x, y = positions.T
    places: dict[str, Any] = {
        name: ("obs", values, {"units": "m", "axis": axis, "long_name": f"metres to the {side}"})
        for name, values, axis, side in (("x", x, "X", "east"), ("y", y, "Y", "north"))
    }
    if instance.origin is None:
        return places
    from fiveroute.ocean.local_plane import LocalPlane

    for name, degrees, unit in zip(
        ("longitude", "latitude"),
        LocalPlane(*instance.origin).unproject(x, y),
        ("degrees_east", "degrees_north"),
        strict=True,
    ):
        places[name[:3]] = "obs", degrees, {"standard_name": name, "units": unit}
    return places
