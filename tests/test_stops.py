"""Stops in place: what comes and goes, and what stays where it was."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fiveroute.stops import insert_stop, remove_stops


@given(stops=st.lists(st.integers(0, 99), min_size=1, max_size=8), data=st.data())
def test_an_inserted_stop_can_be_removed(stops: list[int], data: st.DataObject) -> None:
    at, length = data.draw(st.integers(0, len(stops) - 1)), len(stops)
    array = np.array([*stops, -1])
    assert insert_stop(array, length, at, 100) == length + 1
    assert array.tolist() == [*stops[:at], 100, *stops[at:]]
    assert remove_stops(array, length + 1, at, 1) == length
    assert array[:length].tolist() == stops


@given(stops=st.lists(st.integers(0, 99), min_size=2, max_size=8), data=st.data())
def test_a_string_of_stops_is_removed(stops: list[int], data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(stops) - 1))
    count = data.draw(st.integers(0, len(stops) - at))
    array = np.array(stops)
    left = remove_stops(array, len(stops), at, count)
    assert array[:left].tolist() == stops[:at] + stops[at + count :]
