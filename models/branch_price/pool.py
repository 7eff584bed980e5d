r"""The best plan over a pool of known routes.

    max  sum_r rho_r lambda_r    s.t. node and fleet rows of `fiveroute.models.branch_price.master`,
    lambda binary,

solved by HiGHS. Where the pool holds every route that a better plan may sail, it settles the
problem; any other pool gives a plan.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, vstack

from fiveroute.limits import Clock
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.common_divisor import common_divisor
from fiveroute.models.highs import Outcome, Program
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.unreduced import UNREDUCED
from fiveroute.result import PROOF_TOLERANCE, is_closed
from fiveroute.routes import Plan, Route

__all__ = ["BETTER", "Pool", "plan_of", "sail_best", "stops_of", "taking"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Shorts = NDArray[np.int16]
Booleans = NDArray[np.bool_]

BETTER = PROOF_TOLERANCE / 2.0
"""By how much, relative, a better plan is better; more than what HiGHS may be wrong by."""

_MARGIN = 1e-7  # of the unit of the data; what HiGHS may be wrong by


@dataclass(frozen=True, slots=True, eq=False)
class Pool:
    """Routes through distinct nodes.

    Parameters
    ----------
    stops
        Nodes of every route in the order of the visits, 0 beyond the last, shape (routes, longest).
    time
        Their times in seconds, shape (routes,).
    visits
        `visits[i, r]` = 1 if route r visits vertex i, shape (n + 2, routes).
    classes
        First class with time for every route, shape (routes,).
    profit
        Data of every route, shape (routes,).
    """

    stops: Shorts
    time: Floats
    visits: csc_array
    classes: Ints
    profit: Floats

    @classmethod
    def of(cls, roads: Roads, routes: list[Route]) -> Pool:
        """A pool of routes through distinct nodes."""
        return cls.along(
            roads, stops_of(routes), np.array([roads.duration(route) for route in routes])
        )

    @classmethod
    def along(cls, roads: Roads, stops: Shorts, time: Floats) -> Pool:
        """A pool of routes with their stops and times."""
        starts = np.concatenate([[0], np.cumsum((stops > 0).sum(axis=1))])
        nodes = stops[stops > 0].astype(np.int64)
        visits = csc_array((np.ones(len(nodes)), nodes, starts), shape=(len(roads.leg), len(stops)))
        classes = np.searchsorted(roads.limits, time)
        return cls(stops, time, visits, classes, np.asarray(visits.T @ roads.profit))

    def __len__(self) -> int:
        return len(self.profit)

    def route(self, k: int) -> Route:
        """The nodes of a route."""
        return tuple(int(node) for node in self.stops[k] if node)

    def chosen(self, places: Ints) -> Pool:
        """The pool of some of the routes."""
        return Pool(
            self.stops[places],
            self.time[places],
            self.visits[:, places],
            self.classes[places],
            self.profit[places],
        )

    def without(self, legs: Booleans) -> Pool:
        """The pool without the routes that take one of some legs, shape (n + 2, n + 2)."""
        return self.chosen(np.flatnonzero(~taking(self.stops, legs)))


def stops_of(routes: Sequence[Route]) -> Shorts:
    """Nodes of routes in the order of the visits, 0 beyond the last, shape (routes, longest)."""
    stops = np.zeros((len(routes), max(map(len, routes), default=0)), dtype=np.int16)
    for k, route in enumerate(routes):
        stops[k, : len(route)] = route
    return stops


def taking(stops: Shorts, legs: Booleans) -> Booleans:
    """Which routes take one of some legs, shape (n + 2, n + 2)."""
    end = len(legs) - 1
    found = np.zeros(len(stops), dtype=np.bool_)
    before = np.zeros(len(stops), dtype=np.int64)
    for column in range(stops.shape[1] + 1):
        here = np.zeros(len(stops), dtype=np.int64)
        if column < stops.shape[1]:
            here += stops[:, column]
        here[here == 0] = end
        found |= (before != end) & legs[before, here]
        before = here
    return found


def sail_best(
    pool: Pool,
    roads: Roads,
    incumbent: Incumbent,
    clock: Clock,
    *,
    on_bound: Callable[[float], None] | None = None,
    is_proof: bool = True,
) -> bool:
    """Offer the best plan over the pool; return whether nothing better is in it.

    Parameters
    ----------
    pool
        The routes.
    roads
        Legs, limits and AUVs. Where there is a toll, plans that are better than the known one
        are looked for by what they pay.
    incumbent
        Where plans go.
    clock
        When to stop.
    on_bound
        Told bounds on the plans over the pool.
    is_proof
        Whether the answer shall be relied on, which takes longer.
    """
    choice = _Choice(pool, roads, incumbent, clock, on_bound)
    for option, value in UNREDUCED.items() if is_proof else ():
        choice.program.set(option, value)
    while True:
        before = incumbent.objective
        if roads.toll and incumbent.plan is not None:
            choice.demand(before + BETTER * max(1.0, before))
        if not choice.solve():
            return False
        if choice.is_empty:
            return True
        if not roads.toll:
            return choice.is_closed
        if incumbent.objective <= before:
            return False


class _Choice:
    """The integer programme over a pool."""

    def __init__(
        self,
        pool: Pool,
        roads: Roads,
        incumbent: Incumbent,
        clock: Clock,
        on_bound: Callable[[float], None] | None,
    ) -> None:
        self.pool, self.roads, self.incumbent, self.on_bound = pool, roads, incumbent, on_bound
        self.unit = common_divisor(roads.profit) or float(roads.profit.max()) or 1.0
        self.is_empty, self.gap = False, clock.limits.gap
        self.program = Program(clock, maximise=True, on_progress=self._tell, on_solution=self._note)
        above = roads.routes[::-1].cumsum()[::-1]
        needs = csr_array(pool.classes >= np.arange(len(above))[:, None], dtype=np.float64)
        least = np.full(len(above), -np.inf)
        if roads.must_detour:
            least[0] = above[0]
        is_direct = pool.visits.indptr[1:] == pool.visits.indptr[:-1]  # any number may sail it
        most = np.where(is_direct, float(roads.problem.fleet_size), 1.0)
        worth = pool.profit - roads.toll * pool.time
        self.program.add_columns(worth / self.unit, 0.0, most, integer=True)
        nodes = csr_array(pool.visits)[1:-1]
        data = csr_array(pool.profit[None, :])
        self.program.add_rows(
            csr_array(vstack([data, nodes, needs])),
            np.concatenate([np.full(roads.problem.n + 1, -np.inf), least]),
            np.concatenate([[np.inf], np.ones(roads.problem.n), above]),
        )
        self.program.require_integers(True)
        self.program.set("mip_rel_gap", self.gap)
        self.program.set("mip_abs_gap", 0.0)

    def demand(self, data: float) -> None:
        """Ask for a plan that collects as much."""
        self.program.highs.changeRowBounds(0, data, np.inf)

    def solve(self) -> bool:
        """Offer the best plan; whether there is none better."""
        outcome = self.program.solve()
        if outcome is Outcome.INFEASIBLE:
            self.is_empty = True
            if self.on_bound is not None:
                self.on_bound(-np.inf)
            return True
        accepted = not self.program.has_solution or self._offer(self.program.values)
        self._tell(None, self.program.bound)
        return outcome is Outcome.OPTIMAL and accepted

    @property
    def is_closed(self) -> bool:
        """Whether the last plan is the best, not only as good as the limits ask."""
        if self.gap <= 0.0:
            return True
        return is_closed(self.program.objective * self.unit, self.program.bound * self.unit)

    def _offer(self, values: Floats) -> bool:
        times = np.rint(values).astype(np.int64)
        routes = [self.pool.route(int(k)) for k in np.repeat(np.arange(len(times)), times)]
        plan = plan_of(self.roads, routes)
        return plan is not None and self.incumbent.offer(plan)

    def _note(self, values: Floats) -> None:
        self._offer(values)

    def _tell(self, _: float | None, bound: float | None) -> None:
        if self.on_bound is not None and bound is not None and np.isfinite(bound):
            self.on_bound((bound + _MARGIN) * self.unit + self.roads.refund)


def plan_of(roads: Roads, routes: list[Route]) -> Plan | None:
    """A plan with these routes, the longest to the AUVs with the largest budgets."""
    if len(routes) > roads.problem.fleet_size:
        return None
    waiting = [auv for auvs in roads.members for auv in auvs]
    ordered = sorted(routes, key=roads.problem.duration, reverse=True)
    plan: list[Route] = [()] * roads.problem.fleet_size
    for auv, route in zip(reversed(waiting), ordered, strict=False):
        plan[auv] = route
    return Plan(tuple(plan))
