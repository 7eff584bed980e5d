"""Which legs an AUV can use at all.

A route of AUV m that contains the leg (i, j) lasts at least

    e_i + t_ij + s_j + l_j,

where e_i is the least time in which i can be reached and served, and l_j the least time
from the end of the service at j to the destination. Both are lengths of shortest ways over
other nodes, service included, so the triangle inequality is not needed. Legs beyond the
budget leave the model; where none is left for some AUV, no plan exists.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.problem import TeamOrienteering

__all__ = ["usable_legs"]

Floats = NDArray[np.float64]

_SAFE = 1.0 + 1e-12
"""Budgets grow by this factor: the sum of a route's times depends on their order."""


def usable_legs(problem: TeamOrienteering) -> NDArray[np.bool_]:
    """Whether AUV m may use the leg from i to j, shape (M, n + 2, n + 2)."""
    ways = problem.travel + problem.service  # a leg counts with the service at its head
    ways[:, 0] = ways[-1, :] = np.inf  # no way enters the start or leaves the destination
    np.fill_diagonal(ways, np.inf)
    from_start = _shortest(ways, origin=0)
    to_destination = _shortest(ways.T, origin=problem.destination)
    through = from_start[:, None] + ways + to_destination[None, :]
    usable: NDArray[np.bool_] = through[None] <= _SAFE * problem.allowed[:, None, None]
    return usable


def _shortest(ways: Floats, origin: int) -> Floats:
    """Lengths of the shortest ways from the origin, by Bellman and Ford."""
    length: Floats = ways[origin].copy()
    length[origin] = 0.0
    while True:
        shorter = np.minimum(length, (length[:, None] + ways).min(axis=0))
        if np.array_equal(shorter, length):
            return length
        length = shorter
