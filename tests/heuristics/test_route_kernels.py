"""Kernels on single routes against plain Python."""

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.route_kernels import (
    Case,
    cheapest_place,
    collected,
    duration,
    in_time,
    shorten,
)
from fiveroute.stops import insert_stop, remove_stops

NO_SAMPLES = np.empty((1, 1, 0))


@st.composite
def legs(draw: st.DrawFn) -> np.ndarray:
    """Asymmetric legs without the triangle inequality, some of them full of ties and zeros."""
    n = draw(st.integers(0, 6))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    times = rng.random((n + 2, n + 2)) * 100.0
    return np.floor(times / 30.0) if draw(st.booleans()) else times


def through_all(times: np.ndarray) -> np.ndarray:
    return np.arange(len(times))


@settings(deadline=None, max_examples=80)
@given(legs())
def test_shortening_keeps_the_nodes_and_leaves_no_better_neighbour(times: np.ndarray) -> None:
    stops = through_all(times)
    before = duration(times, stops, len(stops))
    shorten(times, stops, len(stops))
    after = duration(times, stops, len(stops))
    assert sorted(stops) == list(range(len(times)))
    assert (stops[0], stops[-1]) == (0, len(times) - 1)
    assert after <= before
    route = stops.tolist()
    for i, j in itertools.combinations(range(1, len(route) - 1), 2):
        turned = [*route[:i], *reversed(route[i : j + 1]), *route[j + 1 :]]
        assert duration(times, np.array(turned), len(route)) >= after - 1e-6
    for i, size in itertools.product(range(1, len(route) - 1), (1, 2, 3)):
        if i + size < len(route):
            chain, rest = route[i : i + size], route[:i] + route[i + size :]
            for at in range(1, len(rest)):
                moved = np.array(rest[:at] + chain + rest[at:])
                assert duration(times, moved, len(route)) >= after - 1e-6


def test_shortening_unties_a_crossing() -> None:
    """Four corners of a square in the wrong order, on the way past it."""
    at = np.array([[0, 0], [1, 1], [2, 0], [1, 0], [2, 1], [3, 0]], dtype=float)
    times = np.hypot(*(at[:, None] - at).transpose(2, 0, 1))
    stops = through_all(times)
    shorten(times, stops, len(stops))
    assert stops.tolist() == [0, 3, 1, 4, 2, 5]


def test_duration_and_data_by_hand() -> None:
    times = np.arange(16.0).reshape(4, 4)
    stops = np.array([0, 2, 1, 3])
    assert duration(times, stops, 4) == times[0, 2] + times[2, 1] + times[1, 3]
    assert collected(np.array([0.0, 3.0, 4.0, 0.0]), stops, 4) == 7.0
    assert collected(np.array([0.0, 3.0, 4.0, 0.0]), np.array([0, 3]), 2) == 0.0


def test_insertion_and_removal_undo_each_other() -> None:
    stops = np.array([0, 2, 3, 0])
    assert insert_stop(stops, 3, 1, 1) == 4
    assert stops.tolist() == [0, 1, 2, 3]
    assert remove_stops(stops, 4, 1, 2) == 2
    assert stops[:2].tolist() == [0, 3]


@settings(deadline=None, max_examples=30)
@given(legs())
def test_the_cheapest_place_is_the_cheapest(times: np.ndarray) -> None:
    if len(times) < 3:
        return
    stops = np.delete(through_all(times), 1)
    extra, place = cheapest_place(times, stops, len(stops), 1)
    every = [duration(times, np.insert(stops, at, 1), len(times)) for at in range(1, len(stops))]
    assert np.isclose(extra, min(every) - duration(times, stops, len(stops)))
    assert np.isclose(every[place - 1], min(every))


def test_samples_decide_where_there_are_any() -> None:
    times = np.zeros((2, 2))
    times[0, 1] = 10.0
    stops = np.array([0, 1])
    assert in_time(Case(times, np.zeros(2), 10.0, NO_SAMPLES, 0), stops, 2)
    assert not in_time(Case(times, np.zeros(2), 9.9, NO_SAMPLES, 0), stops, 2)
    samples = np.zeros((2, 2, 4))
    samples[0, 1] = [1.0, 2.0, 3.0, 4.0]
    for needed, enough in ((3, True), (4, False)):
        assert in_time(Case(times, np.zeros(2), 3.0, samples, needed), stops, 2) is enough
