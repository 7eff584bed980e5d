"""Starting tours: greedy edges, with noise so that no two tours are alike.

Fixed edges are laid first; then edges of the neighbour lists, shortest (times noise) first,
wherever they join two ends of different paths (J. L. Bentley, "Fast algorithms for geometric
traveling salesman problems", ORSA Journal on Computing 4, 1992, doi 10.1287/ijoc.4.4.387);
the paths that remain are chained by the nearest free end.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.graph import Graph, edge_cost
from fiveroute.kernels import kernel

__all__ = ["greedy_tour"]

_PAD = 0.3
"""Share of the mean cost added to every edge, so that noise reorders edges of cost 0 too."""


def greedy_tour(graph: Graph, noise: float, rng: np.random.Generator) -> NDArray[np.int64]:
    """A tour of all vertices as a fresh array, shape (N,).

    Parameters
    ----------
    graph
        The graph.
    noise
        Edge costs, padded a little, are multiplied by random factors from 1 to 1 + `noise`.
    rng
        Source of the noise.
    """
    padded = graph.near_cost + _PAD * graph.near_cost.mean()
    keys = padded * (1.0 + noise * rng.random(padded.shape))
    link = _greedy_paths(graph, np.argsort(keys, axis=None, kind="stable"))
    return _chain(graph, link)


@kernel
def _greedy_paths(graph: Graph, ranking: NDArray[np.int64]) -> NDArray[np.int64]:
    """Paths as a fresh array of the two neighbours of every vertex, -1 where there is none."""
    size, width = graph.near.shape
    link = np.full((size, 2), -1)
    far_end = np.arange(size)  # of the path that ends at a vertex
    for u in range(size):
        v = graph.mate[u]
        if v > u:
            _join(link, far_end, u, v)
    for entry in ranking:
        u = entry // width
        v = graph.near[u, entry % width]
        if link[u, 1] < 0 and link[v, 1] < 0 and far_end[u] != v:
            _join(link, far_end, u, v)
    return link


@kernel
def _join(link: NDArray[np.int64], far_end: NDArray[np.int64], u: int, v: int) -> None:
    link[u, 0 if link[u, 0] < 0 else 1] = v
    link[v, 0 if link[v, 0] < 0 else 1] = u
    start, end = far_end[u], far_end[v]
    far_end[start], far_end[end] = end, start


@kernel
def _chain(graph: Graph, link: NDArray[np.int64]) -> NDArray[np.int64]:
    """Walk the paths one after the other, each from the free end nearest to the last."""
    size = len(link)
    ends = np.flatnonzero(link[:, 1] < 0)
    left = len(ends)
    order = np.empty(size, dtype=np.int64)
    done = np.zeros(size, dtype=np.bool_)
    tail = -1
    at = 0
    while at < size:
        head, best, kept = -1, np.inf, 0
        for i in range(left):
            v = ends[i]
            if done[v]:
                continue
            ends[kept] = v
            kept += 1
            cost = 0.0 if tail < 0 else edge_cost(graph, tail, v)
            if cost < best:
                head, best = v, cost
        left = kept
        if head < 0:  # greedy has closed one path over everything: start anywhere
            head = 0
        before = -1
        while head >= 0:
            order[at] = head
            done[head] = True
            at += 1
            following = link[head, 0] if link[head, 0] != before else link[head, 1]
            before, tail, head = head, head, following
    return order
