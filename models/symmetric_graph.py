"""Undirected legs of a network: their least times, a block of vertices at a time.

An edge {i, j} takes the shorter of its two directions that some feasible route contains, and
half the services at its ends, c_ij = min(t_ij, t_ji) + (s_i + s_j) / 2; infinite where
neither direction is of use. Vertices are those of the problem: start 0, nodes 1 to n,
destination n + 1. The full matrix is never formed: n is in the thousands here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.models.network import Network

__all__ = ["SymmetricGraph"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_BLOCK = 256  # vertices whose edges are in memory at once


@dataclass(frozen=True, slots=True, eq=False)
class SymmetricGraph:
    """Edges between start, nodes and destination. Build it with `SymmetricGraph.of`.

    Parameters
    ----------
    travel
        Leg times, shape (n + 2, n + 2).
    service
        Service times, shape (n + 2,).
    earliest
        When a leg may leave at the earliest, service included; never from the destination.
    latest
        When a leg must have arrived; never at the start.
    """

    travel: Floats
    service: Floats
    earliest: Floats
    latest: Floats

    @classmethod
    def of(cls, network: Network) -> SymmetricGraph:
        """Edges within the largest budget."""
        earliest, latest = network.earliest.copy(), network.latest[[*range(network.n + 1), -1]]
        earliest[-1], latest[0] = np.inf, -np.inf
        return cls(network.problem.travel, network.problem.service, earliest, latest)

    @property
    def size(self) -> int:
        """Number of vertices."""
        return len(self.service)

    def costs(self, edges: Integers) -> Floats:
        """Times c of edges, shape (2, m)."""
        one, other = edges
        there, back = self.travel[one, other], self.travel[other, one]
        there = np.where(self.earliest[one] + there <= self.latest[other], there, np.inf)
        back = np.where(self.earliest[other] + back <= self.latest[one], back, np.inf)
        times: Floats = np.minimum(there, back) + (self.service[one] + self.service[other]) / 2.0
        return times

    def blocks(self) -> Iterator[tuple[Integers, Floats]]:
        """Times of all edges, a few vertices at a time.

        Yields
        ------
        vertices : Integers
            Shape (b,).
        times : Floats
            To every vertex, shape (b, n + 2); infinite on the diagonal.
        """
        for first in range(0, self.size, _BLOCK):
            part = slice(first, min(first + _BLOCK, self.size))
            vertices = np.arange(part.start, part.stop)
            there, times = self.travel[part].copy(), self.travel[:, part].T.copy()
            there[self.earliest[part, None] + there > self.latest] = np.inf
            times[self.earliest + times > self.latest[part, None]] = np.inf
            np.minimum(there, times, out=times)
            times += (self.service[part, None] + self.service) / 2.0
            times[np.arange(len(vertices)), vertices] = np.inf
            yield vertices, times

    def nearest(self, neighbours: int) -> Integers:
        """Edges of every node to its nearest, to the start and to the destination, (2, any)."""
        edges, last = [], self.size - 1
        for vertices, times in self.blocks():
            at_ends = (vertices == 0) | (vertices == last)
            many = min(neighbours, self.size - 2)
            near = np.argpartition(times[:, 1:last], many - 1, axis=1)[:, :many] + 1
            close = np.zeros(times.shape, dtype=np.bool_)
            np.put_along_axis(close, near, True, axis=1)
            close[at_ends] = True
            ones, others = np.nonzero(close & np.isfinite(times))
            edges.append(np.stack([vertices[ones], others]))
        return np.concatenate(edges, axis=1)
