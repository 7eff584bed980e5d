"""Rebirth makes any sequence of nodes feasible and full."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.rebirth import cheapest_places, rebirth
from fiveroute.heuristics.route_kernels import Case, cheapest_place, collected, duration, in_time
from fiveroute.randomness import random_state

NO_SAMPLES = np.empty((1, 1, 0))


def line_case(places: list[float], data: list[float], allowed: float) -> Case:
    """Nodes on a line, start and destination both at 0."""
    at = np.array([0.0, *places, 0.0])
    return Case(np.abs(at[:, None] - at), np.array([0.0, *data, 0.0]), allowed, NO_SAMPLES, 0)


def reborn(case: Case, route: list[int], noise: float = 0.0, seed: int = 0) -> list[int]:
    stops = np.full(len(case.profit), len(case.profit) - 1)
    stops[: len(route) + 1] = [0, *route]
    state = random_state(np.random.default_rng(seed))
    length = rebirth(case, stops, len(route) + 2, noise, state)
    assert stops[length - 1] == len(case.profit) - 1
    return [int(node) for node in stops[1 : length - 1]]


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Asymmetric legs, the triangle inequality broken; planned, or with nine samples."""
    n = draw(st.integers(1, 8))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    legs = rng.random((n + 2, n + 2)) * 100.0
    if draw(st.booleans()):
        legs = np.floor(legs / 30.0)
    legs[0, -1] = 0.0
    profit = np.array([0.0, *np.floor(rng.random(n) * 4.0), 0.0])
    allowed = draw(st.floats(0.0, 300.0))
    if draw(st.booleans()):
        return Case(legs, profit, allowed, NO_SAMPLES, 0)
    samples = legs[..., None] * rng.uniform(0.5, 1.5, (*legs.shape, 9))
    return Case(samples.mean(axis=2), profit, allowed, samples, draw(st.integers(5, 9)))


def test_what_is_too_far_is_shed_and_what_is_near_is_added() -> None:
    case = line_case([10.0, -40.0, -5.0], [1.0, 1.0, 1.0], 60.0)
    assert sorted(reborn(case, [1, 2])) == [1, 3]


def test_richer_nodes_take_the_place_of_poorer_ones() -> None:
    """There is time for one of the two; the poor one is there first."""
    case = line_case([10.0, -10.0], [1.0, 2.0], 30.0)
    assert reborn(case, [1]) == [2]


def test_a_crossed_route_is_untied_to_make_room() -> None:
    case = line_case([10.0, 20.0, 30.0, 40.0], [1.0] * 4, 80.0)
    assert sorted(reborn(case, [2, 1, 3])) == [1, 2, 3, 4]


@settings(deadline=None, max_examples=100)
@given(cases(), st.integers(0, 2**32 - 1))
def test_a_feasible_route_stays_feasible_and_loses_nothing(case: Case, seed: int) -> None:
    rng = np.random.default_rng(seed)
    route = [int(node) for node in rng.permutation(len(case.profit) - 2) + 1]
    first = reborn(case, route, 0.5, seed)
    assert len(set(first)) == len(first)
    stops = np.array([0, *first, len(case.profit) - 1])
    if not in_time(case, stops, len(stops)):  # nothing saves time: only where samples differ
        return
    again = np.array([0, *reborn(case, first, 0.0, seed), len(case.profit) - 1])
    assert in_time(case, again, len(again))
    if case.needed == 0:
        before = collected(case.profit, stops, len(stops))
        assert collected(case.profit, again, len(again)) >= before - 1e-9


@settings(deadline=None, max_examples=60)
@given(cases(), st.integers(0, 2**32 - 1))
def test_the_table_of_places_is_that_of_single_places(case: Case, seed: int) -> None:
    rng = np.random.default_rng(seed)
    size = len(case.profit)
    inside = np.flatnonzero(rng.random(size - 2) < 0.5) + 1
    stops = np.array([0, *inside, size - 1])
    extra, place = np.empty(size), np.empty(size, np.int64)
    cheapest_places(case.legs, stops, len(stops), extra, place)
    for node in range(size):
        if node in stops:
            assert (extra[node], place[node]) == (np.inf, 0)
        else:
            assert (extra[node], place[node]) == cheapest_place(case.legs, stops, len(stops), node)


def test_detours_that_save_time_are_taken() -> None:
    """The way over the node takes 2 s, the direct leg 9 s, and 5 s are allowed."""
    legs = np.array([[0.0, 1.0, 9.0], [9.0, 0.0, 1.0], [9.0, 9.0, 0.0]])
    case = Case(legs, np.zeros(3), 5.0, NO_SAMPLES, 0)
    assert reborn(case, [1]) == [1]
    assert duration(legs, np.array([0, 1, 2]), 3) == 2.0
