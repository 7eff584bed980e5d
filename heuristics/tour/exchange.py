"""Exchanges: what every move and every crossover does to a tour.

A tour is an array `order` of its vertices and the inverse array `position`. An exchange
removes k edges of the tour and adds k others. Cut r, for r = 0 to k - 1 in ascending order,
is the removed edge between positions cut[r] and cut[r] + 1; what lies between two cuts is a
*segment*. Every cut has two *ports*: 2 r is the end of the segment before it and 2 r + 1 the
start of the segment after it. The added edges join ports pairwise: join[p] is the port that
port p is joined to. Positions count modulo N, cuts modulo k.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = [
    "Tour",
    "across",
    "alternate",
    "apply_exchange",
    "beside",
    "is_single_tour",
    "place",
    "sort_keys",
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


@kernel
def place(tour: Tour) -> None:
    """Fill the positions from the order."""
    for p in range(len(tour.order)):
        tour.position[tour.order[p]] = p


@kernel
def beside(tour: Tour, vertex: int, side: int) -> int:
    """Tour neighbour of a vertex: the one before it (side 0) or after it (side 1)."""
    p = tour.position[vertex] + 2 * side - 1
    if p < 0:
        p = len(tour.order) - 1
    elif p == len(tour.order):
        p = 0
    return tour.order[p]


@kernel
def vertex_at(tour: Tour, cut: NDArray[np.int64], port: int) -> int:
    """Vertex at a port."""
    p = cut[port >> 1] + (port & 1)
    return tour.order[p if p < len(tour.order) else 0]


@kernel
def across(port: int, k: int) -> int:
    """Port at the other end of the segment."""
    if port & 1:
        return port + 1 if port + 1 < 2 * k else 0
    return port - 1 if port > 0 else 2 * k - 1


@kernel
def alternate(
    tour: Tour,
    walk: NDArray[np.int64],
    k: int,
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
    keys: NDArray[np.int64],
) -> None:
    """Describe the exchange along an alternating cycle.

    Parameters
    ----------
    tour
        The tour.
    walk
        Vertices of the cycle, at least 2 k of them: the tour edges (walk[0], walk[1]),
        (walk[2], walk[3]), ... are removed, and (walk[1], walk[2]), ...,
        (walk[2 k - 1], walk[0]) are added.
    k
        Number of removed edges.
    cut, join
        Filled with the exchange; at least k and 2 k long.
    keys
        Scratch space, at least 2 k long.
    """
    last = len(tour.order) - 1
    for i in range(k):
        p, q = tour.position[walk[2 * i]], tour.position[walk[2 * i + 1]]
        if q - p == 1 or p - q == last:
            keys[i] = p * k + i
        else:
            keys[i] = q * k + i
    sort_keys(keys[:k])
    port = keys[k:]  # of the first vertex of removed edge i; keys[r] is read before it
    for r in range(k):
        cut[r] = keys[r] // k
        i = keys[r] % k
        join[i] = 2 * r + (tour.position[walk[2 * i]] != cut[r])
    for i in range(k):
        port[i] = join[i]
    for i in range(k):
        here, there = port[i] ^ 1, port[i + 1 if i + 1 < k else 0]
        join[here] = there
        join[there] = here


@kernel
def sort_keys(keys: NDArray[np.int64]) -> None:
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
    return


@kernel
def is_single_tour(join: NDArray[np.int64], k: int) -> bool:
    """Whether an exchange leaves one tour rather than several."""
    port = 1
    for visited in range(1, k + 1):
        port = join[across(port, k)]
        if port == 1:
            return visited == k
    return False


@kernel
def apply_exchange(
    tour: Tour, cut: NDArray[np.int64], join: NDArray[np.int64], k: int, scratch: NDArray[np.int64]
) -> tuple[int, int]:
    """Carry out an exchange that leaves a single tour.

    The longest segment stays in place and the others are laid behind it anew.

    Parameters
    ----------
    tour
        Changed in place.
    cut, join, k
        The exchange.
    scratch
        Scratch space, shape (N,).

    Returns
    -------
    tuple
        First position that was written, and how many positions from there on.
    """
    size = len(tour.order)
    longest, stay = -1, 0
    for r in range(k):
        length = _length(cut, r, k, size)
        if length > longest:
            longest, stay = length, r
    written = 0
    port = join[across(2 * stay + 1, k)]
    while port != 2 * stay + 1:
        p = cut[port >> 1] + (port & 1)
        step = 1 if port & 1 else -1
        r = port >> 1 if port & 1 else (port >> 1) - 1
        for _ in range(_length(cut, r, k, size)):
            if p >= size:
                p -= size
            elif p < 0:
                p += size
            scratch[written] = tour.order[p]
            written += 1
            p += step
        port = join[across(port, k)]
    first = cut[stay + 1 if stay + 1 < k else 0] + 1
    p = first
    for i in range(written):
        if p >= size:
            p -= size
        tour.order[p] = scratch[i]
        tour.position[scratch[i]] = p
        p += 1
    return first, written


@kernel
def _length(cut: NDArray[np.int64], segment: int, k: int, size: int) -> int:
    """Number of vertices on the segment behind a cut; `segment` may be -1."""
    if segment < 0:
        segment = k - 1
    if segment + 1 < k:
        return cut[segment + 1] - cut[segment]
    return cut[0] - cut[segment] + size
