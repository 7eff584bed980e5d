"""Branch and price, step by step."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.bounds import Effort, quick_bound
from fiveroute.models.branch_price.column_generation import Relaxation, generate
from fiveroute.models.branch_price.master import Master
from fiveroute.models.branch_price.neighbourhoods import grow, is_forgetful, nearest
from fiveroute.models.branch_price.pool import Pool, sail_best
from fiveroute.models.branch_price.pricing import Pricer
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.common_divisor import common_divisor, rounded_down
from fiveroute.models.greedy_plan import greedy_plan
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.network import Network
from fiveroute.plan import Plan, Route
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result

__all__ = ["solve", "supports"]

Floats = NDArray[np.float64]

_NEIGHBOURS = 8
_MOST_NEIGHBOURS = 24
_TOO_LARGE = 500  # nodes above which a quick bound and a greedy plan are all
_PLAN_TIME = 3.0  # seconds for a plan over the routes of the master problem


def supports(problem: TeamOrienteering) -> bool:
    """Any problem: times, budgets and data may be what they like."""
    return True


def solve(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Plan | None = None,
    progress: ProgressCallback | None = None,
) -> Result:
    """Solve to optimality, or as far as the limits allow.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop; None without any limit.
    warm_start
        A plan to start from; one that the judge rejects is left aside.
    progress
        Told of better plans and bounds.
    """
    incumbent = Incumbent(problem, "branch-price", limits, warm_start=warm_start, progress=progress)
    network = Network.of(problem)
    if network.has_no_route:
        return incumbent.infeasible()
    if incumbent.must_stop:
        return incumbent.result()
    first = quick_bound(problem, incumbent.clock.rest(), effort=Effort.LEAST)
    incumbent.lower(first.value)
    greedy = greedy_plan(problem, problem.profit, incumbent.clock)
    if greedy is not None:
        incumbent.offer(greedy)
    if incumbent.must_stop:
        return incumbent.result()
    if problem.n > _TOO_LARGE:
        incumbent.lower(quick_bound(problem, incumbent.clock.rest()).value)
        return incumbent.result()
    search = _Search(Roads.of(network), incumbent)
    search.run()
    if search.is_infeasible and incumbent.plan is None:
        return incumbent.infeasible()
    return incumbent.result()


class _Search:
    """The parts of one run."""

    def __init__(self, roads: Roads, incumbent: Incumbent) -> None:
        self.roads, self.incumbent = roads, incumbent
        self.clock = incumbent.clock
        self.is_infeasible = False
        self.near = nearest(roads, _NEIGHBOURS)
        self.pricer = Pricer(roads, self.near)
        self.master = Master(roads, self.clock)
        self.master.add([()])
        if incumbent.plan is not None:
            self.master.add(incumbent.plan.routes)

    def run(self) -> None:
        root = self.relax()
        if root is None or self.incumbent.must_stop or self.is_infeasible:
            return
        self.plan_over_known_routes()

    def lower(self, bound: float) -> None:
        """Report a bound; below zero, it proves that no plan exists."""
        if bound < 0.0:
            self.is_infeasible = True
        self.incumbent.lower(max(rounded_down(bound, self.roads.profit), self.incumbent.objective))

    def is_low_enough(self, bound: float) -> bool:
        """Whether no better plan can be left under a bound."""
        step = common_divisor(self.roads.profit) or 0.0
        return bound < self.incumbent.objective + 0.999 * step or self.incumbent.is_settled

    def relax(self) -> Relaxation | None:
        """The relaxation over ng-routes, its neighbourhoods grown as far as they help."""
        lowest: Relaxation | None = None
        while True:
            relaxation = generate(
                self.master,
                self.pricer,
                self.clock,
                is_low_enough=self.is_low_enough,
                on_bound=self.lower,
            )
            if relaxation is not None and (lowest is None or relaxation.value < lowest.value):
                lowest = relaxation
            if relaxation is None or not relaxation.has_converged or self.incumbent.must_stop:
                return lowest
            if not grow(self.near, self.used_routes(), _MOST_NEIGHBOURS):
                return lowest
            self.master.ban(lambda route: not is_forgetful(self.near, route))

    def used_routes(self) -> list[Route]:
        """Routes of the last solution of the master problem."""
        return [self.master.routes[k] for k in np.flatnonzero(self.master.shares > 1e-6)]

    def plan_over_known_routes(self) -> None:
        """Look for a plan over the elementary routes that the master problem knows."""
        routes = [route for route in self.master.routes if len(set(route)) == len(route)]
        pool = Pool.of(self.roads, routes)
        clock = self.clock.rest().within(_PLAN_TIME).start()
        sail_best(pool, self.roads, self.incumbent, clock)
