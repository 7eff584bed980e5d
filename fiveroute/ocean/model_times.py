"""When the fields of an ocean model's file are, as a mission counts its seconds."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError

__all__ = ["seconds_since"]

Floats = NDArray[np.float64]


def seconds_since(
    times: NDArray[np.datetime64] | None, begin: datetime | np.datetime64 | str | None
) -> tuple[Floats, str]:
    """Seconds of the times of an ocean model's file since the mission begins, and what they are.

    Parameters
    ----------
    times
        In UTC, growing, shape (times,); None for a single field without one.
    begin
        When the mission begins, in UTC unless it says otherwise; None takes the first time.

    Returns
    -------
    seconds : array
        Shape (times,); one 0 for a single field.
    note : str
        What was understood.

    Raises
    ------
    InputError
        If the mission begins at another time than the file has, or at none.
    """
    if times is None:
        return np.zeros(1), "a single field, taken as steady"
    first, last = (np.datetime_as_string(time, unit="s") for time in (times[0], times[-1]))
    if len(times) == 1:
        return np.zeros(1), f"a single field of {first} UTC, taken as steady"
    start = times[0] if begin is None else _utc(begin)
    if not times[0] <= start <= times[-1]:
        raise InputError(
            f"must be within the times of the file, {first} .. {last} UTC",
            field="begin",
            value=str(begin),
        )
    seconds = (times - start) / np.timedelta64(1, "s")
    origin = np.datetime_as_string(start, unit="s")
    note = f"{len(times)} from {first} to {last} UTC, t = 0 at {origin}"
    return np.asarray(seconds, dtype=np.float64), note


def _utc(moment: datetime | np.datetime64 | str) -> np.datetime64:
    """A moment in UTC; one without a time zone is in UTC already."""
    if isinstance(moment, str):
        try:
            moment = datetime.fromisoformat(moment)
        except ValueError as error:
            raise InputError(
                "is no time; write 2016-01-31T12:00", field="begin", value=moment
            ) from error
    if isinstance(moment, datetime):
        if moment.tzinfo is not None:
            moment = moment.astimezone(UTC).replace(tzinfo=None)
        return np.datetime64(moment, "ns")
    return moment
