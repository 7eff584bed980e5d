"""Branch and price, step by step."""

from __future__ import annotations

import heapq
import itertools

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.bounds import Effort, quick_bound
from fiveroute.models.branch_price.elementary import enumerate_routes
from fiveroute.models.branch_price.neighbourhoods import nearest
from fiveroute.models.branch_price.pool import Pool, plan_of, sail_best
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.branch_price.subproblem import Branch, Subproblem
from fiveroute.models.common_divisor import common_divisor, rounded_down
from fiveroute.models.greedy_plan import offer_greedy_plan
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.network import Network
from fiveroute.plan import Plan
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result

__all__ = ["solve", "supports"]

Booleans = NDArray[np.bool_]

_NEIGHBOURS = 8
_SMALL = 25  # nodes up to which a quick bound is not worth its time
_TOO_LARGE = 500  # nodes above which a quick bound and a greedy plan are all
_PLAN_TIME = 3.0  # seconds for a plan over the routes of the master problem
_FIRST_PARTIAL, _MOST_PARTIAL = 400_000, 3_000_000  # partial routes of an enumeration
_ROUTES_TO_SAIL = 6_000  # routes among which HiGHS finds the best plan in good time
_SAFE = 1e-9
_CUT_ROUNDS = 30


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
    effort = Effort.LEAST if problem.n <= _SMALL else Effort.QUICK
    bound = quick_bound(problem, incumbent.clock.rest(), effort=effort)
    if bound.method == "infeasible":
        return incumbent.infeasible()
    incumbent.lower(bound.value)
    offer_greedy_plan(incumbent, problem.profit)
    if incumbent.must_stop:
        return incumbent.result()
    if problem.n > _TOO_LARGE:
        return incumbent.result()
    tree = _Tree(Roads.of(network), incumbent)
    if tree.search() and incumbent.plan is None:
        return incumbent.infeasible()
    return incumbent.result()


class _Tree:
    """The search tree: subproblems whose bounds are still above the best plan."""

    def __init__(self, roads: Roads, incumbent: Incumbent) -> None:
        self.roads, self.incumbent = roads, incumbent
        self.clock = incumbent.clock
        self.near = nearest(roads, _NEIGHBOURS)
        self.step = common_divisor(roads.profit) or 0.0
        self.partial = _FIRST_PARTIAL
        self.open: list[tuple[float, int, Branch, Subproblem | None]] = []
        self.order = itertools.count()
        self.under_way = self.stuck = -np.inf
        self.here: Subproblem

    def search(self) -> bool:
        """Search until nothing is left or time is up; whether nothing is left."""
        size = len(self.roads.leg)
        whole = Branch(np.zeros((size, size), dtype=np.bool_), frozenset())
        self.push(np.inf, whole, None)
        while self.open and not self.incumbent.must_stop:
            bound, _, branch, parent = heapq.heappop(self.open)
            if self.is_low_enough(-bound):
                continue
            self.under_way = -bound
            rest = self.explore(branch, parent)
            if rest is None:
                self.under_way = -np.inf
            elif self.clock.expired or self.incumbent.is_settled:
                return False
            else:
                self.branch(rest, min(-bound, rest.bound))
                self.under_way = -np.inf
            self.tell()
        return not self.open and not self.clock.expired and self.stuck == -np.inf

    def branch(self, here: Subproblem, bound: float) -> None:
        """Divide a subproblem, or take its plan where there is nothing to divide."""
        while not self.is_low_enough(bound):
            children = here.branches()
            for child in children:
                self.push(bound, child, here)
            if children or self.clock.expired:
                break
            plan = plan_of(self.roads, here.whole_routes())
            if plan is not None:
                self.incumbent.offer(plan)
            here.relax(self.on_bound)  # with a better plan it converges further
            if here.bound >= bound:
                break
            bound = here.bound
        else:
            return
        if not children:
            self.stuck = max(self.stuck, bound)

    def push(self, bound: float, branch: Branch, parent: Subproblem | None) -> None:
        heapq.heappush(self.open, (-bound, next(self.order), branch, parent))

    def target(self) -> float:
        """What a better plan collects more than."""
        if self.incumbent.plan is None:  # a plan may collect nothing at all
            return -_SAFE * max(1.0, self.roads.problem.total_profit)
        return self.incumbent.objective + 0.999 * self.step

    def is_low_enough(self, bound: float) -> bool:
        """Whether no better plan can be left under a bound."""
        return bound <= self.target()

    def tell(self) -> None:
        """Report the bound of all that is open."""
        first = -self.open[0][0] if self.open else -np.inf
        self.lower(max(first, self.under_way, self.stuck))

    def on_bound(self, bound: float) -> None:
        """Note a bound of the subproblem under way."""
        self.under_way = min(self.under_way, bound)
        self.incumbent.note = f"with {len(self.here.master.routes)} columns"
        self.tell()

    def lower(self, bound: float) -> None:
        """Report a bound on all plans."""
        least = max(self.incumbent.objective, 0.0)
        self.incumbent.lower(max(rounded_down(bound, self.roads.profit), least))

    def explore(self, branch: Branch, parent: Subproblem | None) -> Subproblem | None:
        """Solve a subproblem as far as cuts and enumeration go; None when it is settled."""
        here = Subproblem(self.roads, branch, self.near, self.clock, self.target)
        if parent is not None:
            here.pricer.half = parent.pricer.half
            here.start_from(parent.master.routes, parent.master.cuts)
        else:
            here.start_from(self.incumbent.plan.routes if self.incumbent.plan else [], [])
        self.here = here
        has_converged = here.relax(self.on_bound)
        if parent is None and has_converged:
            self.plan_over_known_routes(here)
        for _ in range(_CUT_ROUNDS):
            if self.is_low_enough(here.bound):
                return None
            if self.clock.expired or self.incumbent.is_settled:
                return here
            if self.settle(here):
                return None
            if not has_converged or not here.cut(self.on_bound):
                break
            self.partial = min(2 * self.partial, _MOST_PARTIAL)
        return here

    def settle(self, here: Subproblem) -> bool:
        """Enumerate all routes of better plans, and sail the best of them, if they are few."""
        if here.relaxation is None:
            return False
        pool = enumerate_routes(
            here.roads, here.relaxation, self.target(), self.clock, self.partial
        )
        if pool is None or len(pool) > _ROUTES_TO_SAIL:
            return False
        done = sail_best(
            pool,
            here.roads,
            self.incumbent,
            self.clock,
            on_bound=lambda bound: self.on_bound(max(bound, self.target())),
        )
        return done

    def plan_over_known_routes(self, here: Subproblem) -> None:
        """Look for a plan over the elementary routes that the master problem knows."""
        routes = [route for route in here.master.routes if len(set(route)) == len(route)]
        clock = self.clock.rest().within(_PLAN_TIME).start()
        sail_best(Pool.of(here.roads, routes), here.roads, self.incumbent, clock)
