"""The roads: legs that a route may take, with the service at their heads, and time limits.

`leg[i, j]` = t_ij + s_j seconds, infinite where no feasible route sails from i to j. Summed
over a route it is the left side of equation (6). Limits lie a hair above what the judge allows, so
that the order of a sum cannot cost a feasible route: routes are judged before they are sailed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering

__all__ = ["Roads", "is_mirrored"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_SAFE = 1.0 + 1e-11  # more than the rounding of the sums of one route


@dataclass(frozen=True, slots=True, eq=False)
class Roads:
    """Legs and limits. Build them with `Roads.of`.

    Parameters
    ----------
    problem
        The problem.
    leg
        Times in seconds, shape (n + 2, n + 2).
    limits
        Time limit of every class of equal AUVs, ascending, shape (C,).
    routes
        Number of AUVs of every class, shape (C,).
    members
        The AUVs of every class.
    earliest, remaining
        Least time from the start to the end of the service at every vertex, and from there
        to the destination, in seconds, shape (n + 2,).
    toll
        What a second costs, in data; see `refund`.
    """

    problem: TeamOrienteering
    leg: Floats
    limits: Floats
    routes: Floats
    members: tuple[tuple[int, ...], ...]
    earliest: Floats
    remaining: Floats
    toll: float = 0.0

    @classmethod
    def of(cls, network: Network) -> Roads:
        """All legs with a window in some budget."""
        problem = network.problem
        limits = np.unique(problem.allowed) * _SAFE
        leg = problem.travel + problem.service
        through = network.earliest[:, None] + leg + network.remaining
        unused = ~(through <= limits[-1] * _SAFE)
        np.fill_diagonal(unused, True)
        unused[:, 0] = unused[-1] = True
        return cls(
            problem,
            np.where(unused, np.inf, leg),
            limits,
            network.routes,
            network.members,
            network.earliest,
            network.remaining,
        )

    @property
    def profit(self) -> Floats:
        """Data of every vertex, shape (n + 2,)."""
        return self.problem.profit

    @property
    def must_detour(self) -> bool:
        """Whether the direct leg is too long for some AUV, so that it needs a node."""
        return bool(self.leg[0, -1] > self.limits[0])

    @property
    def refund(self) -> float:
        """What the time of the whole fleet costs: no plan pays more toll than that."""
        return self.toll * float(self.routes @ self.limits)

    def worth(self, route: tuple[int, ...]) -> float:
        """Data of a route less its toll."""
        data = float(self.profit[list(route)].sum())
        return data - self.toll * self.duration(route) if self.toll else data

    def without(self, legs: Booleans) -> Roads:
        """The roads without some legs, shape (n + 2, n + 2)."""
        return replace(self, leg=np.where(legs, np.inf, self.leg))

    def duration(self, route: tuple[int, ...]) -> float:
        """Time of a route in seconds; infinite if it takes a leg that is no road."""
        stops = np.array([0, *route, len(self.leg) - 1])
        return float(self.leg[stops[:-1], stops[1:]].sum())

    def class_of(self, duration: float) -> int:
        """The first class with time for a route of that duration; C if there is none."""
        return int(np.searchsorted(self.limits, duration))

    def worth_a_visit(self, gain: Floats) -> Ints:
        """Vertices that a most valuable route may need, ascending, both ends included.

        A node that gains nothing is left out if going past it is possible and no slower,
        whatever the nodes before and after.
        """
        finite = np.isfinite(self.leg)
        inside = np.asarray(finite.any(axis=0) & finite.any(axis=1))
        useless = inside & (gain <= 0.0)
        useless[[0, -1]] = False
        inside[[0, -1]] = True
        vertices = np.flatnonzero(inside)
        needed = ~_avoidable(
            self.leg, self.earliest, self.remaining, vertices, useless, self.limits[-1]
        )
        kept: Ints = vertices[needed[vertices]]
        return kept


def is_mirrored(leg: Floats) -> bool:
    """Whether a route takes as long in the opposite direction, from the other end."""
    other = np.arange(len(leg))
    other[[0, -1]] = other[[-1, 0]]
    return bool(np.array_equal(leg, leg[np.ix_(other, other)].T))


@kernel
def _avoidable(
    leg: Floats,
    earliest: Floats,
    remaining: Floats,
    vertices: Ints,
    useless: Booleans,
    horizon: float,
) -> Booleans:
    """Which useless nodes no route needs to get from one vertex to another."""
    avoidable: Booleans = useless.copy()
    for k in vertices:
        if not useless[k]:
            continue
        for i in vertices:
            if i == k or not leg[i, k] < np.inf:
                continue
            for j in vertices:
                if j in (i, k):
                    continue
                through = leg[i, k] + leg[k, j]
                in_time = earliest[i] + through + remaining[j] <= horizon
                if in_time and leg[i, j] > through + 1e-15 * horizon:
                    avoidable[k] = False
                    break
            if not avoidable[k]:
                break
    return avoidable
