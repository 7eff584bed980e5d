"""The fleet-wide search: team orienteering over all AUVs and all nodes at once.

The paper improves one AUV's route after the other. Here any node may go to any AUV at any
time: routes are ruined by string removal and recreated by greedy insertion
(`fiveroute.heuristics.fleet`, after J. Christiaens and G. Vanden Berghe, Transportation
Science 54(2), 2020, doi 10.1287/trsc.2019.0914, made for routes that need not visit all),
under simulated annealing from hot to cold. Best means most data J, equation (2), and
among plans of equal J the least total time.

Times may be asymmetric and break the triangle inequality; budgets may differ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.heuristics.fleet.annealing import BEST_PROFIT, anneal
from fiveroute.heuristics.fleet.chains import NEXT, Chains, build_chains, to_plan
from fiveroute.heuristics.fleet.network import Floats, Ints, Network, build_network
from fiveroute.heuristics.randomness import RandomState, random_state
from fiveroute.heuristics.shortest_routes import shortest_routes
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.plan import Plan
from fiveroute.problem import TeamOrienteering

__all__ = ["default_trials", "fleet_search"]

HOT, COLD = 1.0, 0.1
"""First and last temperature, in mean data of a node."""

PRICE = 0.1
"""Price of a second, in data per second were all data collected in all the time."""

REACH = 60
"""Near nodes that are listed for every node."""

SLICE = 500
"""Trials between two looks at the clock: some 10 to 20 milliseconds."""


def fleet_search(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    rng: np.random.Generator,
    warm_start: Plan | None = None,
    iterations: int | None = None,
    progress: ProgressCallback | None = None,
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
        Number of trials; None means as many as the time limit allows, or without one
        `default_trials`.
    progress
        Called with every better plan's objective.

    Raises
    ------
    ValueError
        If no feasible plan to start from was found.
    """
    limits = limits or Limits()
    clock = limits.start()
    start = _first_plan(problem, warm_start)
    search = _Search.start_from(start, problem, rng)
    trials = _trials(problem, limits, iterations)
    done, best = 0, search.objective
    while done < trials and not search.has_all and not clock.expired:
        cooled = max(done / trials, clock.seconds / limits.time if limits.time > 0.0 else 1.0)
        count = int(min(SLICE, trials - done))
        search.run(count, HOT * (COLD / HOT) ** cooled)
        done += count
        if progress is not None and search.objective > best:
            progress(Progress(clock.seconds, search.objective, message="fleet search"))
        best = search.objective
    return _better_of(problem, search.plan, start)


def default_trials(n: int) -> int:
    """Trials without a time limit: about 1 s for 60 nodes, about 40 s for 5,000."""
    return 80_000 + 300 * n


@dataclass(frozen=True, slots=True)
class _Search:
    """The arrays that the kernels change, and what stays the same.

    Parameters
    ----------
    network
        The problem, its limits wide enough for the plan to start from.
    chains
        The current routes.
    best
        The stop behind every stop in the best routes.
    score
        Data of the current routes, and data and total time of the best ones.
    price
        Data that a second is worth.
    state
        Random state of the kernels.
    """

    network: Network
    chains: Chains
    best: Ints
    score: Floats
    price: float
    state: RandomState

    @classmethod
    def start_from(cls, plan: Plan, problem: TeamOrienteering, rng: np.random.Generator) -> _Search:
        """A search whose current and best routes are those of a plan."""
        network = build_network(problem, REACH)
        chains = build_chains(network, plan)
        limit = np.maximum(network.limit, chains.time)  # a plan at the very edge stays legal
        collected = plan.objective(problem)
        return cls(
            network._replace(limit=limit),
            chains,
            chains.stops[:, NEXT].copy(),
            np.array([collected, collected, chains.time.sum()]),
            PRICE * problem.total_profit / (float(problem.budgets.sum()) or 1.0),
            random_state(rng),
        )

    @property
    def objective(self) -> float:
        """Data that the best routes collect."""
        return float(self.score[BEST_PROFIT])

    @property
    def has_all(self) -> bool:
        """Whether the best routes collect all that any AUV has time for."""
        return self.objective >= float(self.network.profit.sum()) * (1.0 - 1e-12)

    @property
    def plan(self) -> Plan:
        """The best routes."""
        return to_plan(self.network, self.best)

    def run(self, trials: int, temperature: float) -> None:
        """Make trials at a temperature in units of a node's mean data."""
        net = self.network
        anneal(
            net.leg,
            net.back,
            net.profit,
            net.limit,
            net.near,
            *self.chains,
            self.best,
            self.score,
            trials,
            temperature * float(net.profit.mean()),
            self.price,
            self.state,
        )


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
