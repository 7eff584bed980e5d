"""The giant route exactly: the shortest route from start to destination through all nodes.

    R_0 = argmin over routes of  sum over arcs (t_ij + t_j) x_ij        (13)
    subject to y_k = 1 for every node k, and (3) to (8) without (6)     (14)

It is a Hamiltonian path with fixed ends, and a tour where these coincide. Every node is
served once, so the services only add a constant. The proof goes in steps:

1. a good route by local search, or the caller's, sets the mark to beat;
2. the Held-Karp bound; its prices exclude most arcs from any better route;
3. the linear relaxation over the arcs that are left, with cuts (Dantzig, Fulkerson and
   Johnson 1954), and branch and bound.

Each bound is computed here by weak duality, not taken from a solver, and the clock may
stop the run at any step: the best route and the best bound so far are the answer.

References
----------
G. Dantzig, R. Fulkerson and S. Johnson, "Solution of a large-scale traveling-salesman
problem", Operations Research 2(4), 1954, doi 10.1287/opre.2.4.393.
M. Padberg and G. Rinaldi, "A branch-and-cut algorithm for the resolution of large-scale
symmetric traveling salesman problems", SIAM Review 33(1), 1991, doi 10.1137/1033004.
"""

from __future__ import annotations

from fiveroute.errors import InputError
from fiveroute.limits import Clock, Limits, Progress, ProgressCallback
from fiveroute.models.held_karp import HeldKarp, has_symmetric_nodes, held_karp, useful_links
from fiveroute.models.tour_branching import BranchAndCut, Incumbent
from fiveroute.models.tour_descent import good_route
from fiveroute.models.tour_relaxation import Links
from fiveroute.problem import TeamOrienteering
from fiveroute.result import PROOF_TOLERANCE, GiantRouteResult, Status
from fiveroute.routes import Route

__all__ = ["solve_giant_route"]

_METHOD = "branch-and-cut"

_MOST_LINKS = 200_000
"""Number of links left above which branch and cut is not begun."""


def solve_giant_route(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Route | None = None,
    progress: ProgressCallback | None = None,
) -> GiantRouteResult:
    """Find the giant route and prove it shortest, as far as the limits allow.

    Parameters
    ----------
    problem
        The problem; its budgets and profits play no part. Times may be asymmetric.
    limits
        When to stop. Without a time limit the run ends with a proof, but for problems so
        large or routes so poor that Held-Karp prices leave over 200,000 arcs.
    warm_start
        A route through all nodes; the answer is no longer than it.
    progress
        Called with the best duration and the bound, in seconds, as they change.

    Returns
    -------
    GiantRouteResult
        The best route, its duration, and a lower bound on the shortest one's.
    """
    limits = limits or Limits()
    clock = limits.start()
    if warm_start is not None and sorted(warm_start) != list(range(1, problem.n + 1)):
        raise InputError(
            "a giant route visits every node once", field="warm_start", value=warm_start
        )
    incumbent = Incumbent(problem, good_route(problem, clock, warm_start), limits.gap)

    def report(bound: float) -> None:
        if progress is not None:
            progress(Progress(clock.seconds, incumbent.duration, incumbent.proved(bound)))

    relaxed = held_karp(problem, clock)
    report(relaxed.bound)
    links = _links(problem, relaxed, incumbent, clock)
    if links is None:
        return _answer(incumbent, relaxed.bound, clock.seconds)
    search = BranchAndCut(links, incumbent, relaxed.bound, clock, report)
    search.run()
    return _answer(incumbent, search.bound, clock.seconds)


def _links(
    problem: TeamOrienteering, relaxed: HeldKarp, incumbent: Incumbent, clock: Clock
) -> Links | None:
    """What a route worth finding can use; None where there is nothing left to do or to try."""
    if relaxed.bound >= incumbent.cutoff or clock.expired:
        return None
    useful = useful_links(problem, relaxed, incumbent.cutoff, _MOST_LINKS)
    if useful is None:
        return None
    tails, heads = useful
    symmetric = has_symmetric_nodes(problem)
    return Links(tails, heads, problem.travel[tails, heads], problem.n, symmetric)


def _answer(incumbent: Incumbent, bound: float, seconds: float) -> GiantRouteResult:
    duration, proved = incumbent.duration, incumbent.proved(bound)
    closed = duration - proved <= PROOF_TOLERANCE * duration
    status = Status.OPTIMAL if closed else Status.FEASIBLE
    return GiantRouteResult(_METHOD, status, incumbent.route, duration, proved, seconds)
