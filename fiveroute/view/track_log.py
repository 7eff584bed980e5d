"""Tracks of simulated runs, as ``fiveroute simulate --tracks`` writes them: CF trajectories.

A log tells stops and times; with the tracks of the same runs it is known where every AUV was in
between, and where it failed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.model_file import decoded, open_model_file
from fiveroute.view.event_log import RunLog

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["with_tracks"]

Floats = NDArray[np.float64]

_WHOLE = 2.0**53


def with_tracks(runs: Sequence[RunLog], path: Path, fleet_size: int) -> tuple[RunLog, ...]:
    """The same runs with the tracks that were sailed in them.

    Parameters
    ----------
    runs
        The runs of a log.
    path
        File of tracks; it may have those of more runs.
    fleet_size
        Number of AUVs.

    Raises
    ------
    InputError
        If the file is wrong, or has no track of one of the runs.
    """
    try:
        with open_model_file(path) as data:
            tracks = _tracks(data, fleet_size)
        lost = next((run.run for run in runs if run.run not in tracks), None)
        if lost is not None:
            raise InputError(
                "has no track of this run; take log and tracks of one simulation",
                field="run",
                value=lost,
            )
    except InputError as error:
        raise error.at(path) from error.__cause__
    return tuple(replace(run, tracks=tracks[run.run]) for run in runs)


def _tracks(data: xr.Dataset, fleet_size: int) -> dict[int, tuple[Floats, ...]]:
    """By run and AUV: x, y and t, shape (any, 3)."""
    run, auv, size = (_counts(data, name) for name in ("run", "auv", "row_size"))
    positions = np.column_stack([_numbers(data, name) for name in ("x", "y", "time")])
    if not len(run) == len(auv) == len(size) or sum(size) != len(positions):
        raise InputError(
            "must tell for every trajectory how many positions it has", field="row_size"
        )
    found: dict[int, list[Floats]] = {}
    end = 0
    for number, who, count in zip(run, auv, size, strict=True):
        if who >= fleet_size:
            raise InputError(
                f"the plan has {fleet_size} AUVs, counted from 0; use the plan that was sailed",
                field="auv",
                value=who,
            )
        track, end = positions[end : end + count], end + count
        if (np.diff(track[:, 2], prepend=0.0) < 0.0).any():
            raise InputError("must not go back along a track", field="time")
        found.setdefault(number, [np.zeros((0, 3))] * fleet_size)[who] = track
    return {number: tuple(fleet) for number, fleet in found.items()}


def _counts(data: xr.Dataset, name: str) -> list[int]:
    """Numbers of runs, of AUVs, or of positions."""
    values = _numbers(data, name)
    if not ((values >= 0.0) & (values < _WHOLE) & (values % 1.0 == 0.0)).all():
        raise InputError("must be whole numbers of at least 0", field=name)
    return [int(value) for value in values]


def _numbers(data: xr.Dataset, name: str) -> Floats:
    if name not in data.variables or data[name].ndim != 1:
        raise InputError("is missing; write the file with `simulate --tracks`", field=name)
    values = decoded(data[name])
    if not np.isfinite(values).all():
        raise InputError("has missing values; write the file anew", field=name)
    return values
