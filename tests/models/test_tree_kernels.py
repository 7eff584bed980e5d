"""Spanning trees against scipy, on complete and on sparse graphs."""

import numpy as np
import pytest
from scipy.sparse.csgraph import minimum_spanning_tree

from fiveroute.models.tree_kernels import dense_tree, links_within, sparse_tree


def prepared(n: int, symmetric: bool, seed: int) -> tuple[np.ndarray, ...]:
    """Times there and back as the kernels want them, prices, and the cheapest way of each link."""
    rng = np.random.default_rng(seed)
    there = rng.random((n + 2, n + 2)) + 0.1
    if symmetric:
        there = (there + there.T) / 2.0
    there.setflags(write=False)
    back = np.ascontiguousarray(there.T)
    back.setflags(write=False)
    leaving = rng.normal(size=n + 2) * 0.1
    entering = leaving.copy() if symmetric else rng.normal(size=n + 2) * 0.1
    arcs = there + leaving[:, None] + entering
    return there, back, leaving, entering, np.minimum(arcs, arcs.T)


def blank(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return np.zeros(n, np.int64), np.zeros(n + 2, np.int64), np.ones(n + 2, np.bool_)


def scipy_length(cost: np.ndarray, graph: np.ndarray) -> float:
    """Zero means no link to scipy, so everything is lifted by 10."""
    inner = np.where(graph, cost + 10.0, 0.0)[1:-1, 1:-1]
    return float(minimum_spanning_tree(inner).sum() - 10.0 * (len(inner) - 1))


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("n", [1, 2, 30])
def test_complete_graph(n: int, symmetric: bool) -> None:
    there, back, leaving, entering, cost = prepared(n, symmetric, seed=n)
    order, parent, forward = blank(n)
    length = dense_tree(there, back, symmetric, leaving, entering, order, parent, forward)
    assert length == pytest.approx(scipy_length(cost, np.ones_like(cost, dtype=bool)))
    assert sorted(order) == list(range(1, n + 1))
    arcs = there + leaving[:, None] + entering
    node = order[1:]
    paid = np.where(forward[node], arcs[parent[node], node], arcs[node, parent[node]])
    assert paid.sum() == pytest.approx(length)


@pytest.mark.parametrize("symmetric", [True, False])
def test_sparse_graph(symmetric: bool) -> None:
    n = 40
    there, _, leaving, entering, cost = prepared(n, symmetric, seed=7)
    graph = np.random.default_rng(8).random((n + 2, n + 2)) < 0.1
    graph[np.arange(1, n), np.arange(2, n + 1)] = True  # connected
    graph[[0, -1]] = graph[:, [0, -1]] = False
    graph |= graph.T
    np.fill_diagonal(graph, False)
    tails, heads = np.nonzero(graph)
    first = np.searchsorted(tails, np.arange(n + 2))
    order, parent, forward = blank(n)
    length = sparse_tree(
        first, heads, there[tails, heads], there[heads, tails], leaving, entering,
        order, parent, forward,
    )  # fmt: skip
    assert length == pytest.approx(scipy_length(cost, graph))
    assert graph[order[1:], parent[order[1:]]].all()


@pytest.mark.parametrize("symmetric", [True, False])
def test_links_within_slack(symmetric: bool) -> None:
    """A link belongs to it if the tree through it is longer by the slack at most."""
    n, slack = 9, 0.3
    there, back, leaving, entering, cost = prepared(n, symmetric, seed=3)
    order, parent, forward = blank(n)
    length = dense_tree(there, back, symmetric, leaving, entering, order, parent, forward)
    found = links_within(there, symmetric, leaving, entering, order, parent, slack, 100)
    arcs = there + leaving[:, None] + entering
    expected = set()
    for i in range(1, n + 1):
        for j in range(i + 1 if symmetric else 1, n + 1):
            if i != j:
                forced = cost.copy()
                forced[i, j] = forced[j, i] = -5.0
                through = scipy_length(forced, np.ones_like(cost, dtype=bool)) + 5.0 + arcs[i, j]
                if through - length <= slack:
                    expected.add((i, j))
    assert {tuple(link) for link in found.T.tolist()} == expected
