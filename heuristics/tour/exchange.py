"""Exchanges: what every move and every crossover does to a tour.

A tour is an array `order` of its vertices and the inverse array `position`. An exchange
removes k edges of the tour and adds k others. Cut r, for r = 0 to k - 1 in ascending order,
is the removed edge between positions cut[r] and cut[r] + 1; segment r is what lies between
cut r and the next. Every cut has two *ports*: 2 r is the end of the segment before it, and
2 r + 1 the start of the segment behind it. The added edges join ports pairwise: join[p] is
the port that port p is joined to. Positions count modulo N, cuts modulo k.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = [
    "Cycles",
    "Exchange",
    "Tour",
    "across",
    "alternate",
    "apply_exchange",
    "beside",
    "is_single_tour",
    "new_exchange",
    "segment_length",
    "segment_of_port",
    "vertex_at",
]


class Tour(NamedTuple):
    """A cyclic tour.

    Parameters
    ----------
    order
        Vertices in the order of the visits, shape (N,).
    position
        Position of every vertex in `order`, shape (N,).
    """

    order: NDArray[np.int64]
    position: NDArray[np.int64]


class Cycles(NamedTuple):
    """Alternating cycles: a removed edge, an added edge, and so on in turn.

    Parameters
    ----------
    vertices
        Vertices of all cycles one after the other. In a cycle w of 2 m vertices, the edges
        (w[0], w[1]), (w[2], w[3]), ... are removed; (w[1], w[2]), ..., (w[2 m - 1], w[0])
        are added.
    starts
        Index of the first vertex of each cycle, and behind it the number of all vertices.
    """

    vertices: NDArray[np.int64]
    starts: NDArray[np.int64]


class Exchange(NamedTuple):
    """Room for an exchange; how many cuts it has is kept apart.

    Parameters
    ----------
    cut
        Position before each removed edge, ascending, shape (K,).
    join
        Port that each port is joined to, shape (2 K,).
    """

    cut: NDArray[np.int64]
    join: NDArray[np.int64]


@kernel
def new_exchange(room: int) -> Exchange:
    """Room for `room` cuts."""
    return Exchange(np.empty(room, dtype=np.int64), np.empty(2 * room, dtype=np.int64))


@kernel
def beside(tour: Tour, vertex: int, side: int) -> int:
    """Tour neighbour of a vertex: the one before it (side 0) or after it (side 1)."""
    p = tour.position[vertex] + 2 * side - 1
    if p < 0:
        p = len(tour.order) - 1
    elif p == len(tour.order):
        p = 0
    neighbour: int = tour.order[p]
    return neighbour


@kernel
def vertex_at(tour: Tour, exchange: Exchange, port: int) -> int:
    """Vertex at a port."""
    p = exchange.cut[port >> 1] + (port & 1)
    vertex: int = tour.order[p if p < len(tour.order) else 0]
    return vertex


@kernel
def across(port: int, k: int) -> int:
    """Port at the other end of the segment, where there are k cuts."""
    if port & 1:
        return port + 1 if port + 1 < 2 * k else 0
    return port - 1 if port > 0 else 2 * k - 1


@kernel
def segment_of_port(port: int, k: int) -> int:
    """Segment that a port is an end of."""
    if port & 1:
        return port >> 1
    return (port >> 1) - 1 if port > 0 else k - 1


@kernel
def segment_length(tour: Tour, exchange: Exchange, k: int, segment: int) -> int:
    """Number of vertices on a segment."""
    length: int = exchange.cut[segment + 1 if segment + 1 < k else 0] - exchange.cut[segment]
    return length if length > 0 else length + len(tour.order)


@kernel
def alternate(
    tour: Tour, cycles: Cycles, count: int, exchange: Exchange, scratch: NDArray[np.int64]
) -> int:
    """Describe the exchange along alternating cycles.

    Parameters
    ----------
    tour
        The tour; the removed edges are edges of it.
    cycles
        Cycles without a common removed or added edge.
    count
        How many of them, from the first.
    exchange
        Filled: one cut for every second vertex of the cycles.
    scratch
        Working space, as long as the cycles.

    Returns
    -------
    int
        Number of cuts.
    """
    k: int = cycles.starts[count] // 2
    last = len(tour.order) - 1
    for i in range(k):
        p = tour.position[cycles.vertices[2 * i]]
        q = tour.position[cycles.vertices[2 * i + 1]]
        forward = q - p == 1 or p - q == last
        scratch[i] = (p if forward else q) * k + i
    _sort(scratch[:k])
    port = scratch[k:]  # of the first vertex of every removed edge
    for r in range(k):
        i = scratch[r] % k
        exchange.cut[r] = scratch[r] // k
        port[i] = 2 * r + (tour.position[cycles.vertices[2 * i]] != exchange.cut[r])
    for c in range(count):
        first, end = cycles.starts[c] // 2, cycles.starts[c + 1] // 2
        for i in range(first, end):
            here, there = port[i] ^ 1, port[i + 1 if i + 1 < end else first]
            exchange.join[here], exchange.join[there] = there, here
    return k


@kernel
def _sort(keys: NDArray[np.int64]) -> None:
    """Sort in place: Shell's method, an insertion sort where there are few keys."""
    gap = 1
    while 9 * gap < 4 * len(keys):
        gap = 9 * gap // 4 + 1
    while gap > 0:
        for i in range(gap, len(keys)):
            key = keys[i]
            j = i
            while j >= gap and keys[j - gap] > key:
                keys[j] = keys[j - gap]
                j -= gap
            keys[j] = key
        gap = 4 * gap // 9


@kernel
def is_single_tour(exchange: Exchange, k: int) -> bool:
    """Whether an exchange leaves one tour rather than several."""
    port = 1
    for visited in range(1, k + 1):
        port = exchange.join[across(port, k)]
        if port == 1:
            return visited == k
    return False


@kernel
def apply_exchange(tour: Tour, exchange: Exchange, k: int, scratch: NDArray[np.int64]) -> None:
    """Carry out an exchange that leaves a single tour.

    The longest segment stays in place, and the others are laid behind it anew.

    Parameters
    ----------
    tour
        Changed in place.
    exchange, k
        The exchange and its number of cuts.
    scratch
        Working space, shape (N,).
    """
    size = len(tour.order)
    stay = 0
    for r in range(1, k):
        if segment_length(tour, exchange, k, r) > segment_length(tour, exchange, k, stay):
            stay = r
    start = 2 * stay + 1
    behind = across(start, k)
    written = 0
    port = exchange.join[behind]
    while port != start:
        p = exchange.cut[port >> 1] + (port & 1)
        step = 1 if port & 1 else -1
        for _ in range(segment_length(tour, exchange, k, segment_of_port(port, k))):
            p = p - size if p >= size else p + size if p < 0 else p
            scratch[written] = tour.order[p]
            written += 1
            p += step
        port = exchange.join[across(port, k)]
    p = exchange.cut[behind >> 1]
    for i in range(written):
        p = p + 1 if p + 1 < size else 0
        tour.order[p] = scratch[i]
        tour.position[scratch[i]] = p
