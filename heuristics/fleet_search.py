"""The fleet-wide search: team orienteering over all AUVs and all nodes at once.

The paper improves one AUV's route after the other. Here any node may go to any AUV at any
time: routes are ruined by string removal and recreated by greedy insertion
(`fiveroute.heuristics.fleet`, after J. Christiaens and G. Vanden Berghe, Transportation
Science 54(2), 2020, doi 10.1287/trsc.2019.0914, made for routes that need not visit all),
under simulated annealing from hot to cold. Several such searches go on in parallel and
start anew, time after time, from the best combination of all their routes. Best means most
data J, equation (2), and among plans of equal J the least total time.

Times may be asymmetric and break the triangle inequality; budgets may differ.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.heuristics.fleet.archipelago import Archipelago
from fiveroute.heuristics.fleet.chains import build_chains
from fiveroute.heuristics.fleet.crew import crew
from fiveroute.heuristics.fleet.network import build_network, trails_in
from fiveroute.heuristics.fleet.regions import Regions
from fiveroute.heuristics.shortest_routes import shortest_routes
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan, Route

__all__ = ["default_trials", "fleet_search"]

PRICE = 0.1
"""Price of a second, in data per second were all data collected in all the time."""

REACH = 60
"""Near nodes that are listed for every node."""

MANY_NODES, MANY_AUVS = 600, 8
"""Size from which the islands share one plan out."""

ROUNDING = 1e-9
"""Share of what is enough that is put down to rounding."""

SLICE = 500
"""Trials on every island between two looks at the clock: some 5 to 20 milliseconds each."""


def fleet_search(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    rng: np.random.Generator,
    warm_start: Plan | None = None,
    iterations: int | None = None,
    enough: float = math.inf,
    workers: int = 1,
    progress: ProgressCallback | None = None,
    remember: Callable[[list[Route]], None] | None = None,
) -> Plan:
    """Search for the plan that collects most, and among those for the fastest.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop. A time limit is used up unless all data are collected before.
    rng
        Source of the one seed that the kernels draw from.
    warm_start
        A feasible plan to start from; the answer is never worse.
    iterations
        Number of trials on all islands together; None means as many as the time limit
        allows, or without one `default_trials`.
    enough
        Data at which to stop, such as an upper bound.
    workers
        Number of threads. The answer does not depend on it.
    progress
        Called with every better plan's objective.
    remember
        Called at the end with the good routes that the search came across, each in time for
        some AUV, such as columns to start from.

    Raises
    ------
    ValueError
        If no feasible plan to start from was found.
    """
    limits = limits or Limits()
    clock = limits.start()
    start = _first_plan(problem, warm_start)
    search = _search_around(start, problem, rng)
    trials = _trials(problem, limits, iterations)
    done, best = 0, search.objective
    enough = min(enough, float(search.network.profit.sum())) * (1.0 - ROUNDING)
    with crew(workers) as for_each:
        while done < trials and search.objective < enough and not clock.expired:
            part = max(done / trials, clock.seconds / limits.time if limits.time > 0.0 else 1.0)
            count = math.ceil(min(SLICE, (trials - done) / len(search.islands)))
            search.run(count, part, for_each)
            done += count * len(search.islands)
            if progress is not None and search.objective > best:
                progress(Progress(clock.seconds, search.objective, message="fleet search"))
            best = search.objective
    if remember is not None:
        remember(search.routes)
    return _better_of(problem, search.plan, start)


def default_trials(n: int) -> int:
    """Trials without a time limit: about 1 s for 60 nodes, 10 s for 600, 40 s for 5,000."""
    return 80_000 + min(1_200 * n, 500_000 + 300 * n)


def _search_around(
    plan: Plan, problem: TeamOrienteering, rng: np.random.Generator
) -> Archipelago | Regions:
    """Islands around a plan: each with all of it, or where that is a lot, with a part."""
    network = build_network(problem, REACH)
    duration = build_chains(network, trails_in(network, plan)).time
    network = network._replace(limit=np.maximum(network.limit, duration))  # at the very edge
    price = PRICE * problem.total_profit / (float(problem.budgets.sum()) or 1.0)
    is_large = len(network.nodes) >= MANY_NODES and problem.fleet_size >= MANY_AUVS
    kind = Regions if is_large else Archipelago
    return kind.around(plan, network, price, rng)


def _first_plan(problem: TeamOrienteering, warm_start: Plan | None) -> Plan:
    if warm_start is not None:
        if violations := check(problem, warm_start):
            raise InputError(
                "must be a feasible plan of this problem", field="warm_start", value=violations[0]
            )
        return warm_start
    routes = shortest_routes(problem)
    if routes is None:
        raise ValueError("no feasible plan")
    return Plan(routes)


def _trials(problem: TeamOrienteering, limits: Limits, iterations: int | None) -> float:
    if iterations is not None:
        return iterations
    return math.inf if math.isfinite(limits.time) else default_trials(problem.n)


def _better_of(problem: TeamOrienteering, plan: Plan, start: Plan) -> Plan:
    """The plan, unless rounding makes it infeasible or no better than the start."""

    def worth(plan: Plan) -> tuple[float, float]:
        return plan.objective(problem), -sum(plan.durations(problem))

    return plan if not check(problem, plan) and worth(plan) > worth(start) else start
