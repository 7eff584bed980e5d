"""Branch and price, step by step.

Of the subproblems that are open, the one with the highest bound is explored first:

1. Column generation brings its bound down. At the root, a plan over the routes known by then
   follows; and where nearly all data are within reach, a toll on time is tried, which may leave
   fewer legs.
2. Where the gap is small, all routes that a better plan may sail are enumerated, and from then on
   priced by inspection. Once they are few, HiGHS finds the best plan over them, which settles the
   subproblem.
3. Otherwise cuts bring the bound down further, and step 2 comes again.

What cuts do not settle is divided in two. A subproblem is settled without any of this if
its bound leaves no room for a better plan, on the grid of all sums of data where there is one.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.bounds import Effort, quick_bound
from fiveroute.models.branch_price.branching import Branch
from fiveroute.models.branch_price.elementary import enumerate_routes
from fiveroute.models.branch_price.neighbourhoods import nearest
from fiveroute.models.branch_price.pool import BETTER, Pool, plan_of, sail_best
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.branch_price.subproblem import Subproblem
from fiveroute.models.common_divisor import common_divisor, rounded_down
from fiveroute.models.greedy_plan import offer_greedy_plan
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["solve", "supports"]

Booleans = NDArray[np.bool_]

_NEIGHBOURS = 8
_SMALL = 25  # nodes up to which a quick bound is not worth its time
_TOO_LARGE = 500  # nodes above which a quick bound and a greedy plan are all
_PLAN_TIME = 3.0  # seconds for a plan over the routes of the master problem
_FIRST_PARTIAL, _MOST_PARTIAL = 3_000_000, 8_000_000  # partial routes of an enumeration
_MOST_ROUTES = 1_000_000  # routes to price by inspection
_ROUTES_TO_SAIL, _MOST_ROUTES_TO_SAIL = 2_000, 6_000  # routes that HiGHS chooses among in good time
_SMALLER = 0.85  # share of a gap for which there were too many routes, and another try pays
_NEARLY = 0.97  # share of all data, from which on time is what is scarce
_FEWER = 0.9  # share of legs left that makes it worth while
_TOLL = 0.1  # share of the data that a fleet pays for its time
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
    routes: Sequence[Route] = (),
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
    routes
        Routes to start from besides; late ones are left aside.
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
    tree = _Tree(Roads.of(network), incumbent, routes)
    if tree.search() and incumbent.plan is None:
        return incumbent.infeasible()
    return incumbent.result()


class _Tree:
    """The search tree: subproblems whose bounds are still above the best plan."""

    def __init__(self, roads: Roads, incumbent: Incumbent, routes: Sequence[Route] = ()) -> None:
        self.roads, self.incumbent, self.routes = roads, incumbent, routes
        self.clock = incumbent.clock
        self.near = nearest(roads, _NEIGHBOURS)
        self.step = common_divisor(roads.profit) or 0.0
        self.partial, self.too_wide = _FIRST_PARTIAL, np.inf
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
            if here.is_whole():
                plan = plan_of(self.roads, here.whole_routes())
                if plan is not None:
                    self.incumbent.offer(plan)
                bound = min(bound, here.all_data())
                if self.is_low_enough(bound):
                    return
            children = here.branches()
            for child in children:
                self.push(bound, child, here)
            if children or self.clock.expired:
                break
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
        known = self.incumbent.objective
        return known + max(0.999 * self.step, BETTER * max(1.0, known))

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
        self.incumbent.lower(rounded_down(max(bound, self.target()), self.roads.profit))

    def explore(self, branch: Branch, parent: Subproblem | None) -> Subproblem | None:
        """Solve a subproblem as far as cuts and enumeration go; None when it is settled."""
        here = self.here = Subproblem(self.roads, branch, self.near, self.clock, self.target)
        if self.is_low_enough(here.all_data()):
            return None
        if parent is not None:
            here.follow(parent)
        else:
            best = self.incumbent.plan.routes if self.incumbent.plan else ()
            here.start_from([*best, *self.routes], [])
        has_converged = here.relax(self.on_bound)
        if parent is None and has_converged:
            self.plan_over_known_routes(here)
            here = self.here = self.with_toll(here)
        for _ in range(_CUT_ROUNDS):
            if self.is_low_enough(here.bound):
                return None
            if self.clock.expired or self.incumbent.is_settled:
                return here
            if here.pool is None and (pool := self.enumerated(here)) is not None:
                here = self.here = here.inspect(pool)
                if self.settle(here, _ROUTES_TO_SAIL):
                    return None
                has_converged = here.relax(self.on_bound)
                continue
            if self.settle(here, _ROUTES_TO_SAIL):
                return None
            if not has_converged or not here.cut(self.on_bound):
                break
            if here.pool is None and parent is None:
                self.plan_over_known_routes(here)
        if self.settle(here, _MOST_ROUTES_TO_SAIL):
            return None
        return here

    def with_toll(self, here: Subproblem) -> Subproblem:
        """The root with a toll on time, if that leaves fewer legs."""
        everything = self.roads.problem.total_profit
        if here.bound < _NEARLY * everything or self.is_low_enough(here.bound):
            return here
        toll = _TOLL * everything / float(self.roads.routes @ self.roads.limits)
        roads = replace(self.roads, toll=toll)
        other = Subproblem(roads, here.branch, self.near, self.clock, self.target)
        other.start_from(here.master.routes, [])
        has_converged = other.relax(lambda _: None)
        few = np.isfinite(other.roads.leg).sum() < _FEWER * np.isfinite(here.roads.leg).sum()
        if self.is_low_enough(other.bound) or (has_converged and few):
            self.roads = roads
            return other
        return here

    def enumerated(self, here: Subproblem) -> Pool | None:
        """All routes of better plans, if they are few."""
        gap = here.bound - self.target()
        if here.relaxation is None or gap > _SMALLER * self.too_wide:
            return None
        most = min(self.partial, self.clock.work_left)
        pool = enumerate_routes(here.roads, here.relaxation, self.target(), self.clock, most)
        if pool is None or len(pool) > _MOST_ROUTES:
            self.partial = min(2 * self.partial, _MOST_PARTIAL)
            self.too_wide = gap
            return None
        return pool

    def settle(self, here: Subproblem, most: int) -> bool:
        """Sail the best routes of better plans, if they are all known and no more than `most`."""
        if here.pool is None or len(here.pool) > most:
            return False
        return sail_best(
            here.pool,
            here.roads,
            self.incumbent,
            self.clock,
            on_bound=lambda bound: self.on_bound(max(bound, self.target())),
        )

    def plan_over_known_routes(self, here: Subproblem) -> None:
        """Look for a plan over the elementary routes that the master problem knows."""
        routes = here.routes_of_better_plans()
        clock = self.clock.rest().within(_PLAN_TIME).start()
        sail_best(Pool.of(self.roads, routes), self.roads, self.incumbent, clock, is_proof=False)
