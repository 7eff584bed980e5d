"""With which routes a fleet sets out, whoever is to steer it.

A plan that is tight by planned times is too long on average, since manoeuvres only ever take
time, and what does not fit is discarded under way, where nothing better can replace it. So a
plan for an uncertain ocean takes slack: all legs are longer by a factor. It also does well to end
near the destination, since the long last leg of an AUV needs a long reserve: legs to the
destination take `home` standard deviations more. How much of both is best depends on the mission,
so several plans are made.

Of these, planners without recourse take by rehearsal: each plan is sailed with the same luck by
whoever will steer, and the one that collects most is taken. The luck of the rehearsals is not
that of the simulation. The five-tiered planner can leave nodes out and take idle ones in, and
what its courses are worth is known without sailing (`fiveroute.sea.courses.recourse`): from each
plan a search goes on for the courses that are worth most, nodes to be visited with luck included.

The planners that the paper compares with plan in their own ways, clusters by k-means or Voronoi
cells and routes through them, and rehearse like the others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from fiveroute.heuristics.allocation import k_means, sub_routes, voronoi
from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.heuristics.pick_up import trim
from fiveroute.heuristics.sggarp import optimise_route
from fiveroute.heuristics.shortest_routes import shortest_routes
from fiveroute.limits import Clock, Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.option_search import best_options
from fiveroute.sea.courses.recourse import reconsider, with_recourse
from fiveroute.sea.seeds import REHEARSALS, Purpose, generator
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World
from fiveroute.tiers.actuation import expected_legs

__all__ = ["CAUTIONS", "departure_plan", "rehearse"]

CAUTIONS = ((1.0, 2.0), (1.0, 3.0), (1.0, 5.0), (1.05, 2.0), (1.05, 3.0), (1.05, 5.0))
"""Pairs of slack and `home` that plans are made with."""

_SLACKS = (1.0, 1.04, 1.08, 1.12)
_TRIALS = 30_000  # of the fleet search, for a plan
_OPTION_TRIALS = 8_000  # of the search for options, for a plan


def departure_plan(
    world: World,
    planner: str = "five-tier",
    *,
    reserve: float = 1.645,
    runs: int = 20,
    seed: int = 0,
    limits: Limits | None = None,
) -> Plan:
    """The plan that a fleet sets out with: the best of several, by what it is worth at sea.

    Parameters
    ----------
    world
        The mission.
    planner
        Who will steer, see `fiveroute.sea.simulation.PLANNERS`.
    reserve
        Standard deviations of the remaining time that will be kept in hand.
    runs
        Rehearsals of every plan; the five-tiered planner needs none.
    seed
        Seed of the random numbers.
    limits
        When to stop; the best plan so far is returned.
    """
    clock = (limits or Limits()).start()
    rng = generator(Purpose.DEPARTURE, seed)
    plans: list[Plan] = []
    for plan in _plans(world, planner, seed, rng):
        plans.append(plan)
        if clock.expired:
            break
    if planner == "five-tier":
        return _with_options(world, plans, reserve, rng, clock)
    return rehearse(world, plans, planner, reserve=reserve, runs=runs, seed=seed, clock=clock)


def rehearse(
    world: World,
    plans: Sequence[Plan],
    planner: str,
    *,
    reserve: float = 1.645,
    runs: int = 20,
    seed: int = 0,
    clock: Clock | None = None,
) -> Plan:
    """The plan that collects most on average, all of them sailed with the same luck.

    Parameters
    ----------
    plans
        Plans, one at least.
    clock
        Ends the rehearsals early; no limit without one.
    """
    best, most = plans[0], -1.0
    for plan in plans:
        if clock is not None and clock.expired:
            break
        luck = seed + REHEARSALS
        result = simulate_fleet(
            world, plan, planner=planner, runs=runs, reserve=reserve, seed=luck, log=False
        )
        if result.completions.mean() > most:
            best, most = plan, float(result.completions.mean())
    return best


def _plans(world: World, planner: str, seed: int, rng: np.random.Generator) -> Iterator[Plan]:
    """The plans that are tried for a planner, made as they are asked for."""
    if planner in ("ftcmp", "rmmp"):  # the same clusters, whatever the slack
        for slack in _SLACKS:
            yield _cluster_plan(world, planner, slack, np.random.default_rng(seed))
    else:
        for slack, home in CAUTIONS:
            yield _cautious_plan(world, slack, home, rng)


def _cautious_plan(world: World, slack: float, home: float, rng: np.random.Generator) -> Plan:
    """The best plan for expected legs with slack, and long reserves for the way home."""
    mean, variance = expected_legs(world.law)
    legs = slack * mean
    legs[:, -1] += home * np.sqrt(variance[:, -1])
    known = world.problem
    problem = TeamOrienteering(legs, known.service, known.profit, known.budgets)
    if shortest_routes(problem) is None:
        return Plan.empty(known.fleet_size)
    return fleet_search(problem, rng=rng, iterations=_TRIALS)


def _with_options(
    world: World, plans: Sequence[Plan], reserve: float, rng: np.random.Generator, clock: Clock
) -> Plan:
    """What is expected of the courses that are worth most, options included, near any plan."""
    view = with_recourse(world.outlook(reserve))
    budgets = world.problem.budgets
    found = [best_options(view, plan.routes, budgets, _OPTION_TRIALS, rng, clock) for plan in plans]
    options, _ = max(found, key=lambda pair: pair[1])
    courses = [Course(0, 0.0, 0.0, t, r) for t, r in zip(budgets.tolist(), options, strict=True)]
    return Plan(tuple(reconsider(view, course, ())[0].route for course in courses))


def _cluster_plan(world: World, planner: str, slack: float, rng: np.random.Generator) -> Plan:
    """Clusters by k-means with the best route over each, or Voronoi cells with a short one."""
    known, points = world.problem, world.points
    problem = TeamOrienteering(slack * known.travel, known.service, known.profit, known.budgets)
    if planner == "rmmp":
        cells = voronoi(points, known.fleet_size, rng, "lloyd")
        routes = sub_routes(problem, cells)
        return Plan(tuple(trim(problem, auv, route) for auv, route in enumerate(routes)))
    clusters = k_means(points, known.fleet_size, rng)
    short = [trim(problem, auv, r) for auv, r in enumerate(sub_routes(problem, clusters))]
    return Plan(
        tuple(
            optimise_route(problem, auv, route, clusters[auv], rng=rng)
            for auv, route in enumerate(short)
        )
    )
