"""AB-cycles: where two tours differ, cut into cycles of alternating edges.

The edges of tour A that B lacks and the edges of B that A lacks form a graph in which every
vertex has as many edges of one kind as of the other. A random walk that takes the two kinds
in turn splits it into AB-cycles; exchanging the edges of A on such a cycle for those of B
keeps two edges at every vertex (Y. Nagata, S. Kobayashi, "A powerful genetic algorithm using
edge assembly crossover for the traveling salesman problem", INFORMS Journal on Computing 25,
2013, doi 10.1287/ijoc.1120.0506, section 3.1).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.exchange import Tour, beside
from fiveroute.heuristics.tour.random_numbers import random_below
from fiveroute.kernels import kernel

__all__ = ["ab_cycles"]


@kernel
def ab_cycles(
    a: Tour, b: Tour, state: NDArray[np.uint64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Split the difference of two tours into AB-cycles at random.

    Parameters
    ----------
    a, b
        The tours, over the same vertices.
    state
        State of the random numbers; advanced.

    Returns
    -------
    tuple
        Vertices of all cycles one after the other, and the index of the first vertex of each
        cycle, with the total number as a last entry; fresh arrays. Edges (0, 1), (2, 3), ...
        of a cycle belong to A; (1, 2), (3, 4), ... and the closing one belong to B.
    """
    size = len(a.order)
    rest, degree = _difference(a, b)
    open_vertices = np.flatnonzero(degree[0])
    unused = len(open_vertices)
    vertices = np.empty(2 * degree[0].sum() // 2, dtype=np.int64)
    starts = np.zeros(len(vertices) // 4 + 1, dtype=np.int64)
    cycles, filled = 0, 0
    path = np.empty(len(vertices) + 1, dtype=np.int64)
    seen = np.full((2, size), -1)  # index on the path by parity
    while unused > 0:
        i = random_below(state, unused)
        root = open_vertices[i]
        if degree[0, root] == 0:
            unused -= 1
            open_vertices[i] = open_vertices[unused]
            continue
        path[0] = root
        seen[0, root] = 0
        last = 0
        while last > 0 or degree[0, root] > 0:
            kind = last & 1
            tail = path[last]
            head = rest[kind, tail, random_below(state, degree[kind, tail])]
            _remove(rest, degree, kind, tail, head)
            _remove(rest, degree, kind, head, tail)
            last += 1
            path[last] = head
            first = seen[last & 1, head]
            if first < 0:
                seen[last & 1, head] = last
                continue
            shift = first & 1  # begin with an edge of A
            for j in range(first + shift, last + shift):
                vertices[filled] = path[j]
                filled += 1
            for j in range(first + 1, last):
                seen[j & 1, path[j]] = -1
            last = first
            cycles += 1
            starts[cycles] = filled
        seen[0, root] = -1
    return vertices, starts[: cycles + 1]


@kernel
def _difference(a: Tour, b: Tour) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Edges of one tour only: their other ends by kind and vertex, and how many there are."""
    size = len(a.order)
    rest = np.empty((2, size, 2), dtype=np.int64)
    degree = np.zeros((2, size), dtype=np.int64)
    for v in range(size):
        for kind in range(2):
            own, other = (a, b) if kind == 0 else (b, a)
            before, after = beside(other, v, 0), beside(other, v, 1)
            for side in range(2):
                w = beside(own, v, side)
                if w != before and w != after:
                    rest[kind, v, degree[kind, v]] = w
                    degree[kind, v] += 1
    return rest, degree


@kernel
def _remove(
    rest: NDArray[np.int64], degree: NDArray[np.int64], kind: int, tail: int, head: int
) -> None:
    degree[kind, tail] -= 1
    if rest[kind, tail, 0] == head:
        rest[kind, tail, 0] = rest[kind, tail, 1]
