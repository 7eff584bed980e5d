"""Edges are counted in both directions alike, and the entropy is that of the formula."""

import numpy as np
import pytest

from fiveroute.heuristics.tour.diversity import (
    add_edge,
    count_edges,
    multiplicity,
    remove_edge,
)


def test_two_tours_of_four_vertices() -> None:
    """0 1 2 3 and 0 2 1 3 share the edges (1, 2) and (3, 0)."""
    edges = count_edges(np.array([[0, 1, 2, 3], [0, 2, 1, 3]]))
    assert multiplicity(edges, 2, 1) == multiplicity(edges, 0, 3) == 2
    assert multiplicity(edges, 0, 1) == multiplicity(edges, 3, 1) == 1
    assert edges.entropy.tolist() == pytest.approx([0.0, 0.5 * np.log(2.0), 0.0])


def test_an_edge_in_no_tour_leaves_its_place() -> None:
    edges = count_edges(np.array([[0, 1, 2, 3], [0, 2, 1, 3]]))
    remove_edge(edges, 1, 0)
    assert multiplicity(edges, 0, 1) == 0
    assert edges.used[0] == 2
    add_edge(edges, 1, 0)
    assert multiplicity(edges, 0, 1) == 1
