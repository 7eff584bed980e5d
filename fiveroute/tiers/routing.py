"""Tier 2, the route tier: Algorithm 1 of the paper, from the sub-routes on.

The sub-routes of tier 1 may break the time limit, and none of them need be the best route
through its nodes. The operator T (20) improves one route after another, each over its own
and the idle nodes; then nodes that are still idle are picked up wherever they fit; and so
on, until neither changes anything. A change counts if it collects more data, or as much
in less time.

The paper leaves open which nodes T may visit. With its own nodes only (`literal`), and from
a single giant route, Algorithm 1 collects clearly less than the paper reports; with the
idle nodes besides, and from several starts of which the best is kept, it reaches the
published figures. docs/tiers.md has the numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from fiveroute.heuristics.pick_up import RouteDuration, insertions, pick_up, trim
from fiveroute.heuristics.sggarp import Genetics, optimise_route
from fiveroute.heuristics.shortest_routes import shortest_routes
from fiveroute.limits import Clock, Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan, Route
from fiveroute.sampling import SampledLegs

__all__ = ["RouteSearch", "Routing", "best_routing", "plan_routes"]


@dataclass(frozen=True, slots=True)
class RouteSearch:
    """How Algorithm 1 searches.

    Parameters
    ----------
    genetics
        Parameters of T; None leaves it out, where routes are too long for it.
    offered
        Largest number of idle nodes that T considers for one AUV: those of greatest psi.
    literal
        Let T visit the nodes of an AUV's own sub-route only, and no idle ones.
    sampled
        Sampled leg times; routes must then be in time by their statistic as well.
    """

    genetics: Genetics | None = field(default_factory=Genetics)
    offered: int = 100
    literal: bool = False
    sampled: SampledLegs | None = None


@dataclass(frozen=True, slots=True)
class Routing:
    """What the route tier did; its stages are the three pictures of the paper's Fig. 6.

    Parameters
    ----------
    sub_routes
        The sub-routes of tier 1, in time or not.
    trimmed
        The same after nodes were dropped until all were in time.
    plan
        The optimised routes.
    """

    sub_routes: tuple[Route, ...]
    trimmed: tuple[Route, ...]
    plan: Plan

    @property
    def dropped(self) -> frozenset[int]:
        """Nodes that trimming took out."""
        return Plan(self.sub_routes).visited - Plan(self.trimmed).visited


def plan_routes(
    problem: TeamOrienteering,
    sub_routes: Sequence[Route],
    search: RouteSearch = RouteSearch(),
    *,
    rng: np.random.Generator,
    clock: Clock | None = None,
) -> Routing | None:
    """Algorithm 1 from line 6 on, from one allocation.

    Parameters
    ----------
    problem
        The problem.
    sub_routes
        One route per AUV, disjoint, in time or not.
    search
        How to search.
    rng
        Random numbers.
    clock
        Ends the search early; no limit without one.

    Returns
    -------
    Routing
        The stages of the tier; None where no routes in time were found, which can only
        happen where the direct leg is too long for some AUV.
    """
    clock = clock or Limits().start()
    duration = _duration(problem, search.sampled)
    trimmed = tuple(trim(problem, m, route, duration) for m, route in enumerate(sub_routes))
    routes = trimmed if _are_in_time(problem, trimmed) else shortest_routes(problem)  # line 6
    if routes is None:
        return None
    settled: dict[int, tuple[Route, Route]] = {}
    improved = True
    while improved:  # line 7
        before = routes
        for m in range(problem.fleet_size):  # line 8
            idle = _idle(problem, routes, m, search, sub_routes[m])
            if search.genetics is None or settled.get(m) == (routes[m], idle):
                continue
            better = optimise_route(
                problem,
                m,
                routes[m],
                idle,
                rng=rng,
                sampled=search.sampled,
                genetics=search.genetics,
                clock=clock,
            )
            better = trim(problem, m, better, duration)
            if _improves(problem, better, routes[m]):
                routes = (*routes[:m], better, *routes[m + 1 :])
            settled[m] = routes[m], idle
        routes = pick_up(problem, routes, duration, clock)  # lines 9 to 13
        improved = routes != before and not clock.expired
    return Routing(tuple(sub_routes), trimmed, Plan(routes))


def best_routing(
    problem: TeamOrienteering,
    starts: Iterable[Sequence[Route]],
    search: RouteSearch = RouteSearch(),
    *,
    rng: np.random.Generator,
    clock: Clock | None = None,
) -> Routing | None:
    """Algorithm 1 from several allocations, and the outcome that collects most.

    Parameters
    ----------
    starts
        Allocations, one at least; those that time does not suffice for are left out.
    """
    clock = clock or Limits().start()
    best: Routing | None = None
    for sub_routes in starts:
        routing = plan_routes(problem, sub_routes, search, rng=rng, clock=clock)
        if routing is None:
            return None
        if best is None or _value(problem, routing.plan) > _value(problem, best.plan):
            best = routing
        if clock.expired:
            break
    return best


def _value(problem: TeamOrienteering, plan: Plan) -> tuple[float, float]:
    """Data, and of equal data the shorter time: what plans are compared by."""
    return plan.objective(problem), -sum(plan.durations(problem))


def _improves(problem: TeamOrienteering, new: Route, old: Route) -> bool:
    """Whether a route collects more than another, or as much in less time."""
    gain = problem.collected(new) - problem.collected(old)
    if abs(gain) > 1e-9 * problem.total_profit:
        return gain > 0.0
    return problem.duration(new) < problem.duration(old) * (1.0 - 1e-9)


def _duration(problem: TeamOrienteering, sampled: SampledLegs | None) -> RouteDuration:
    """What must keep within the budget: the planned time, and the sampled one if there is one."""
    if sampled is None:
        return problem.duration

    def longest(route: Sequence[int]) -> float:
        return max(problem.duration(route), sampled.duration(problem.service, route))

    return longest


def _are_in_time(problem: TeamOrienteering, routes: Sequence[Route]) -> bool:
    durations = np.array([problem.duration(route) for route in routes])
    return bool((durations <= problem.allowed).all())


def _idle(
    problem: TeamOrienteering,
    routes: Sequence[Route],
    auv: int,
    search: RouteSearch,
    own: Route,
) -> Route:
    """The idle nodes that T may visit: all of the sub-route, or those of greatest psi."""
    visited = {node for route in routes for node in route}
    pool = own if search.literal else range(1, problem.n + 1)
    idle = np.array(sorted(set(pool) - visited), dtype=np.int64)
    if len(idle) > search.offered and not search.literal:
        psi, _, _ = insertions(problem, routes[auv], idle)
        idle = np.sort(idle[np.argsort(-psi, kind="stable")[: search.offered]])
    return tuple(idle.tolist())
