"""Brute force: every set of nodes, every way to share the nodes out. The tests' truth.

For every set S of nodes and every last node k in it, the least duration of a route from
the start through S to k is (Bellman 1962; Held and Karp 1962)

    d(S, k) = min over i in S - {k} of d(S - {k}, i) + t_ik + s_k,    d({k}, k) = t_0k + s_k,

and with the leg to the destination it gives the quickest route through S. An AUV can take
exactly the sets whose quickest route fits its budget; a set may not fit although a larger
one does, since nothing is assumed about the triangle inequality. The best data from the
first m AUVs within the nodes S is

    f_m(S) = max over R subset of S that AUV m can take of rho(R) + f_(m-1)(S - R),    f_0 = 0.

Sets are bit masks, node k being bit k - 1. It is meant to be read, not to be fast: 9 nodes
take some tenths of a second.

References
----------
R. Bellman, "Dynamic programming treatment of the travelling salesman problem", Journal of
the ACM 9 (1962), doi 10.1145/321105.321111.
M. Held and R. M. Karp, "A dynamic programming approach to sequencing problems", Journal of
the SIAM 10 (1962), doi 10.1137/0110015.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from fiveroute.errors import InputError
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.incumbent import Incumbent
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["MOST_NODES", "solve", "supports"]

MOST_NODES = 9
"""Largest number of sensor nodes that brute force accepts."""

Share = list[tuple[float, int]]
"""f_m(S) and the maximising R for every S, both sets by bit mask."""


def supports(problem: TeamOrienteering) -> bool:
    """Whether the problem is small enough."""
    return problem.n <= MOST_NODES


def solve(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Plan | None = None,
    progress: ProgressCallback | None = None,
) -> Result:
    """Best plan of all.

    Parameters
    ----------
    problem
        The problem, with at most `MOST_NODES` sensor nodes.
    limits
        When to stop.
    warm_start
        A plan to fall back on when stopped.
    progress
        Told of the answer.

    Raises
    ------
    InputError
        If there are too many nodes.
    """
    if not supports(problem):
        raise InputError(
            f"brute force takes at most {MOST_NODES} nodes; use another method",
            field="nodes",
            value=problem.n,
        )
    answer = Incumbent(problem, "brute-force", limits, warm_start=warm_start, progress=progress)
    quickest = quickest_routes(problem)
    data = [problem.collected(list(_members(nodes))) for nodes in range(len(quickest))]
    shares: list[Share] = [[(0.0, 0)] * len(quickest)]
    for budget in problem.allowed:
        if answer.clock.expired:
            return answer.result()
        fits = [problem.duration(route) <= budget for route in quickest]
        shares.append(_share_out(data, fits, shares[-1]))
    best, _ = shares[-1][-1]
    if best == -math.inf:
        return answer.infeasible()
    answer.offer(_plan(shares, quickest))
    answer.lower(best)
    return answer.result()


def quickest_routes(problem: TeamOrienteering) -> list[Route]:
    """The quickest route through every set of nodes, by bit mask."""
    travel, service = problem.travel.tolist(), problem.service.tolist()
    partial: dict[tuple[int, int], tuple[float, Route]] = {}
    quickest: list[Route] = [()]
    for nodes in range(1, 1 << problem.n):
        for k in _members(nodes):
            before = nodes & ~(1 << (k - 1))
            partial[nodes, k] = min(
                (
                    (duration + travel[i][k] + service[k], (*route, k))
                    for i in _members(before)
                    for duration, route in [partial[before, i]]
                ),
                default=(travel[0][k] + service[k], (k,)),
            )
        ends = (
            (duration + travel[k][-1], route)
            for k in _members(nodes)
            for duration, route in [partial[nodes, k]]
        )
        quickest.append(min(ends)[1])
    return quickest


def _share_out(data: list[float], fits: list[bool], before: Share) -> Share:
    """f_m from f_(m-1); minus infinity where the AUV can take no set at all."""
    return [
        max(
            (
                (data[part] + before[nodes - part][0], part)
                for part in _subsets(nodes)
                if fits[part]
            ),
            default=(-math.inf, 0),
        )
        for nodes in range(len(data))
    ]


def _plan(shares: list[Share], quickest: list[Route]) -> Plan:
    """Follow the maximisers back from the last AUV and all nodes."""
    left = len(quickest) - 1
    routes = []
    for share in reversed(shares[1:]):
        _, part = share[left]
        routes.append(quickest[part])
        left -= part
    return Plan(tuple(reversed(routes)))


def _members(nodes: int) -> Iterator[int]:
    """Nodes of a set, ascending."""
    return (k + 1 for k in range(nodes.bit_length()) if nodes >> k & 1)


def _subsets(nodes: int) -> Iterator[int]:
    """All subsets of a set, itself and the empty one included."""
    part = nodes
    while True:
        yield part
        if part == 0:
            return
        part = (part - 1) & nodes
