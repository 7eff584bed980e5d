"""A whole mission planned: the tiers of the paper put together.

This is where to start reading. `plan_mission` goes through the paper's steps one by one,
and every step is a function that can be called alone: the giant route and the estimate of
the fleet (tier 1), the sub-routes and Algorithm 1 (tiers 1 and 2). What the paper does not
have comes last: a search over the whole fleet, and a bound that says how far the plan is
from optimal.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Integral
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.heuristics.shortest_routes import is_proved_infeasible
from fiveroute.instance import Instance
from fiveroute.limits import Clock, Limits, Progress, ProgressCallback
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route
from fiveroute.sampling import RouteStatistic, SampledLegs, sample_legs
from fiveroute.tiers.effort import effort_for
from fiveroute.tiers.preplanning import Allocation, allocations, preplan
from fiveroute.tiers.routing import Routing, best_routing

__all__ = ["Bounding", "MissionPlan", "Search", "plan_mission", "require_options"]

Search = Literal["fleet", "paper"]
"""``paper``: Algorithm 1; ``fleet``: Algorithm 1, then a search over the whole fleet."""

Bounding = Literal["none", "quick", "exact"]
"""Where the upper bound comes from. ``exact`` goes on to a proof, ``quick`` ends after a second or
two for 60 nodes. Both may improve the plan; ``quick`` leaves one of Algorithm 1 alone."""

_END_OF_GIANT_ROUTE = {"fleet": 0.08, "paper": 0.3}
_END_OF_ROUTES = {"fleet": 0.2, "paper": 1.0}
_END_OF_PLAN = {"none": 1.0, "quick": 0.85, "exact": 0.5}
"""Shares of a time limit: of the whole for the plan, and of that for its first two steps."""

_QUICK_WORK, _QUICKLY_PRICED = 80, 100
"""Work of a quick bound by column generation for every leg, and the nodes up to which it pays."""

_MOST_SAMPLED_LEGS = 200_000_000


@dataclass(frozen=True, slots=True, eq=False)
class MissionPlan:
    """A plan and how it came about.

    Parameters
    ----------
    instance
        The mission.
    problem
        The problem it was turned into, with the fleet that is sent.
    result
        The plan, its data, and what is known about the optimum.
    giant_route
        The best giant route R_0.
    giant_route_duration
        Its duration T_0 in seconds.
    fleet_estimate
        M by (17) before rounding; None where the endurance is too short for an estimate.
    routing
        The stages of Algorithm 1; None where no AUV can make it to the destination in time.
    allocation, search
        As they were asked for.
    """

    instance: Instance
    problem: TeamOrienteering
    result: Result
    giant_route: Route
    giant_route_duration: float
    fleet_estimate: float | None
    routing: Routing | None
    allocation: Allocation
    search: Search

    @property
    def segments(self) -> tuple[Route, ...]:
        """The sub-routes, one per AUV, that Algorithm 1 made its routes of."""
        return () if self.routing is None else self.routing.sub_routes


def plan_mission(
    instance: Instance,
    *,
    travel: NDArray[np.float64] | None = None,
    fleet_size: int | None = None,
    allocation: Allocation = "giant-route",
    search: Search = "fleet",
    bound: Bounding = "none",
    literal: bool = False,
    samples: int = 0,
    quantile: float | None = None,
    limits: Limits | None = None,
    seed: int = 0,
    workers: int = 1,
    progress: ProgressCallback | None = None,
) -> MissionPlan:
    """Plan a mission: how many AUVs, and the route of each.

    Parameters
    ----------
    instance
        The mission.
    travel
        Leg times in its ocean in seconds, shape (n + 2, n + 2), from tier 3, see
        `fiveroute.tiers.pathing`; None sails straight lines in still water.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it.
    allocation
        How the nodes are first shared out.
    search
        How far to search.
    bound
        Where the upper bound comes from.
    literal
        Take Algorithm 1 to the letter: one start, and every AUV keeps to its own nodes.
    samples
        Number of sampled leg times to plan with (S-GGARP); 0 plans with the planned ones
        (GGA). Only for the search ``paper``.
    quantile
        Quantile of the sampled durations that must be in time; None takes their mean.
    limits
        When to stop. Without a time limit every search ends by itself.
    seed
        Seed of the random numbers; without a time limit it determines the plan.
    workers
        Number of threads of the fleet search; the plan does not depend on it.
    progress
        Called as the work goes on.

    Raises
    ------
    InputError
        If there is no such option, the options contradict each other, or no fleet size is stated
        and none can be estimated.
    """
    require_options(search, bound, allocation, samples, quantile, seed, workers)
    steps = _Steps((limits or Limits()).start(), _END_OF_PLAN[bound], progress)
    for_tours, for_starts, for_routes, for_fleet = np.random.default_rng(seed).spawn(4)

    # Tier 1: a giant route, and from it the size of the fleet.
    until = steps.begin("giant route", _END_OF_GIANT_ROUTE[search])
    tier1 = preplan(instance, fleet_size, until, travel=travel, rng=for_tours)
    problem, routing = tier1.problem, None
    if is_proved_infeasible(problem):
        result = Result.infeasible(method=search, seconds=steps.clock.seconds)
    else:
        # Tiers 1 and 2: sub-routes, and Algorithm 1 from several of them.
        until = steps.begin("routes", _END_OF_ROUTES[search])
        effort = effort_for(problem.n, problem.fleet_size)
        starts = allocations(
            problem,
            allocation,
            1 if literal else effort.starts,
            giant_routes=tier1.giant_routes,
            points=instance.points,
            rng=for_starts,
        )
        sampled = _sampled(instance, problem.travel, samples, quantile, for_routes)
        how = replace(effort.search, literal=literal, sampled=sampled)
        routing = best_routing(problem, starts, how, rng=for_routes, clock=until.start())
        plan = None if routing is None else routing.plan
        known: list[Route] = []

        # Beyond the paper: the whole fleet at once, and how far it may be from optimal.
        if search == "fleet" and plan is not None and not steps.clock.expired:
            until = steps.begin("fleet search", 1.0, plan.objective(problem))
            plan = fleet_search(
                problem,
                until,
                rng=for_fleet,
                warm_start=plan,
                enough=_least_bound(problem) if bound != "none" else math.inf,
                workers=workers,
                progress=steps.relay,
                remember=known.extend,
            )
        result = _with_bound(problem, plan, known, bound, steps, fixed=search == "paper")
    return MissionPlan(
        instance,
        problem,
        replace(result, method=search, seed=seed),
        tier1.giant_routes[0],
        problem.duration(tier1.giant_routes[0]),
        None if tier1.estimate is None else tier1.estimate.value,
        routing,
        allocation,
        search,
    )


def require_options(
    search: str,
    bound: str,
    allocation: str,
    samples: int,
    quantile: float | None,
    seed: int,
    workers: int,
) -> None:
    """Refuse options of `plan_mission` that do not exist or contradict each other."""
    for field, value, names in (
        ("search", search, get_args(Search)),
        ("allocation", allocation, get_args(Allocation)),
        ("bound", bound, get_args(Bounding)),
    ):
        if value not in names:
            raise InputError(f"take one of {', '.join(names)}", field=field, value=value)
    _require_whole(workers, "workers", least=1)
    _require_whole(seed, "seed", least=0)
    if samples and search != "paper":
        raise InputError("samples are for the search 'paper' only", field="search", value=search)
    if quantile is not None and not samples:
        raise InputError("a quantile needs samples; set their number as well", field="quantile")


def _require_whole(number: int, field: str, least: int) -> None:
    if not isinstance(number, Integral) or number < least:
        raise InputError(f"must be a whole number from {least} on", field=field, value=number)


@dataclass(frozen=True, slots=True)
class _Steps:
    """Shares the time limit out among the steps, and reports each of them.

    Parameters
    ----------
    clock
        The clock of the whole run.
    share
        Share of the time limit that is for the plan; the rest is for the bound.
    progress
        Called as the work goes on.
    """

    clock: Clock
    share: float
    progress: ProgressCallback | None

    def begin(self, name: str, end: float, objective: float | None = None) -> Limits:
        """Limits for a step that must be over at the share `end` of the time for the plan.

        It is reported with the objective of the plan that it begins with.
        """
        self.relay(Progress(0.0, objective, message=name))
        limits = self.clock.limits
        return limits.within(limits.time * self.share * end - self.clock.seconds)

    def relay(self, progress: Progress) -> None:
        """Pass a step's progress on, timed by the clock of the whole run."""
        if self.progress is not None:
            self.progress(replace(progress, seconds=self.clock.seconds))


