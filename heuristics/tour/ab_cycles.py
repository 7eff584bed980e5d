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

from fiveroute.heuristics.tour.exchange import Cycles, Tour
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below

__all__ = ["ab_cycles"]


@kernel
def ab_cycles(a: Tour, b: Tour, state: RandomState) -> Cycles:
    """Split the difference of two tours into AB-cycles at random.

    Parameters
    ----------
    a, b
        The tours, over the same vertices.
    state
        State of the random numbers; advanced.

    Returns
    -------
    Cycles
        Fresh arrays; the removed edges belong to A and the added ones to B.
    """
    size = len(a.order)
    rest = np.empty((2, size, 2), dtype=np.int64)  # other ends of the edges left, by kind
    degree = np.zeros((2, size), dtype=np.int64)  # and how many
    _collect(a, b, rest[0], degree[0])
    _collect(b, a, rest[1], degree[1])
    roots = np.flatnonzero(degree[0])
    left = len(roots)
    edges = degree[0].sum()
    vertices = np.empty(2 * edges, dtype=np.int64)
    starts = np.zeros(edges // 2 + 1, dtype=np.int64)
    found = 0
    path = np.empty(2 * edges + 1, dtype=np.int64)
    seen = np.full((2, size), -1)  # index on the path, apart for even and odd ones
    while left > 0:
        i = below(state, left)
        root = roots[i]
        if degree[0, root] == 0:
            left -= 1
            roots[i] = roots[left]
            continue
        path[0] = root
        seen[0, root] = 0
        last = 0
        while last > 0 or degree[0, root] > 0:
            kind, tail = last & 1, path[last]
            head = rest[kind, tail, below(state, degree[kind, tail])]
            _remove(rest, degree, kind, tail, head)
            _remove(rest, degree, kind, head, tail)
            last += 1
            path[last] = head
            first = seen[last & 1, head]
            if first < 0:
                seen[last & 1, head] = last
                continue
            at = starts[found]
            from_a = first + (first & 1)  # begin with an edge of A
            for j in range(last - first):
                vertices[at + j] = path[from_a + j]
            for j in range(first + 1, last):
                seen[j & 1, path[j]] = -1
            found += 1
            starts[found] = at + last - first
            last = first
        seen[0, root] = -1
    return Cycles(vertices, starts[: found + 1])


@kernel
def _collect(own: Tour, other: Tour, rest: NDArray[np.int64], degree: NDArray[np.int64]) -> None:
    """Collect the edges of one tour that another one lacks."""
    last = len(own.order) - 1
    u = own.order[last]
    for p in range(last + 1):
        v = own.order[p]
        apart = abs(other.position[u] - other.position[v])
        if apart != 1 and apart != last:
            rest[u, degree[u]], rest[v, degree[v]] = v, u
            degree[u] += 1
            degree[v] += 1
        u = v


@kernel
def _remove(
    rest: NDArray[np.int64], degree: NDArray[np.int64], kind: int, tail: int, head: int
) -> None:
    degree[kind, tail] -= 1
    if rest[kind, tail, 0] == head:
        rest[kind, tail, 0] = rest[kind, tail, 1]
