"""With which routes a fleet sets out, whoever is to steer it.

A plan that is tight by planned times is too long on average, since manoeuvres only ever take
time, and whatever does not fit is discarded under way, where it can no longer be replaced by
something better. So planning costs are inflated: all legs by a factor, the slack. The planners that
the paper compares with plan by the same legs, but in their own ways: clusters by k-means and a
route through each, or Voronoi cells and short routes through them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.heuristics.allocation import k_means, sub_routes, voronoi
from fiveroute.heuristics.pick_up import trim
from fiveroute.heuristics.sggarp import optimise_route
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import plan_mission
from fiveroute.plan import Plan
from fiveroute.problem import TeamOrienteering
from fiveroute.tiers.preplanning import preplan

__all__ = ["SLACK", "departure_plan"]

SLACK = 1.08
"""Default slack: the mean leg with its manoeuvres, and two per cent for the rest."""


def departure_plan(
    instance: Instance,
    planner: str = "five-tier",
    *,
    fleet_size: int | None = None,
    travel: NDArray[np.float64] | None = None,
    slack: float = SLACK,
    seed: int = 0,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> Plan:
    """Plan for a fleet that is to sail in an uncertain ocean.

    Parameters
    ----------
    instance
        The mission.
    planner
        Who will steer, see `fiveroute.sea.simulation.PLANNERS`.
    fleet_size
        Number of AUVs; None takes that of the instance, or else the estimate of tier 1, by
        legs without slack.
    travel
        Planned leg times in seconds, shape (n + 2, n + 2); None sails straight lines.
    slack
        Factor by which planning costs are inflated, at least 1.
    seed
        Seed of the random numbers.
    limits
        When to stop.
    progress
        Called as the work goes on.
    """
    if not 1.0 <= slack < np.inf:
        raise InputError("must be finite and at least 1", field="slack", value=slack)
    legs = instance.travel if travel is None else travel
    if fleet_size is None:
        rng = np.random.default_rng(seed)
        fleet_size = preplan(instance, None, travel=travel, rng=rng).problem.fleet_size
    if planner in ("ftcmp", "rmmp"):
        problem = instance.problem(fleet_size, slack * legs)
        rng = np.random.default_rng(seed)
        make = _clusters if planner == "ftcmp" else _cells
        return make(problem, instance.points, rng)
    mission = plan_mission(
        instance,
        travel=slack * legs,
        fleet_size=fleet_size,
        limits=limits,
        seed=seed,
        progress=progress,
    )
    return mission.result.plan or Plan.empty(fleet_size)


def _clusters(
    problem: TeamOrienteering, points: NDArray[np.float64], rng: np.random.Generator
) -> Plan:
    """Clusters by k-means, and the best route over the nodes of each."""
    routes = []
    for auv, nodes in enumerate(k_means(points, problem.fleet_size, rng)):
        short = trim(problem, auv, sub_routes(problem, [nodes])[0])
        routes.append(optimise_route(problem, auv, short, nodes, rng=rng))
    return Plan(tuple(routes))


def _cells(
    problem: TeamOrienteering, points: NDArray[np.float64], rng: np.random.Generator
) -> Plan:
    """Voronoi cells of settled sites, and a short route through each as far as time allows."""
    cells = sub_routes(problem, voronoi(points, problem.fleet_size, rng, "lloyd"))
    return Plan(tuple(trim(problem, auv, route) for auv, route in enumerate(cells)))
