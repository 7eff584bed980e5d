"""VROOM: constructive heuristics and local search, in whole seconds.

A node's data is its job's priority, 0 to 100. VROOM prefers the larger sum of priorities, then
fewer unassigned jobs, then shorter routes, so that priorities in proportion to the data make it
maximise the data, as far as the data are whole numbers up to 100 or well told apart by so few.
It runs at its highest level of exploration, has no random numbers and ends by itself, mostly
before the time is over.

References
----------
J. Coupey, J.-M. Nicod and C. Varnier, VROOM, "Vehicle Routing Open-source Optimization Machine",
https://github.com/VROOM-Project/vroom.
"""

from __future__ import annotations

from datetime import timedelta

import vroom

from fiveroute.limits import Limits
from fiveroute.peers.scaled import scaled_profit, scaled_times
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["plan"]

_TIME = 100_000
"""Units of the largest budget; what VROOM computes with is a hundred times as fine."""

_HIGHEST_PRIORITY = 100

_DEEPEST = 5


def plan(problem: TeamOrienteering, limits: Limits, seed: int = 0) -> Plan:
    """VROOM's plan.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop.
    seed
        Not used: VROOM has no random numbers.
    """
    clock = limits.start()
    if not problem.n:
        return Plan.empty(problem.fleet_size)
    times = scaled_times(problem, _TIME)
    priority = scaled_profit(problem, _HIGHEST_PRIORITY)
    task = vroom.Input()
    task.set_durations_matrix("auv", times.travel)
    task.add_vehicle(
        [
            vroom.Vehicle(
                auv,
                start=0,
                end=problem.destination,
                profile="auv",
                time_window=vroom.TimeWindow(0, int(budget)),
            )
            for auv, budget in enumerate(times.budgets)
        ]
    )
    task.add_job(
        [
            vroom.Job(
                node,
                location=node,
                default_service=int(times.service[node]),
                priority=int(priority[node]),
            )
            for node in range(1, problem.n + 1)
        ]
    )
    found = task.solve(_DEEPEST, nb_threads=1, timeout=timedelta(seconds=clock.left)).to_dict()
    routes: list[list[int]] = [[] for _ in range(problem.fleet_size)]
    for route in found["routes"]:
        steps = (step for step in route["steps"] if step["type"] == "job")
        routes[route["vehicle"]] = [step["id"] for step in steps]
    return Plan.of(routes)
