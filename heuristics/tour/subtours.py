"""Joining the sub-tours that an exchange leaves.

The smallest sub-tour is opened at one edge and another one at one of its edges, and the four
ends are joined the other way, at the least extra cost over all edges of the smallest
sub-tour and their ends' neighbour lists, until one tour is left (Nagata and Kobayashi 2013,
section 3.1, step 5). Everything happens in the description of the exchange; the tour itself
is not touched.

Below, the edge of the changed tours at a vertex is named by the position of that vertex and a
side of it, 0 before and 1 behind.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.exchange import (
    Exchange,
    Tour,
    across,
    segment_length,
    segment_of_port,
    vertex_at,
)
from fiveroute.heuristics.tour.graph import Graph, edge_cost
from fiveroute.kernels import kernel

__all__ = ["label_segments", "segment_at", "unite"]


@kernel
def unite(graph: Graph, tour: Tour, exchange: Exchange, k: int, limit: float) -> tuple[int, float]:
    """Extend an exchange until it leaves a single tour.

    Parameters
    ----------
    graph, tour
        The graph, and the tour that the exchange belongs to.
    exchange
        Extended in place; it has room for three times its cuts, or for N.
    k
        Number of cuts.
    limit
        Extra cost in seconds at which to give up.

    Returns
    -------
    tuple
        Number of cuts of the extended exchange, 0 where it was given up; and its extra cost.
    """
    label = np.empty(len(exchange.cut), dtype=np.int64)
    vertices = np.empty(k, dtype=np.int64)
    tours = label_segments(tour, exchange, k, label, vertices)
    total = 0.0
    for _ in range(tours - 1):
        smallest = -1
        for i in range(tours):
            if vertices[i] > 0 and (smallest < 0 or vertices[i] < vertices[smallest]):
                smallest = i
        extra, p, side, q, far_side = _cheapest_link(graph, tour, exchange, k, label, smallest)
        total += extra
        if total >= limit:
            return 0, total
        k = _open(tour, exchange, label, k, p, side)
        k = _open(tour, exchange, label, k, q, far_side)
        _link(exchange, _port(tour, exchange, k, p, side), _port(tour, exchange, k, q, far_side))
        target = label[segment_at(exchange, k, q)]
        for r in range(k):
            if label[r] == smallest:
                label[r] = target
        vertices[target] += vertices[smallest]
        vertices[smallest] = 0
    return k, total


@kernel
def label_segments(
    tour: Tour, exchange: Exchange, k: int, label: NDArray[np.int64], vertices: NDArray[np.int64]
) -> int:
    """Find the sub-tours.

    Parameters
    ----------
    tour, exchange, k
        The tour, the exchange and its number of cuts.
    label
        Filled with the number of its sub-tour for every segment, shape (k,) or longer.
    vertices
        Filled with the number of vertices on each sub-tour, shape (k,).

    Returns
    -------
    int
        Number of sub-tours.
    """
    tours = 0
    label[:k] = -1
    for first in range(k):
        if label[first] >= 0:
            continue
        vertices[tours] = 0
        start = 2 * first + 1
        port = start
        while True:
            r = segment_of_port(port, k)
            label[r] = tours
            vertices[tours] += segment_length(tour, exchange, k, r)
            port = exchange.join[across(port, k)]
            if port == start:
                break
        tours += 1
    return tours


@kernel
def segment_at(exchange: Exchange, k: int, p: int) -> int:
    """Segment that holds position p."""
    r = _cuts_before(exchange, k, p)
    return r - 1 if r > 0 else k - 1


@kernel
def _cuts_before(exchange: Exchange, k: int, p: int) -> int:
    """Number of cuts at positions less than p."""
    low, high = 0, k
    while low < high:
        middle = (low + high) >> 1
        if exchange.cut[middle] < p:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def _cut_at(tour: Tour, p: int, side: int) -> int:
    """Position of the cut on one side of position p."""
    if side == 1:
        return p
    return p - 1 if p > 0 else len(tour.order) - 1


@kernel
def _port(tour: Tour, exchange: Exchange, k: int, p: int, side: int) -> int:
    """Port at position p towards one side; -1 where there is no cut."""
    wanted = _cut_at(tour, p, side)
    r = _cuts_before(exchange, k, wanted)
    if r < k and exchange.cut[r] == wanted:
        return 2 * r + 1 - side
    return -1


@kernel
def _beyond(tour: Tour, exchange: Exchange, k: int, p: int, side: int) -> int:
    """Vertex at the other end of an edge of the changed tours."""
    port = _port(tour, exchange, k, p, side)
    if port >= 0:
        return vertex_at(tour, exchange, exchange.join[port])
    q = _cut_at(tour, p, side) + side
    vertex: int = tour.order[q if q < len(tour.order) else 0]
    return vertex


@kernel
def _open(
    tour: Tour, exchange: Exchange, label: NDArray[np.int64], k: int, p: int, side: int
) -> int:
    """Make sure that there is a cut on one side of position p; returns the number of cuts.

    The ports of a new cut are joined to each other: so far it changes nothing.
    """
    cut, join = exchange.cut, exchange.join
    wanted = _cut_at(tour, p, side)
    r = _cuts_before(exchange, k, wanted)
    if r < k and cut[r] == wanted:
        return k
    inside = label[r - 1 if r > 0 else k - 1]
    for i in range(k, r, -1):
        cut[i], label[i] = cut[i - 1], label[i - 1]
    for port in range(2 * k - 1, -1, -1):
        mate = join[port]
        join[port if port < 2 * r else port + 2] = mate if mate < 2 * r else mate + 2
    cut[r], label[r] = wanted, inside
    join[2 * r], join[2 * r + 1] = 2 * r + 1, 2 * r
    return k + 1


@kernel
def _link(exchange: Exchange, here: int, there: int) -> None:
    """Join two ports, and the ports that they have been joined to."""
    join = exchange.join
    here_mate, there_mate = join[here], join[there]
    join[here], join[there] = there, here
    join[here_mate], join[there_mate] = there_mate, here_mate


@kernel
def _cheapest_link(
    graph: Graph, tour: Tour, exchange: Exchange, k: int, label: NDArray[np.int64], smallest: int
) -> tuple[float, int, int, int, int]:
    """Find the cheapest way to join one sub-tour to another.

    Returns
    -------
    tuple
        Extra cost, infinite where no neighbour list leads to another sub-tour; position and
        side of the edge to open in this sub-tour, and of the edge to open in the other.
    """
    best = (np.inf, 0, 0, 0, 0)
    for r in range(k):
        if label[r] != smallest:
            continue
        p = exchange.cut[r]
        for _ in range(segment_length(tour, exchange, k, r)):
            p = p + 1 if p + 1 < len(tour.order) else 0
            for side in range(2):
                if graph.mate[tour.order[p]] != _beyond(tour, exchange, k, p, side):
                    best = _link_from(graph, tour, exchange, k, label, p, side, best)
    return best


@kernel
def _link_from(
    graph: Graph,
    tour: Tour,
    exchange: Exchange,
    k: int,
    label: NDArray[np.int64],
    p: int,
    side: int,
    best: tuple[float, int, int, int, int],
) -> tuple[float, int, int, int, int]:
    """The cheapest link that opens one edge, or `best` if that is cheaper."""
    here, u, u_next = (
        label[segment_at(exchange, k, p)],
        tour.order[p],
        _beyond(tour, exchange, k, p, side),
    )
    opened = edge_cost(graph, u, u_next)
    for j in range(graph.near.shape[1]):
        first = graph.near_cost[u, j] - opened
        if first >= best[0]:
            break
        v = graph.near[u, j]
        q = tour.position[v]
        if label[segment_at(exchange, k, q)] == here:
            continue
        for far_side in range(2):
            v_next = _beyond(tour, exchange, k, q, far_side)
            if graph.mate[v] == v_next:
                continue
            extra = first + edge_cost(graph, u_next, v_next) - edge_cost(graph, v, v_next)
            if extra < best[0]:
                best = (extra, p, side, q, far_side)
    return best