def _sampled(
    instance: Instance,
    travel: NDArray[np.float64],
    samples: int,
    quantile: float | None,
    rng: np.random.Generator,
) -> SampledLegs | None:
    """Draw the leg times for S-GGARP; None for planned times."""
    if not samples:
        return None
    if samples * travel.size > _MOST_SAMPLED_LEGS:
        raise InputError(
            f"so many samples of {travel.size} legs do not fit into memory; take fewer samples",
            field="samples",
            value=samples,
        )
    legs = sample_legs(travel, instance.lengths_km, instance.uncertainty, samples, rng)
    return SampledLegs(legs, RouteStatistic(quantile))


def _least_bound(problem: TeamOrienteering) -> float:
    """The bound that costs least; a plan that reaches it needs no further search."""
    from fiveroute.models.bounds import Effort, quick_bound

    return quick_bound(problem, effort=Effort.LEAST).value


def _with_bound(
    problem: TeamOrienteering,
    plan: Plan | None,
    routes: Sequence[Route],
    bound: Bounding,
    steps: _Steps,
    *,
    fixed: bool,
) -> Result:
    """The plan, or a better one that came with the bound on what any plan can collect.

    A quick bound leaves a fixed plan as it is, an exact one may not.
    """
    clock = steps.clock
    if bound == "none":
        return Result.judged(problem, plan, method=bound, seconds=clock.seconds)
    steps.begin("bound", 1.0, None if plan is None else plan.objective(problem))
    if bound == "quick" and problem.n > _QUICKLY_PRICED:
        from fiveroute.models.bounds import quick_bound

        best = quick_bound(problem, clock.rest()).value
        return Result.judged(problem, plan, method=bound, seconds=clock.seconds, bound=best)
    from fiveroute.models import solve

    limits, method = clock.rest(), "auto"
    if bound == "quick":
        limits, method = replace(limits, work=_QUICK_WORK * problem.n**2), "branch-price"
    result = solve(problem, method, limits, warm_start=plan, routes=routes, progress=steps.relay)
    if fixed and bound == "quick":
        result = Result.judged(problem, plan, method=bound, seconds=0.0, bound=result.bound)
    return replace(result, seconds=clock.seconds)
