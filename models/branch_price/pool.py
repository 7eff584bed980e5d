r"""The best plan over a pool of known routes.

    max  sum_r rho_r lambda_r    s.t. node and fleet rows of `fiveroute.models.branch_price.master`,
    lambda binary,

solved by HiGHS. Where the pool holds every route that a better plan may sail, it settles the
problem; any other pool gives a plan.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, vstack

from fiveroute.limits import Clock
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.common_divisor import common_divisor
from fiveroute.models.highs import Outcome, Program
from fiveroute.models.incumbent import Incumbent
from fiveroute.plan import Plan, Route

__all__ = ["Pool", "plan_of", "sail_best"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_MARGIN = 1e-7  # of the unit of the data; what HiGHS may be wrong by


@dataclass(frozen=True, slots=True, eq=False)
class Pool:
    """Routes by their node sets.

    Parameters
    ----------
    visits
        `visits[i, r]` = 1 if route r visits vertex i, shape (n + 2, routes).
    classes
        First class with time for every route, shape (routes,).
    profit
        Data of every route, shape (routes,).
    route
        From a number to the route.
    """

    visits: csc_array
    classes: Ints
    profit: Floats
    route: Callable[[int], Route]

    @classmethod
    def of(cls, roads: Roads, routes: list[Route]) -> Pool:
        """A pool of elementary routes."""
        lengths = [len(route) for route in routes]
        nodes = np.array([node for route in routes for node in route], dtype=np.int64)
        visits = csc_array(
            (np.ones(len(nodes)), nodes, np.concatenate([[0], np.cumsum(lengths)])),
            shape=(len(roads.leg), len(routes)),
        )
        classes = np.array([roads.class_of(roads.duration(r)) for r in routes], dtype=np.int64)
        profit = np.asarray(visits.T @ roads.profit)
        return cls(visits, classes, profit, routes.__getitem__)

    def __len__(self) -> int:
        return len(self.profit)

    def chosen(self, places: Ints) -> Pool:
        """The pool of some of the routes."""
        lookup = self.route
        return Pool(
            self.visits[:, places],
            self.classes[places],
            self.profit[places],
            lambda k: lookup(int(places[k])),
        )


def sail_best(
    pool: Pool,
    roads: Roads,
    incumbent: Incumbent,
    clock: Clock,
    *,
    on_bound: Callable[[float], None] | None = None,
) -> bool:
    """Offer the best plan over the pool; return whether nothing better is in it.

    Parameters
    ----------
    pool
        The routes.
    roads
        Legs, limits and AUVs.
    incumbent
        Where plans go.
    clock
        When to stop.
    on_bound
        Told bounds on the plans over the pool.
    """
    unit = common_divisor(roads.profit) or float(roads.profit.max()) or 1.0

    def offer(values: Floats) -> bool:
        times = np.rint(values).astype(np.int64)
        routes = [pool.route(int(k)) for k in np.repeat(np.arange(len(times)), times)]
        plan = plan_of(roads, routes)
        return plan is not None and incumbent.offer(plan)

    def tell(_: float | None, bound: float | None) -> None:
        if on_bound is not None and bound is not None:
            on_bound((bound + _MARGIN) * unit)

    def note(values: Floats) -> None:
        offer(values)

    program = Program(clock, maximise=True, on_progress=tell, on_solution=note)
    above = roads.routes[::-1].cumsum()[::-1]
    needs = csr_array(pool.classes >= np.arange(len(above))[:, None], dtype=np.float64)
    least = np.full(len(above), -np.inf)
    if roads.must_detour:
        least[0] = above[0]
    is_direct = pool.visits.indptr[1:] == pool.visits.indptr[:-1]  # any number of AUVs may sail it
    most = np.where(is_direct, float(roads.problem.fleet_size), 1.0)
    program.add_columns(pool.profit / unit, 0.0, most, integer=True)
    nodes = csr_array(pool.visits)[1:-1]
    program.add_rows(
        csr_array(vstack([nodes, needs])),
        np.concatenate([np.full(roads.problem.n, -np.inf), least]),
        np.concatenate([np.ones(roads.problem.n), above]),
    )
    program.require_integers(True)
    program.set("mip_rel_gap", clock.limits.gap)
    program.set("mip_abs_gap", 0.0)
    outcome = program.solve()
    if outcome is Outcome.INFEASIBLE:
        if on_bound is not None:
            on_bound(-np.inf)
        return True
    accepted = not program.has_solution or offer(program.values)
    if on_bound is not None and np.isfinite(program.bound):
        on_bound((program.bound + _MARGIN) * unit)
    return outcome is Outcome.OPTIMAL and accepted


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
