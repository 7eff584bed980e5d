"""The allocations: every node in one set, clusters where they are plain to see."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.allocation import hierarchical, k_means, sub_routes, voronoi
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

Allocate = Callable[[np.ndarray, int, np.random.Generator], tuple[Route, ...]]

ALLOCATIONS: dict[str, Allocate] = {
    "voronoi": voronoi,
    "voronoi, nodes": lambda p, m, rng: voronoi(p, m, rng, "nodes"),
    "voronoi, ring": lambda p, m, rng: voronoi(p, m, rng, "ring"),
    "voronoi, lloyd": lambda p, m, rng: voronoi(p, m, rng, "lloyd"),
    "k-means": k_means,
    "ahc, average": lambda p, m, rng: hierarchical(p, m),
    "ahc, ward": lambda p, m, rng: hierarchical(p, m, "ward"),
}

HEAPS = np.array([[0, 0], [9, 0], [0, 9]])
"""Three heaps of four nodes, far apart."""


def heaps() -> np.ndarray:
    corners = np.array([[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]])
    nodes = (HEAPS[:, None] + corners).reshape(-1, 2)
    return np.vstack([[5.0, 5.0], nodes, [5.0, 5.0]])


@pytest.mark.parametrize("name", ALLOCATIONS)
@settings(deadline=None, max_examples=25)
@given(
    n=st.integers(0, 12),
    fleet_size=st.integers(1, 5),
    seed=st.integers(0, 2**32 - 1),
    coarse=st.booleans(),
)
def test_every_node_is_in_one_set(
    name: str, n: int, fleet_size: int, seed: int, coarse: bool
) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((n + 2, 2))
    if coarse:  # many nodes at the same place
        points = np.round(points)
    sets = ALLOCATIONS[name](points, fleet_size, rng)
    assert len(sets) == fleet_size
    assert sorted(node for nodes in sets for node in nodes) == list(range(1, n + 1))
    assert all(list(nodes) == sorted(nodes) for nodes in sets)


@pytest.mark.parametrize("name", ["k-means", "ahc, average", "ahc, ward"])
def test_clusters_that_are_plain_to_see_are_found(name: str) -> None:
    sets = ALLOCATIONS[name](heaps(), 3, np.random.default_rng(1))
    assert sorted(sets) == [(1, 2, 3, 4), (5, 6, 7, 8), (9, 10, 11, 12)]


def test_a_cell_holds_the_nodes_nearest_to_its_generator() -> None:
    """Generators are two of the nodes: each keeps itself and all that is nearer to it."""
    points = np.array([[0, 0], [1, 0], [2, 0], [7, 0], [9, 0], [0, 0]], dtype=float)
    seen = {frozenset(voronoi(points, 2, np.random.default_rng(s), "nodes")) for s in range(40)}
    assert seen == {
        frozenset({(1,), (2, 3, 4)}),
        frozenset({(1, 2), (3, 4)}),
        frozenset({(1, 2, 3), (4,)}),
    }


def test_lloyd_ends_where_every_node_is_nearest_to_its_own_centroid() -> None:
    rng = np.random.default_rng(3)
    points = rng.random((42, 2))
    sets = voronoi(points, 4, rng, "lloyd")
    centroids = np.array([points[list(nodes)].mean(axis=0) for nodes in sets])
    for auv, nodes in enumerate(sets):
        for node in nodes:
            assert ((points[node] - centroids) ** 2).sum(axis=1).argmin() == auv


def test_more_runs_of_k_means_are_no_worse() -> None:
    points = np.random.default_rng(4).random((62, 2))

    def scatter(sets: tuple[Route, ...]) -> float:
        parts = [points[list(nodes)] for nodes in sets if nodes]
        return sum(float(((part - part.mean(axis=0)) ** 2).sum()) for part in parts)

    single = [scatter(k_means(points, 4, np.random.default_rng(s), 1)) for s in range(10)]
    assert scatter(k_means(points, 4, np.random.default_rng(0), 10)) <= np.median(single)


def test_sets_become_short_routes() -> None:
    """Nodes on a line are visited on the way, whatever their numbers."""
    at = np.array([0.0, 30.0, 10.0, 20.0, -10.0, 40.0])
    travel = np.abs(at[:, None] - at)
    problem = TeamOrienteering(travel, np.zeros(6), np.zeros(6), [1.0, 1.0, 1.0])
    assert sub_routes(problem, ((1, 2, 3), (4,), ())) == ((2, 3, 1), (4,), ())
