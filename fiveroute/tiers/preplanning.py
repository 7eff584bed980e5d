"""Tier 1, the pre-planning tier: giant route, fleet size, sub-routes.

Lines 2 to 5 of Algorithm 1. The giant route R_0, one route through all nodes with no
regard to endurance (13), (14), tells how many AUVs the mission needs (17), and is cut
into as many sub-routes of equal time (18). The sub-routes are where the route tier starts.
There are several good giant routes, and several ways to measure evenness: every pair of
them is another start. The allocations that the paper compares
with (Voronoi, k-means, AHC) start from clusters instead.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, count, cycle, islice, repeat
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.heuristics.fleet_size import FleetEstimate, estimate_fleet_size
from fiveroute.heuristics.shortest_routes import is_proved_infeasible
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.problem import TeamOrienteering
from fiveroute.result import GiantRouteResult, Status, is_closed
from fiveroute.routes import Route

__all__ = ["Allocation", "Preplan", "allocations", "find_giant_route", "fleet_size_of", "preplan"]

Allocation = Literal["giant-route", "voronoi", "k-means", "ahc"]

Start = tuple[Route, ...]
"""One sub-route for every AUV, in time or not."""


_SHARE_OF_SEARCH = {False: 0.9, True: 0.3}
"""Share of the time limit for the search, without and with a proof after it."""


def find_giant_route(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    exact: bool = False,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> GiantRouteResult:
    """The giant route alone, line 2 of Algorithm 1.

    Parameters
    ----------
    problem
        The problem; its budgets play no part.
    limits
        When to stop; None leaves it to the search itself.
    exact
        Prove it optimal; otherwise it comes with the lower bound of Held and Karp.
    seed
        Seed of the random numbers.
    progress
        Called as the search goes on.
    """
    from fiveroute.heuristics.giant_route import giant_routes
    from fiveroute.models.giant_route import solve_giant_route
    from fiveroute.models.held_karp import giant_route_bound

    clock = (limits or Limits()).start()
    rng = np.random.default_rng(seed)
    share = _SHARE_OF_SEARCH[exact] * clock.limits.time
    route = giant_routes(problem, clock.limits.within(share), rng=rng, progress=progress)[0]
    if exact:
        return solve_giant_route(problem, clock.rest(), warm_start=route, progress=progress)
    duration = problem.duration(route)
    bound = min(giant_route_bound(problem, clock.rest()), duration)
    status = Status.OPTIMAL if is_closed(bound, duration) else Status.FEASIBLE
    return GiantRouteResult("genetic", status, route, duration, bound, clock.seconds)


@dataclass(frozen=True, slots=True, eq=False)
class Preplan:
    """What tier 1 knows before it shares the nodes out.

    Parameters
    ----------
    problem
        The problem, with the fleet that is stated or estimated.
    giant_routes
        Different giant routes, best first.
    estimate
        Size of the fleet by (17); None where the endurance is too short for an estimate.
    """

    problem: TeamOrienteering
    giant_routes: tuple[Route, ...]
    estimate: FleetEstimate | None


def preplan(
    instance: Instance,
    fleet_size: int | None = None,
    limits: Limits | None = None,
    *,
    travel: NDArray[np.float64] | None = None,
    rng: np.random.Generator,
) -> Preplan:
    """Giant routes and the size of the fleet, lines 2 to 4 of Algorithm 1.

    Parameters
    ----------
    instance
        The mission.
    fleet_size
        Number of AUVs; None takes that of the instance, or else the estimate: at least
        two, as the paper demands, but one where endurance is unlimited.
    limits
        When to stop; None leaves it to the search itself.
    travel
        Leg times in the ocean in seconds, see `Instance.problem`; None sails straight lines.
    rng
        Random numbers.

    Raises
    ------
    InputError
        If no size is stated, and the endurance is too short for an estimate; not where
        it is too short for any plan, which is for the caller to find.
    """
    from fiveroute.heuristics.giant_route import giant_routes

    stated = instance.fleet_size if fleet_size is None else fleet_size
    problem = instance.problem(1 if stated is None else stated, travel)  # line 1
    routes = giant_routes(problem, limits or Limits(), rng=rng)  # line 2
    least = 1 if instance.fleet.endurance is None else 2
    try:
        estimate = estimate_fleet_size(problem, routes[0], least=least)  # lines 3 and 4
    except InputError:
        if stated is None and not is_proved_infeasible(problem):
            raise
        return Preplan(problem, routes, None)
    if stated is None:
        problem = instance.problem(estimate.size, travel)
    return Preplan(problem, routes, estimate)


def fleet_size_of(
    instance: Instance,
    travel: NDArray[np.float64] | None = None,
    *,
    rng: np.random.Generator,
) -> int:
    """Number of AUVs that the instance states, or else the estimate of tier 1.

    Parameters
    ----------
    instance
        The mission.
    travel
        Leg times in the ocean in seconds, see `Instance.problem`; None sails straight lines.
    rng
        Random numbers.
    """
    stated = instance.fleet_size
    return (
        preplan(instance, travel=travel, rng=rng).problem.fleet_size if stated is None else stated
    )


def allocations(
    problem: TeamOrienteering,
    method: Allocation,
    most: int,
    *,
    giant_routes: Sequence[Route],
    points: NDArray[np.float64],
    rng: np.random.Generator,
) -> Iterator[Start]:
    """Up to `most` starts for the route tier, made as they are asked for.

    Parameters
    ----------
    problem
        The problem, with its fleet.
    method
        Where the sub-routes come from.
    most
        Largest number of starts. A single one is the method at its plainest: the best
        giant route in squares, the best of ten k-means runs, AHC with average linkage.
    giant_routes
        Giant routes, best first.
    points
        Positions of start, nodes and destination in metres, shape (n + 2, 2).
    rng
        Random numbers.
    """
    match method:
        case "giant-route":
            starts = _segmented(problem, giant_routes, math.ceil(most / 2), rng)
        case "voronoi" | "k-means" | "ahc":
            starts = _clustered(problem, method, points, rng)
    return (_matched(problem, start) for start in islice(starts, most))


def _segmented(
    problem: TeamOrienteering,
    giant_routes: Sequence[Route],
    most: int,
    rng: np.random.Generator,
) -> Iterator[Start]:
    """Cut the best giant routes, and various others if they are few, for two measures."""
    from fiveroute.heuristics.insertion_route import various_routes
    from fiveroute.models.segmentation import Balance, segment

    def cut(routes: Sequence[Route], balance: Balance) -> Iterator[Start]:
        return (segment(problem, route, problem.fleet_size, balance) for route in routes)

    best = tuple(giant_routes[:most])
    yield from cut(best, Balance.SQUARED)
    others = various_routes(problem, most - len(best), rng)
    yield from cut(others, Balance.SQUARED)
    yield from cut(best + others, Balance.MINMAX)


def _clustered(
    problem: TeamOrienteering,
    method: Literal["voronoi", "k-means", "ahc"],
    points: NDArray[np.float64],
    rng: np.random.Generator,
) -> Iterator[Start]:
    from fiveroute.heuristics.allocation import Linkage, hierarchical, k_means, sub_routes, voronoi

    size = problem.fleet_size
    match method:
        case "voronoi":
            clusters = (voronoi(points, size, rng) for _ in count())
        case "k-means":  # one good run, then as many different ones as are asked for
            clusters = (k_means(points, size, rng, runs) for runs in chain((10,), repeat(1)))
        case "ahc":
            linkages: tuple[Linkage, ...] = ("average", "ward")
            clusters = (hierarchical(points, size, linkage) for linkage in cycle(linkages))
    return (sub_routes(problem, sets) for sets in clusters)


def _matched(problem: TeamOrienteering, start: Start) -> Start:
    """The longest sub-route to the AUV of greatest endurance, and so on."""
    if problem.has_equal_budgets:
        return start
    longest = sorted(start, key=problem.duration, reverse=True)
    routes: list[Route] = [()] * len(start)
    for auv, route in zip(np.argsort(-problem.budgets, kind="stable"), longest, strict=True):
        routes[auv] = route
    return tuple(routes)
