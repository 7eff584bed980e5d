"""The paper's Section IV-B: planning in deterministic environments.

On every scenario the giant route gives the number of AUVs M. Then the giant-route method
is compared with Voronoi cells, k-means and hierarchical clustering, with the same M (32)
and with M = 4 for the other three (33), by the completion rate theta (31) that each
expects. Three things go beyond the paper: the best plan known and a proven bound for every
scenario; the ablation in which every allocation gets the same number of starts and the
same exchange of idle nodes; and the shortest giant route, proved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from fiveroute.generate import paper_scenario
from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.heuristics.fleet_size import estimate_fleet_size
from fiveroute.heuristics.giant_route import giant_routes
from fiveroute.instance import Instance
from fiveroute.limits import Limits
from fiveroute.models.bounds import quick_bound
from fiveroute.models.giant_route import solve_giant_route
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan, Route
from fiveroute.tiers.preplanning import Allocation, allocations
from fiveroute.tiers.routing import RouteSearch, Routing, best_routing

__all__ = ["METHODS", "STARTS", "Method", "Scenario", "run_scenarios"]

STARTS = 16
"""Starts of the giant-route method, and of all methods in the ablation."""


@dataclass(frozen=True, slots=True)
class Method:
    """A way to allocate nodes, and how far its routes are adjusted afterwards.

    Parameters
    ----------
    allocation
        Where the sub-routes come from.
    fleet_size
        Number of AUVs; None takes the estimate from the giant route.
    starts
        Number of allocations tried, of which the best is kept.
    exchange
        Whether an AUV may exchange its nodes for idle ones; otherwise it keeps to its own,
        and idle nodes are only added where they fit, Algorithm 1 taken literally.
    """

    allocation: Allocation
    fleet_size: int | None = None
    starts: int = 1
    exchange: bool = False


METHODS: Mapping[str, Method] = {
    "giant-route": Method("giant-route", starts=STARTS, exchange=True),
    "voronoi": Method("voronoi"),
    "k-means": Method("k-means"),
    "ahc": Method("ahc"),
    "voronoi, M = 4": Method("voronoi", fleet_size=4),
    "k-means, M = 4": Method("k-means", fleet_size=4),
    "ahc, M = 4": Method("ahc", fleet_size=4),
    "giant-route, single pass": Method("giant-route"),
    "giant-route, one start": Method("giant-route", exchange=True),
    "voronoi, one start": Method("voronoi", exchange=True),
    "k-means, one start": Method("k-means", exchange=True),
    "ahc, one start": Method("ahc", exchange=True),
    "voronoi, same effort": Method("voronoi", starts=STARTS, exchange=True),
    "k-means, same effort": Method("k-means", starts=STARTS, exchange=True),
    "ahc, same effort": Method("ahc", starts=STARTS, exchange=True),
}
"""All methods by name. The first four are the paper's Fig. 7, the next three (with the
first) its Fig. 8, the rest is the ablation."""


@dataclass(frozen=True, slots=True, eq=False)
class Scenario:
    """What came out on one scenario.

    Parameters
    ----------
    instance
        The scenario.
    giant_route
        The best giant route.
    giant_route_duration
        T_0 in seconds.
    giant_route_bound
        Proven lower bound on T_0 in seconds.
    fleet_estimate, fleet_size
        M by (17), before and after rounding.
    completion
        Expected completion rate of every method, by its name.
    routing
        The stages of the giant-route method, for the picture.
    best
        Completion rate of the best plan known with `fleet_size` AUVs.
    bound
        Proven upper bound on that rate.
    """

    instance: Instance
    giant_route: Route
    giant_route_duration: float
    giant_route_bound: float
    fleet_estimate: float
    fleet_size: int
    completion: Mapping[str, float]
    routing: Routing
    best: float
    bound: float


def run_scenarios(
    count: int, seed: int, tell: Callable[[str], None] = lambda _: None
) -> Iterator[Scenario]:
    """Run all methods on the scenarios 1 to `count`, one after the other.

    Parameters
    ----------
    count
        Number of scenarios.
    seed
        Seed of the methods; every scenario and method has its own stream.
    tell
        Is told what is done next.
    """
    for number in range(1, count + 1):
        tell(f"scenario {number} of {count}")
        yield _run(paper_scenario(number), np.random.default_rng([seed, number]))


def _run(instance: Instance, rng: np.random.Generator) -> Scenario:
    single = instance.problem(1)
    routes = giant_routes(single, rng=rng)
    proof = solve_giant_route(single, Limits(time=10.0), warm_start=routes[0])
    estimate = estimate_fleet_size(single, routes[0])
    problem = instance.problem(estimate.size)
    outcomes = {
        name: _plan(instance, method, estimate.size, routes, stream)
        for (name, method), stream in zip(METHODS.items(), rng.spawn(len(METHODS)), strict=True)
    }
    completion = {
        name: routing.plan.objective(problem) / problem.total_profit
        for name, routing in outcomes.items()
    }
    same_fleet = [name for name, method in METHODS.items() if method.fleet_size is None]
    leader = outcomes[max(same_fleet, key=lambda name: completion[name])].plan
    best = fleet_search(problem, rng=rng, warm_start=leader)
    return Scenario(
        instance=instance,
        giant_route=routes[0],
        giant_route_duration=single.duration(routes[0]),
        giant_route_bound=proof.bound or 0.0,
        fleet_estimate=estimate.value,
        fleet_size=estimate.size,
        completion=completion,
        routing=outcomes["giant-route"],
        best=best.objective(problem) / problem.total_profit,
        bound=_bound(problem, best) / problem.total_profit,
    )


def _plan(
    instance: Instance,
    method: Method,
    estimated: int,
    routes: tuple[Route, ...],
    rng: np.random.Generator,
) -> Routing:
    """One method on one scenario: tier 1's allocation, then tier 2."""
    problem = instance.problem(method.fleet_size or estimated)
    starts = allocations(
        problem,
        method.allocation,
        method.starts,
        giant_routes=routes,
        points=instance.points,
        rng=rng,
    )
    search = RouteSearch(literal=not method.exchange)
    routing = best_routing(problem, starts, search, rng=rng)
    assert routing is not None, "the paper's fleet has time for the direct leg"
    return routing


def _bound(problem: TeamOrienteering, plan: Plan) -> float:
    return max(quick_bound(problem).value, plan.objective(problem))
