"""Connectivity cuts against networks whose cuts are known, and against an independent flow."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_flow

from fiveroute.models.max_flow_cuts import violated_sets


def _arcs(entries: dict[tuple[int, int], float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    tails, heads = np.array(list(entries)).T
    return tails, heads, np.array(list(entries.values()))


def test_a_path_that_carries_the_demand_violates_nothing() -> None:
    found = violated_sets(*_arcs({(0, 1): 1.0, (1, 2): 1.0}), np.array([0.0, 1.0, 1.0]))
    assert found.shape == (0, 3)


def test_a_cycle_apart_from_the_start_is_found() -> None:
    arcs = _arcs({(0, 1): 1.0, (2, 3): 1.0, (3, 2): 1.0})
    found = violated_sets(*arcs, np.array([0.0, 1.0, 1.0, 1.0]))
    assert found.tolist() == [[False, False, True, True]]


def test_both_minimum_cuts_of_a_chain_come_back() -> None:
    """The bottleneck 0.5 lies on two arcs in a row: before vertex 1 and before vertex 2."""
    arcs = _arcs({(0, 1): 0.5, (1, 2): 0.5})
    found = violated_sets(*arcs, np.array([0.0, 0.5, 1.0]))
    assert sorted(found.tolist()) == [[False, False, True], [False, True, True]]


def test_violations_within_the_tolerance_are_left_alone() -> None:
    arcs = _arcs({(0, 1): 0.95})
    assert len(violated_sets(*arcs, np.array([0.0, 1.0]), tolerance=0.1)) == 0
    assert len(violated_sets(*arcs, np.array([0.0, 1.0]), tolerance=0.01)) == 1


def test_no_arcs_at_all() -> None:
    none = np.zeros(0, dtype=np.int64)
    found = violated_sets(none, none, np.zeros(0), np.array([0.0, 0.0, 1.0]))
    assert sorted(found.tolist()) == [[False, False, True], [False, True, True]]


def test_arcs_to_vertices_without_demand_are_refused() -> None:
    with pytest.raises(ValueError, match="every vertex"):
        violated_sets(*_arcs({(0, 3): 1.0}), np.zeros(3))


@settings(deadline=None, max_examples=60)
@given(st.integers(2, 9), st.integers(0, 2**32 - 1))
def test_a_set_is_found_exactly_where_an_independent_flow_falls_short(size: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    capacity = rng.integers(0, 9, (size, size)) * (rng.random((size, size)) < 0.5)
    np.fill_diagonal(capacity, 0)
    demand = rng.integers(0, 12, size).astype(np.float64)
    demand[0] = 0.0
    tails, heads = np.nonzero(capacity)
    sets = violated_sets(tails, heads, capacity[tails, heads].astype(np.float64), demand)
    flows = [
        maximum_flow(csr_array(capacity.astype(np.int32)), 0, k).flow_value if k else 0
        for k in range(size)
    ]
    assert bool(len(sets)) == any(demand > np.array(flows) + 0.5)
    for members in sets:
        assert not members[0]
        entering = capacity[np.ix_(~members, members)].sum()
        assert entering < demand[members].max()


@pytest.mark.parametrize("most", [0, 2, 4])
def test_the_search_stops_at_the_number_asked_for(most: int) -> None:
    none = np.zeros(0, dtype=np.int64)
    found = violated_sets(none, none, np.zeros(0), np.ones(6) - np.eye(6)[0], most=most)
    assert len(found) <= most
