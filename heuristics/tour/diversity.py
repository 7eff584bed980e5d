"""How diverse a population of tours is: the entropy of its edges.

H = - sum over edges e of F(e)/P log(F(e)/P), where F(e) of the P tours contain edge e
(Nagata and Kobayashi 2013, section 4.2).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["EdgeCount", "add_edge", "count_edges", "multiplicity", "remove_edge"]


class EdgeCount(NamedTuple):
    """How many tours of a population contain each edge.

    Parameters
    ----------
    other
        Larger end of the edges whose smaller end is v, shape (N, S).
    tours
        Number of tours with that edge, at least 1, shape (N, S).
    used
        How many of the S places are taken at v, shape (N,).
    entropy
        Term of the entropy for an edge in c tours, c = 0 to P, shape (P + 1,).
    """

    other: NDArray[np.int64]
    tours: NDArray[np.int64]
    used: NDArray[np.int64]
    entropy: NDArray[np.float64]


def count_edges(orders: NDArray[np.int64]) -> EdgeCount:
    """Count the edges of all tours, shape (P, N)."""
    tours, size = orders.shape
    share = np.arange(1, tours + 1) / tours
    places = (size, 2 * tours)
    edges = EdgeCount(
        np.empty(places, dtype=np.int64),
        np.empty(places, dtype=np.int64),
        np.zeros(size, dtype=np.int64),
        np.concatenate(([0.0], -share * np.log(share))),
    )
    _count(edges, orders)
    return edges


@kernel
def _count(edges: EdgeCount, orders: NDArray[np.int64]) -> None:
    for i in range(orders.shape[0]):
        for p in range(orders.shape[1]):
            add_edge(edges, orders[i, p - 1], orders[i, p])


@kernel
def _find(edges: EdgeCount, u: int, v: int) -> int:
    """Place of edge (u, v), where u is less than v; the first free one if it is in no tour."""
    for i in range(edges.used[u]):
        if edges.other[u, i] == v:
            return i
    free: int = edges.used[u]
    return free


@kernel
def multiplicity(edges: EdgeCount, u: int, v: int) -> int:
    """Number of tours that contain the edge between two vertices."""
    u, v = min(u, v), max(u, v)
    i = _find(edges, u, v)
    tours: int = edges.tours[u, i] if i < edges.used[u] else 0
    return tours


@kernel
def add_edge(edges: EdgeCount, u: int, v: int) -> None:
    """Count one more tour with an edge."""
    u, v = min(u, v), max(u, v)
    i = _find(edges, u, v)
    if i == edges.used[u]:
        edges.other[u, i], edges.tours[u, i] = v, 0
        edges.used[u] += 1
    edges.tours[u, i] += 1


@kernel
def remove_edge(edges: EdgeCount, u: int, v: int) -> None:
    """Count one tour less with an edge that is in at least one."""
    u, v = min(u, v), max(u, v)
    i = _find(edges, u, v)
    edges.tours[u, i] -= 1
    if edges.tours[u, i] == 0:
        last = edges.used[u] - 1
        edges.other[u, i], edges.tours[u, i] = edges.other[u, last], edges.tours[u, last]
        edges.used[u] = last
