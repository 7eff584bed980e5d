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

from fiveroute.models.network import shortest_ways
from fiveroute.problem import TeamOrienteering

__all__ = ["usable_legs"]

_SAFE = 1.0 + 1e-12
"""Budgets grow by this factor: the sum of a route's times depends on their order."""


def usable_legs(problem: TeamOrienteering) -> NDArray[np.bool_]:
    """Whether AUV m may use the leg from i to j, shape (M, n + 2, n + 2)."""
    travel, service = problem.travel, problem.service
    legs = travel + service  # a leg counts with the service at its head
    legs[:, 0] = legs[-1, :] = np.inf  # no way enters the start or leaves the destination
    np.fill_diagonal(legs, np.inf)
    from_start = shortest_ways(travel, service, 0, False)
    to_destination = shortest_ways(travel, service, problem.destination, True)
    through = from_start[:, None] + legs + to_destination[None, :]
    usable: NDArray[np.bool_] = through[None] <= _SAFE * problem.allowed[:, None, None]
    return usable
