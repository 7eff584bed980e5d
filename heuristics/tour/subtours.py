"""Joining the sub-tours that an exchange leaves.

The smallest sub-tour is opened at one edge and another one at one of its edges, and the four
ends are joined the other way, at the least extra cost over all edges of the smallest
sub-tour and all neighbour lists, until one tour is left (Nagata and Kobayashi 2013,
section 3.1, step 5). Everything happens in the description of the exchange; the tour itself
is not touched.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.exchange import Tour, across, vertex_at
from fiveroute.heuristics.tour.graph import Graph, edge_cost
from fiveroute.kernels import kernel

__all__ = ["unite"]


@kernel
def unite(
    graph: Graph,
    tour: Tour,
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
    k: int,
    limit: float,
) -> tuple[int, float]:
    """Extend an exchange until it leaves a single tour.

    Parameters
    ----------
    graph, tour
        The graph, and the tour that the exchange belongs to.
    cut, join
        The exchange, extended in place; room for N cuts.
    k
        Number of cuts.
    limit
        Extra cost in seconds at which to give up.

    Returns
    -------
    tuple
        Number of cuts of the extended exchange, 0 where none was found; and its extra cost.
    """
    label = np.full(len(cut), -1)
    vertices = np.zeros(k, dtype=np.int64)
    tours = _label_segments(cut, join, k, len(tour.order), label, vertices)
    total = 0.0
    for _ in range(tours - 1):
        smallest = -1
        for i in range(tours):
            if vertices[i] > 0 and (smallest < 0 or vertices[i] < vertices[smallest]):
                smallest = i
        extra, p, side, q, other_side = _cheapest_link(graph, tour, cut, join, k, label, smallest)
        total += extra
        if total >= limit:
            return 0, total
        k = _open(tour, cut, join, label, k, p, side)
        k = _open(tour, cut, join, label, k, q, other_side)
        here, there = _port(cut, k, p, side, tour), _port(cut, k, q, other_side, tour)
        here_mate, there_mate = join[here], join[there]
        join[here], join[there] = there, here
        join[here_mate], join[there_mate] = there_mate, here_mate
        target = label[_segment(cut, k, q)]
        for r in range(k):
            if label[r] == smallest:
                label[r] = target
        vertices[target] += vertices[smallest]
        vertices[smallest] = 0
    return k, total


@kernel
def _label_segments(
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
    k: int,
    size: int,
    label: NDArray[np.int64],
    vertices: NDArray[np.int64],
) -> int:
    """Number the sub-tours, label every segment with its own, and count their vertices."""
    tours = 0
    for first in range(k):
        if label[first] >= 0:
            continue
        port = 2 * first + 1
        while True:
            r = port >> 1 if port & 1 else (port >> 1) - 1
            if r < 0:
                r = k - 1
            label[r] = tours
            vertices[tours] += cut[r + 1] - cut[r] if r + 1 < k else cut[0] - cut[r] + size
            port = join[across(port, k)]
            if port == 2 * first + 1:
                break
        tours += 1
    return tours


@kernel
def _rank(cut: NDArray[np.int64], k: int, p: int) -> int:
    """Number of cuts before position p: the first cut not before it."""
    low, high = 0, k
    while low < high:
        middle = (low + high) >> 1
        if cut[middle] < p:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def _segment(cut: NDArray[np.int64], k: int, p: int) -> int:
    """Segment that holds position p."""
    r = _rank(cut, k, p) - 1
    return r if r >= 0 else k - 1


@kernel
def _port(cut: NDArray[np.int64], k: int, p: int, side: int, tour: Tour) -> int:
    """Port at position p towards one side; -1 where the tour is not cut there."""
    if side == 0:
        p = p - 1 if p > 0 else len(tour.order) - 1
    r = _rank(cut, k, p)
    if r < k and cut[r] == p:
        return 2 * r if side == 1 else 2 * r + 1
    return -1


@kernel
def _following(
    tour: Tour, cut: NDArray[np.int64], join: NDArray[np.int64], k: int, p: int, side: int
) -> int:
    """Vertex beside position p after the exchange."""
    port = _port(cut, k, p, side, tour)
    if port >= 0:
        return vertex_at(tour, cut, join[port])
    p += 2 * side - 1
    if p < 0:
        p = len(tour.order) - 1
    elif p == len(tour.order):
        p = 0
    return tour.order[p]


@kernel
def _open(
    tour: Tour,
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
    label: NDArray[np.int64],
    k: int,
    p: int,
    side: int,
) -> int:
    """Make sure that the tour is cut on one side of position p; returns the number of cuts.

    The two ports of a new cut are joined to each other.
    """
    if side == 0:
        p = p - 1 if p > 0 else len(tour.order) - 1
    r = _rank(cut, k, p)
    if r < k and cut[r] == p:
        return k
    inside = label[r - 1 if r > 0 else k - 1]
    for i in range(k, r, -1):
        cut[i], label[i] = cut[i - 1], label[i - 1]
    for i in range(2 * k - 1, 2 * r - 1, -1):
        join[i + 2] = join[i]
    cut[r], label[r] = p, inside
    join[2 * r], join[2 * r + 1] = -1, -1
    k += 1
    for i in range(2 * k):
        if join[i] >= 2 * r:
            join[i] += 2
    join[2 * r], join[2 * r + 1] = 2 * r + 1, 2 * r
    return k


@kernel
def _cheapest_link(
    graph: Graph,
    tour: Tour,
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
    k: int,
    label: NDArray[np.int64],
    smallest: int,
) -> tuple[float, int, int, int, int]:
    """Cheapest way to join one sub-tour to another.

    Returns
    -------
    tuple
        Extra cost, infinite where there is none; position and side of the edge to open in
        this sub-tour, and of the edge to open in the other.
    """
    size, width = len(tour.order), graph.near.shape[1]
    best, best_p, best_side, best_q, best_other = np.inf, 0, 0, 0, 0
    for r in range(k):
        if label[r] != smallest:
            continue
        length = cut[r + 1] - cut[r] if r + 1 < k else cut[0] - cut[r] + size
        p = cut[r]
        for _ in range(length):
            p = p + 1 if p + 1 < size else 0
            u = tour.order[p]
            for side in range(2):
                u_next = _following(tour, cut, join, k, p, side)
                if graph.mate[u] == u_next:
                    continue
                opened = edge_cost(graph, u, u_next)
                for j in range(width):
                    saved = graph.near_cost[u, j] - opened
                    if saved >= best:
                        break
                    v = graph.near[u, j]
                    q = tour.position[v]
                    if label[_segment(cut, k, q)] == smallest:
                        continue
                    for other_side in range(2):
                        v_next = _following(tour, cut, join, k, q, other_side)
                        if graph.mate[v] == v_next:
                            continue
                        extra = (
                            saved + edge_cost(graph, u_next, v_next) - edge_cost(graph, v, v_next)
                        )
                        if extra < best:
                            best, best_p, best_side = extra, p, side
                            best_q, best_other = q, other_side
    return best, best_p, best_side, best_q, best_other
