"""PyVRP, a hybrid of iterated local search and penalties, with optional clients.

Every node is an optional client with a prize; a route's limit is its vehicle's shift duration.
PyVRP minimises distance less prizes. It knows duration and distance apart, so durations are fine,
and distances so coarse that prizes outweigh them while they still tell short routes from long.

What makes it strong here: excess time is punished by a factor that PyVRP learns, but from a first
value that suits everyday units. From a first value in proportion to what a unit of time is worth,
all prizes over all budgets, it fell half as far below the best known values in a few seconds.

References
----------
N. A. Wouda, L. Lan and W. Kool, "PyVRP: a high-performance VRP solver package", INFORMS Journal
on Computing 36 (2024), doi 10.1287/ijoc.2023.0055.
"""

from __future__ import annotations

import warnings

import numpy as np
import pyvrp
from numpy.typing import NDArray
from pyvrp.exceptions import PenaltyBoundWarning
from pyvrp.PenaltyManager import PenaltyParams
from pyvrp.search import OPERATORS, LocalSearch, PerturbationManager, compute_neighbours

from fiveroute.limits import Clock, Limits
from fiveroute.peers.scaled import ScaledTimes, scaled_times
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["plan"]

_TIME, _DISTANCE = 1_000_000, 1_000
"""Units of the largest budget."""

_MEAN_PRIZE = 10_000

_FIRST, _LEAST, _MOST = 1.5, 0.003, 10_000.0
"""First, least and greatest penalty for a unit of time, in units of what it is worth."""

_UPDATE = 100
"""Solutions after which the penalty is adapted."""


def plan(problem: TeamOrienteering, limits: Limits, seed: int = 0) -> Plan:
    """PyVRP's plan.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop.
    seed
        Seed of its random numbers.
    """
    clock = limits.start()
    if not problem.n:
        return Plan.empty(problem.fleet_size)
    times = scaled_times(problem, _TIME)
    prizes = _prizes(problem)
    fleet = {int(budget): np.flatnonzero(times.budgets == budget) for budget in times.budgets}
    data = pyvrp.ProblemData(
        locations=[pyvrp.Location(0, 0)] * (problem.n + 2),
        clients=[
            pyvrp.Client(
                node, service_duration=times.service[node], prize=prizes[node], required=False
            )
            for node in range(1, problem.n + 1)
        ],
        depots=[pyvrp.Depot(0), pyvrp.Depot(problem.destination)],
        vehicle_types=[
            pyvrp.VehicleType(len(auvs), start_depot=0, end_depot=1, shift_duration=budget)
            for budget, auvs in fleet.items()
        ],
        distance_matrices=[scaled_times(problem, _DISTANCE).travel],
        duration_matrices=[times.travel],
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", PenaltyBoundWarning)
        found = _search(data, _worth(times, prizes), seed, clock)
    return _plan(problem, list(fleet.values()), found.best)


def _search(data: pyvrp.ProblemData, worth: float, seed: int, clock: Clock) -> pyvrp.Result:
    """What `pyvrp.solve` does, with penalties that begin at the worth of a unit of time."""
    random = pyvrp.RandomNumberGenerator(seed)
    local = LocalSearch(data, random, compute_neighbours(data), PerturbationManager())
    for operator in OPERATORS:
        if operator.supports(data):
            local.add_operator(operator(data))
    bounds = PenaltyParams(
        min_penalty=_LEAST * worth, max_penalty=_MOST * worth, solutions_between_updates=_UPDATE
    )
    penalties = pyvrp.PenaltyManager(([], _FIRST * worth, worth), bounds)
    begin = pyvrp.Solution.make_random(data, random)
    begin = local(begin, penalties.max_cost_evaluator(), exhaustive=True)
    search = pyvrp.IteratedLocalSearch(data, penalties, local, begin)
    return search.run(_Expired(clock), collect_stats=False, display=False)


class _Expired:
    """PyVRP's question whether to stop, with the cost of its best solution."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock

    def __call__(self, best_cost: int) -> bool:
        return self._clock.expired


def _prizes(problem: TeamOrienteering) -> NDArray[np.int64]:
    mean = problem.total_profit / problem.n
    return np.rint(problem.profit * (_MEAN_PRIZE / mean if mean > 0.0 else 0.0)).astype(np.int64)


def _worth(times: ScaledTimes, prizes: NDArray[np.int64]) -> float:
    """What a unit of time is worth: all prizes over all budgets."""
    return max(float(prizes.sum()), 1.0) / max(float(times.budgets.sum()), 1.0)


def _plan(problem: TeamOrienteering, fleet: list[NDArray[np.int64]], best: pyvrp.Solution) -> Plan:
    """Its routes, each given to an AUV of its kind; the others sail straight home."""
    routes: list[list[int]] = [[] for _ in range(problem.fleet_size)]
    idle = [list(auvs) for auvs in fleet]
    for route in best.routes():
        auv = idle[route.vehicle_type()].pop(0)
        routes[auv] = [stop.idx + 1 for stop in route if stop.is_client()]
    return Plan.of(routes)
