"""Times of a model's file: seconds from the mission's beginning, whatever way that is written."""

from datetime import UTC, datetime, timedelta, timezone

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.ocean.model_times import seconds_since

TIMES = np.array(["2020-03-01T00", "2020-03-01T01", "2020-03-01T03"], dtype="datetime64[ns]")


def test_the_first_time_is_the_beginning_unless_another_is_named() -> None:
    seconds, note = seconds_since(TIMES, None)
    assert seconds.tolist() == [0.0, 3600.0, 10800.0]
    assert note.endswith("UTC, t = 0 at 2020-03-01T00:00:00")


@pytest.mark.parametrize(
    "begin",
    [
        "2020-03-01T01:30",
        "2020-03-01T02:30+01:00",
        np.datetime64("2020-03-01T01:30"),
        datetime(2020, 3, 1, 1, 30, tzinfo=UTC),
        datetime(2020, 3, 1, 3, 30, tzinfo=timezone(timedelta(hours=2))),
    ],
)
def test_a_time_zone_is_reckoned_with(begin: datetime | np.datetime64 | str) -> None:
    assert seconds_since(TIMES, begin)[0].tolist() == [-5400.0, -1800.0, 5400.0]


@pytest.mark.parametrize("times", [None, TIMES[:1]])
def test_a_single_field_is_steady(times: None) -> None:
    seconds, note = seconds_since(times, None)
    assert seconds.tolist() == [0.0]
    assert note.endswith("taken as steady")


@pytest.mark.parametrize("begin", ["2020-03-01T04:00", "2019-12-31", "tomorrow"])
def test_a_beginning_at_another_time_is_refused(begin: str) -> None:
    with pytest.raises(InputError, match="begin"):
        seconds_since(TIMES, begin)
