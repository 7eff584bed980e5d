"""The network of all legs that some feasible route may contain.

Vertices 0 to n are the start and the sensor nodes. The destination stands once for every
distinct budget, vertices n + 1 to n + C: which copy a route ends in says which class of equal AUVs
sails it, so that nothing else in a flow model needs to know the AUVs.

A leg from i to j of a route that keeps to its budget arrives within a window. With e_i the
least time in which i can be reached and served, and l_j the least time from the end of the
service at j to the destination,

    e_i + t_ij <= arrival at j <= T - s_j - l_j,

where T is the largest budget, or that of the class if j is a copy of the destination. Legs
with an empty window are on no feasible route, nor are nodes all of whose legs are. Both e and l
are lengths of shortest paths over other nodes, so the triangle inequality is not needed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.problem import TeamOrienteering

__all__ = ["Network", "shortest_ways"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_SAFE = 1.0 + 1e-12
"""Budgets grow by this factor: the sum of a route's legs depends on their order."""


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """Windows of all legs. Build it with `Network.of`.

    Parameters
    ----------
    problem
        The problem.
    budgets
        Distinct budgets in seconds with the tolerance of the judge, ascending, shape (C,).
    members
        Indices of the AUVs of every class.
    earliest, remaining
        e and l in seconds, shape (n + 2,); infinite where nothing gets to or from.
    """

    problem: TeamOrienteering
    budgets: Floats
    members: tuple[tuple[int, ...], ...]
    earliest: Floats
    remaining: Floats

    @classmethod
    def of(cls, problem: TeamOrienteering) -> Network:
        """Compute the shortest paths from the start and to the destination, in O(n^2)."""
        budgets, member = np.unique(problem.allowed, return_inverse=True)
        return cls(
            problem,
            budgets * _SAFE,
            tuple(tuple(np.flatnonzero(member == c).tolist()) for c in range(len(budgets))),
            shortest_ways(problem.travel, problem.service, 0, False),
            shortest_ways(problem.travel, problem.service, problem.destination, True),
        )

    @property
    def n(self) -> int:
        """Number of sensor nodes."""
        return self.problem.n

    @property
    def classes(self) -> int:
        """Number C of classes of AUVs with equal budgets."""
        return len(self.budgets)

    @property
    def size(self) -> int:
        """Number of vertices, n + 1 + C."""
        return self.n + 1 + self.classes

    @property
    def routes(self) -> Floats:
        """Number of routes that end in each copy of the destination, shape (C,)."""
        return np.array([len(auvs) for auvs in self.members], dtype=np.float64)

    @property
    def horizon(self) -> float:
        """The largest budget in seconds."""
        return float(self.budgets[-1])

    @property
    def has_no_route(self) -> bool:
        """Whether the shortest way of all is too long for the AUV with the smallest budget."""
        return bool(self.earliest[-1] > self.budgets[0])

    @property
    def profit(self) -> Floats:
        """Data at every vertex, shape (size,)."""
        return np.concatenate([self.problem.profit[:-1], np.zeros(self.classes)])

    @property
    def service(self) -> Floats:
        """Service time at every vertex in seconds, shape (size,)."""
        return np.concatenate([self.problem.service[:-1], np.zeros(self.classes)])

    @property
    def latest(self) -> Floats:
        """Latest useful arrival at every vertex, shape (size,)."""
        inner = self.horizon - self.problem.service[:-1] - self.remaining[:-1]
        return np.concatenate([inner, self.budgets])

    def legs(self, tails: Integers, heads: Integers) -> Floats:
        """Travel times t_ij in seconds between network vertices; arrays broadcast."""
        times: Floats = self.problem.travel[tails, np.minimum(heads, self.n + 1)]
        return times

    def usable(self, tails: Integers) -> Booleans:
        """Whether the legs from `tails` to every vertex have a window, shape (tails, size)."""
        heads = np.arange(self.size)
        arrival = self.earliest[tails, None] + self.legs(tails[:, None], heads[None, :])
        possible: Booleans = arrival <= self.latest
        possible[:, 0] = False
        possible[tails[:, None] == heads[None, :]] = False
        return possible

    @property
    def reachable(self) -> Integers:
        """Sensor nodes on some route within the largest budget, ascending."""
        inner = slice(1, self.n + 1)
        through = self.earliest[inner] + self.remaining[inner]
        return np.flatnonzero(through <= self.horizon) + 1


@kernel
def shortest_ways(travel: Floats, service: Floats, origin: int, backwards: bool) -> Floats:
    """Dijkstra's algorithm on the full matrix; a leg costs its time and the service at its head.

    No path passes through the start or the destination on its way.
    """
    size = len(travel)
    length = np.full(size, np.inf)
    length[origin] = 0.0
    done = np.zeros(size, np.bool_)
    for _ in range(size):
        nearest = -1
        for k in range(size):
            if not done[k] and (nearest < 0 or length[k] < length[nearest]):
                nearest = k
        done[nearest] = True
        if nearest != origin and (nearest == 0 or nearest == size - 1):
            continue
        for k in range(size):
            if backwards:
                through = length[nearest] + travel[k, nearest] + service[nearest]
            else:
                through = length[nearest] + travel[nearest, k] + service[k]
            if not done[k] and through < length[k]:
                length[k] = through
    return length
