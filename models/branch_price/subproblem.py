"""A node of the search tree: some legs forbidden, some nodes required."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock
from fiveroute.models.branch_price.branching import (
    Branch,
    by_leg,
    by_node,
    doubtful_legs,
    doubtful_nodes,
    most_telling,
)
from fiveroute.models.branch_price.column_generation import LOOSE, TIGHT, Relaxation, generate
from fiveroute.models.branch_price.cuts import MOST_CUTS, separate
from fiveroute.models.branch_price.duals import Cut
from fiveroute.models.branch_price.inspection import Inspector
from fiveroute.models.branch_price.master import Master
from fiveroute.models.branch_price.neighbourhoods import grow, is_forgetful
from fiveroute.models.branch_price.pool import Pool, stops_of, taking
from fiveroute.models.branch_price.pricing import Pricer
from fiveroute.models.branch_price.roads import Roads
from fiveroute.routes import Route

__all__ = ["Subproblem"]

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]

_MOST_NEIGHBOURS = 24
_CUTS_AT_ONCE = 20
_CANDIDATES = 4  # nodes, and as many legs, that a division is chosen from
_WORTHWHILE = 0.1  # share of the distance to the target that a round of cuts must close
_LABELS_WITH_CUTS, _MORE_LABELS = 150_000, 5  # that pricing may take with cuts, also relative


class Subproblem:
    """A relaxation with its routes, neighbourhoods and cuts.

    Parameters
    ----------
    roads
        Legs and limits of the whole problem.
    branch
        Forbidden legs and required nodes.
    near
        Neighbourhoods; they grow in place.
    clock
        When to stop.
    target
        Tells what a better plan collects more than.
    """

    def __init__(
        self,
        roads: Roads,
        branch: Branch,
        near: Booleans,
        clock: Clock,
        target: Callable[[], float],
    ) -> None:
        self.branch, self.near, self.clock, self.target = branch, near, clock, target
        self.roads = roads.without(branch.forbidden)
        self.pricer: Pricer | Inspector = Pricer(self.roads, near)
        if branch.pool is not None:
            self.pricer = Inspector(self.roads, branch.pool.without(branch.forbidden))
        self.master = Master(self.roads, clock, branch.required, target)
        self.relaxation: Relaxation | None = None
        self._start: Relaxation | None = None

    @property
    def pool(self) -> Pool | None:
        """All routes of better plans; None where they are not known one by one."""
        return self.pricer.pool if isinstance(self.pricer, Inspector) else None

    def inspect(self, pool: Pool) -> Subproblem:
        """The same subproblem, its routes priced by inspection from now on."""
        branch = replace(self.branch, pool=pool)
        other = Subproblem(self.roads, branch, self.near, self.clock, self.target)
        assert self.relaxation is not None
        assert isinstance(other.pricer, Inspector)
        known = other.pricer.price(self.relaxation.duals.at_no_floor(), self.clock)
        other.master.add([(), *known.routes])
        every = frozenset(range(len(self.near)))
        nodes = dict.fromkeys(cut.nodes for cut in self.master.cuts)
        other.master.add_cuts([Cut(three, every) for three in nodes])
        return other

    @property
    def bound(self) -> float:
        """The lowest bound so far."""
        return np.inf if self.relaxation is None else self.relaxation.value

    def follow(self, parent: Subproblem) -> None:
        """Take over routes, cuts, multipliers and the half-way point."""
        self._start = parent._start
        if isinstance(self.pricer, Pricer) and isinstance(parent.pricer, Pricer):
            self.pricer.half = parent.pricer.half
        self.start_from(parent.master.routes, parent.master.cuts)

    def start_from(self, routes: Iterable[Route], cuts: list[Cut]) -> None:
        """Take over routes and cuts."""
        self.master.add([(), *(r for r in routes if is_forgetful(self.near, r))])
        if cuts:
            self.master.add_cuts(cuts)

    def relax(self, on_bound: Callable[[float], None]) -> bool:
        """Solve the relaxation, growing neighbourhoods as far as they help.

        Returns whether it converged.
        """
        share = LOOSE if self.pool is None else TIGHT
        while True:
            relaxation = generate(
                self.master,
                self.pricer,
                self.clock,
                start=self._start and self._start.with_cuts(self.master.cuts),
                share=share,
                target=self.target,
                on_bound=on_bound,
            )
            if relaxation is None:
                return False
            self._start = relaxation
            if relaxation.value <= self.bound:
                self.relaxation = relaxation
            if not relaxation.has_converged or self.bound <= self.target():
                return False
            self.strike_off()
            if self.pool is not None:
                return True
            routes, _ = self.solution()
            if grow(self.near, routes, _MOST_NEIGHBOURS):
                self.forget_cycles()
                share = LOOSE
            elif share == TIGHT:
                return True
            else:
                share = TIGHT

    def forget_cycles(self) -> None:
        """Replace routes that come back to what they now remember by routes that do not."""
        assert self.relaxation is not None
        gap = self.relaxation.value - self.target()
        banned = self.master.ban(lambda route: not is_forgetful(self.near, route))
        for k in banned:
            if self.master.reduced_profit(k, self.relaxation.duals) > -gap:
                route = self.master.routes[k]
                self.master.add(
                    [tuple(dict.fromkeys(route)), tuple(dict.fromkeys(route[::-1]))[::-1]]
                )

    def strike_off(self) -> None:
        """Forbid legs or routes of no better plan; of no effect on the bound of those that are."""
        assert self.relaxation is not None
        floors = self.relaxation.best - (self.relaxation.value - self.target())
        floors -= 1e-9 * max(1.0, abs(self.relaxation.value))
        if isinstance(self.pricer, Inspector):
            self.pricer.strike_off(self.relaxation.duals, floors)
            return
        useless = self.pricer.useless_legs(self.relaxation.duals, floors)
        self.branch = replace(self.branch, forbidden=self.branch.forbidden | useless)
        self.roads = self.pricer.roads = self.roads.without(useless)

    def solution(self) -> tuple[list[Route], Floats]:
        """Routes of the last solution of the master problem, and their shares."""
        used = np.flatnonzero(self.master.shares > 1e-6)
        return [self.master.routes[k] for k in used], self.master.shares[used]

    def cut(self, on_bound: Callable[[float], None]) -> bool:
        """Add cuts to a relaxation that has converged; whether they lowered the bound."""
        assert self.relaxation is not None
        if isinstance(self.pricer, Pricer) and not self.master.cuts:
            self.pricer.most_labels = max(_LABELS_WITH_CUTS, _MORE_LABELS * self.pricer.labels)
        idle = np.flatnonzero(self.relaxation.duals.price <= 0.0)
        if tuple(self.master.cuts) == self.relaxation.duals.cuts:
            self.master.remove_cuts(idle.tolist())
        routes, shares = self.solution()
        room = _CUTS_AT_ONCE
        if self.pool is None:
            room = min(room, MOST_CUTS - len(self.master.cuts))
        cuts = separate(routes, shares, len(self.near), room)
        if self.pool is not None:
            cuts = [replace(cut, memory=frozenset(range(len(self.near)))) for cut in cuts]
        if not cuts:
            return False
        self.master.add_cuts(cuts)
        before, start = self.bound, self._start
        has_converged = self.relax(on_bound)
        if isinstance(self.pricer, Pricer) and not has_converged and self.bound > self.target():
            last = len(self.master.cuts)
            self.master.remove_cuts(range(last - len(cuts), last))
            self._start = start
        return has_converged and before - self.bound > _WORTHWHILE * (before - self.target())

    def routes_of_better_plans(self) -> list[Route]:
        """Known routes through distinct nodes that are worth enough for a better plan."""
        assert self.relaxation is not None
        gap = self.relaxation.value - self.target()
        return [
            route
            for k, route in enumerate(self.master.routes)
            if len(set(route)) == len(route)
            and self.master.reduced_profit(k, self.relaxation.duals) > -gap
        ]

    def whole_routes(self) -> list[Route]:
        """Routes that the last solution sails, each as often as it does; shares are rounded."""
        routes, shares = self.solution()
        times = np.rint(shares).astype(np.int64).tolist()
        return [route for route, k in zip(routes, times, strict=True) for _ in range(k)]

    def is_whole(self) -> bool:
        """Whether the last solution is a plan."""
        return not self._doubts(1)

    def _doubts(self, count: int) -> list[list[Branch]]:
        """Divisions by the nodes and legs that the last solution leaves most in doubt."""
        branch = replace(self.branch, pool=self.pool)
        routes, shares = self.solution()
        size = len(self.near)
        nodes = doubtful_nodes(routes, shares, size, count)
        legs = doubtful_legs(routes, shares, size, count)
        return [by_node(branch, k) for k in nodes] + [by_leg(branch, leg) for leg in legs]

    def node_left_out(self) -> int | None:
        """The node with most data that the last solution could visit and does not."""
        left = self._within_reach()
        left[[node for route in self.whole_routes() for node in route]] = False
        left[list(self.branch.required)] = False
        rest = np.flatnonzero(left).tolist()
        return max(rest, key=self.roads.profit.__getitem__, default=None)

    def all_data(self) -> float:
        """Data of all nodes that routes can visit."""
        return float(self.roads.profit[self._within_reach()].sum()) * (1.0 + 1e-12)

    def _within_reach(self) -> Booleans:
        inner = np.asarray(np.isfinite(self.roads.leg).any(axis=0))
        if self.pool is not None:
            inner &= np.asarray(self.pool.visits.sum(axis=1) > 0.0)
        inner[[0, -1]] = False
        return inner

    def branches(self) -> list[Branch]:
        """Two subproblems that share all plans of this one between them; none if it is whole."""
        doubts = self._doubts(_CANDIDATES)
        if not doubts and self.roads.toll:
            node = self.node_left_out()
            return [] if node is None else by_node(replace(self.branch, pool=self.pool), node)
        stops = stops_of(self.master.routes)

        def loss(half: Branch) -> float | None:
            banned = taking(stops, half.forbidden & ~self.branch.forbidden)
            value = self.master.trial(banned, half.required - self.branch.required)
            return None if value is None else max(self.master.objective - value, 0.0)

        return most_telling(doubts, loss)
