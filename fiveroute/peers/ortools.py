"""OR-Tools' routing library: constraint programming, local search, and guided local search.

Every node is a disjunction of its own: left out, it costs its prize. A dimension of time holds
each AUV to its budget. The objective is coarse distance plus the prizes left out.

What makes it strong here: guided local search punishes arcs in proportion to what they cost, so
prizes that dwarf the arcs leave it without effect. Mean prizes of a few legs do best, with far
heavier punishments than the usual ones; the cheapest arcs make a better start than insertions,
which take what is near. Nodes that nobody can visit in time do not count in the mean, and an AUV
that visits nothing pays for its way like the others: else it is cheapest to stay ashore.

References
----------
L. Perron and V. Furnon, OR-Tools, https://developers.google.com/optimization.
C. Voudouris and E. Tsang, "Guided local search and its application to the traveling salesman
problem", European Journal of Operational Research 113 (1999), doi 10.1016/S0377-2217(98)00099-X.
"""

from __future__ import annotations

import numpy as np
from ortools.constraint_solver import pywrapcp
from ortools.constraint_solver.routing_enums_pb2 import (
    FirstSolutionStrategy,
    LocalSearchMetaheuristic,
)

from fiveroute.limits import Clock, Limits
from fiveroute.peers.scaled import scaled_times
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["plan"]

_TIME, _DISTANCE = 10_000_000, 1_000
"""Units of the largest budget."""

_MEAN_PRIZE = 4.0
"""In units of the time that a node may take on average: all budgets over all nodes."""

_LAMBDA = 1.0
"""What guided local search adds to the cost of an arc that it punishes, a share of that cost."""


def plan(problem: TeamOrienteering, limits: Limits, seed: int = 0) -> Plan | None:
    """OR-Tools' plan; None where it finds none.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop.
    seed
        Not used: the search has no random numbers.
    """
    clock = limits.start()
    times = scaled_times(problem, _TIME)
    fleet = problem.fleet_size
    nodes = pywrapcp.RoutingIndexManager(
        problem.n + 2, fleet, [0] * fleet, [problem.destination] * fleet
    )
    routing = pywrapcp.RoutingModel(nodes)
    distance = scaled_times(problem, _DISTANCE).travel.tolist()
    routing.SetArcCostEvaluatorOfAllVehicles(routing.RegisterTransitMatrix(distance))
    duration = routing.RegisterTransitMatrix(times.through.tolist())
    routing.AddDimensionWithVehicleCapacity(duration, 0, times.budgets.tolist(), True, "time")
    for node, prize in enumerate(_prizes(problem)[1:-1], start=1):
        routing.AddDisjunction([nodes.NodeToIndex(node)], prize)
    for auv in range(fleet):
        routing.SetVehicleUsedWhenEmpty(True, auv)
    found = routing.SolveWithParameters(_parameters(clock))
    if found is None:
        return None
    return Plan.of(_route(nodes, routing, found, auv) for auv in range(fleet))


def _prizes(problem: TeamOrienteering) -> list[int]:
    longest = float(problem.budgets.max())
    detours = problem.travel[0] + problem.service + problem.travel[:, problem.destination]
    is_near = (detours <= longest) & (problem.profit > 0.0)
    total = float(problem.profit[is_near].sum())
    worth = _MEAN_PRIZE * _DISTANCE * float(problem.budgets.sum())
    scale = worth / (longest * total) if longest > 0.0 and total > 0.0 else 0.0
    prizes: list[int] = np.rint(scale * problem.profit).astype(np.int64).tolist()
    return prizes


def _parameters(clock: Clock) -> pywrapcp.DefaultRoutingSearchParameters:
    parameters = pywrapcp.DefaultRoutingSearchParameters()
    parameters.first_solution_strategy = FirstSolutionStrategy.PATH_CHEAPEST_ARC
    parameters.local_search_metaheuristic = LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    parameters.guided_local_search_lambda_coefficient = _LAMBDA
    parameters.time_limit.FromMilliseconds(max(int(1000.0 * clock.left), 1))
    return parameters


def _route(
    nodes: pywrapcp.RoutingIndexManager,
    routing: pywrapcp.RoutingModel,
    found: pywrapcp.Assignment,
    auv: int,
) -> list[int]:
    route = []
    stop = found.Value(routing.NextVar(routing.Start(auv)))
    while not routing.IsEnd(stop):
        route.append(nodes.IndexToNode(stop))
        stop = found.Value(routing.NextVar(stop))
    return route
