"""Confirm a bound from its certificate, slowly and simply.

A certificate states multipliers pi_i >= 0 of the sensor nodes and, for every class c of equal
AUVs, the most that one of its routes is worth: best_c >= sum of (rho_i - pi_i) over the nodes of
any route within the budget T_c. For any plan, whose routes r_m visit every node at most once,

    sum_m rho(r_m) = sum_m sum_(i in r_m) (rho_i - pi_i) + sum over visited i of pi_i
                   <= sum_c M_c best_c + sum_i pi_i.

What is left to show is that no route is worth more than claimed. Partial routes grow from the start
in order of time. A partial route remembers at node i those visited nodes that have stayed among the
neighbours listed for all nodes since, and may visit again what it forgot; that only allows more.
One that takes longer, is worth less and remembers all that another does is dropped, and so is
one that cannot become worth more than claimed: the most that can still be collected is bounded by
walks on a grid of time steps, leg times rounded down, that do not turn straight back.

Nothing of the column generation is used here. The arithmetic is that of doubles: a route
may be worth more than claimed by `TOLERANCE`, relative to the bound, and that much is added to it.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.limits import Clock, Limits
from fiveroute.problem import TeamOrienteering

__all__ = ["TOLERANCE", "Verdict", "check_certificate"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

TOLERANCE = 1e-9
"""Part of the bound by which a route may be worth more than claimed."""

_FORMAT = "fiveroute root bound 1"
_LARGEST = 1e200  # of the claims, so that their sums are finite
_STEPS = 500
_SAFE = 1.0 + 1e-11  # budgets grow by this factor: the order of a sum must not cost a route


@dataclass(frozen=True, slots=True)
class Verdict:
    """What the check found.

    Parameters
    ----------
    confirmed
        Whether no route is worth more than claimed; false as well when stopped.
    bound
        The bound on the data of all plans, rounded up; only of use if confirmed.
    excess
        How much more than claimed a route was found to be worth, in data; 0 without one.
    route
        That route, empty without one; it may come back to a node that it forgot.
    labels
        Number of partial routes looked at.
    """

    confirmed: bool
    bound: float
    excess: float
    route: tuple[int, ...]
    labels: int


@dataclass(frozen=True, slots=True, eq=False)
class _Claim:
    """The certificate, read and found complete."""

    multipliers: Floats
    neighbours: list[frozenset[int]]
    worth: list[float]


def check_certificate(
    problem: TeamOrienteering, document: Mapping[str, Any], limits: Limits | None = None
) -> Verdict:
    """Confirm a certificate, or find a route that refutes it.

    Parameters
    ----------
    problem
        The problem that it is about.
    document
        The certificate, a JSON document.
    limits
        When to stop; None without any limit.

    Raises
    ------
    InputError
        If the document is no certificate for a problem of this size.
    """
    clock = (limits or Limits()).start()
    claim = _read(problem, document)
    budgets, auvs = np.unique(problem.allowed, return_counts=True)
    terms = [*claim.multipliers.tolist()]
    terms += [k * worth for k, worth in zip(auvs.tolist(), claim.worth, strict=True)]
    slack = TOLERANCE * max(1.0, math.fsum(map(abs, terms)))
    bound = math.fsum(terms) + problem.fleet_size * slack
    search = _Search(problem, claim, (budgets * _SAFE).tolist(), slack)
    excess, route = search.run(clock)
    confirmed = search.is_complete and excess <= slack
    return Verdict(confirmed, bound, max(excess, 0.0), route, search.count)


def _read(problem: TeamOrienteering, document: Mapping[str, Any]) -> _Claim:
    """Check every field of the document."""
    if document.get("format") != _FORMAT:
        raise InputError(
            f"must be {_FORMAT!r}; no certificate of a bound",
            field="format",
            value=document.get("format"),
        )
    n, classes = problem.n, len(np.unique(problem.allowed))
    multipliers = _numbers(document, "multipliers", n)
    if any(value < 0.0 for value in multipliers):
        raise InputError("must not be negative", field="multipliers", value=min(multipliers))
    worth = _numbers(document, "worth", classes)
    lists = document.get("neighbours")
    if not isinstance(lists, list) or len(lists) != n:
        raise InputError(f"must be {n} lists of nodes", field="neighbours", value=lists)
    for k, nodes in enumerate(lists):
        whole = isinstance(nodes, list) and all(isinstance(i, int) for i in nodes)
        if not whole or not all(1 <= i <= n for i in nodes):
            raise InputError(f"must list nodes 1 to {n}", field=f"neighbours[{k}]", value=nodes)
    neighbours = [frozenset(), *map(frozenset, lists), frozenset()]
    return _Claim(np.array(multipliers), neighbours, worth)


def _numbers(document: Mapping[str, Any], field: str, count: int) -> list[float]:
    values = document.get(field)
    if not isinstance(values, list) or len(values) != count:
        raise InputError(f"must be a list of {count} numbers", field=field, value=values)
    if not all(type(v) in (int, float) and -_LARGEST <= v <= _LARGEST for v in values):
        raise InputError(f"must all be numbers up to {_LARGEST:g}", field=field, value=values)
    return [float(value) for value in values]


class _Search:
    """All partial routes that might refute the claim."""

    def __init__(
        self, problem: TeamOrienteering, claim: _Claim, limits: list[float], slack: float
    ) -> None:
        self.end = problem.destination
        self.gain = problem.profit - np.pad(claim.multipliers, 1)
        self.leg = problem.travel + problem.service
        self.claim, self.limits, self.slack = claim, limits, slack
        self.floors = [worth + slack for worth in claim.worth]
        self.nodes = self._worth_a_visit(problem)
        self.walks = self._walks_home()
        self.count = 0
        self.is_complete = False

    def run(self, clock: Clock) -> tuple[float, tuple[int, ...]]:
        """The largest excess over a claim, and its route; stop where that is too much."""
        worst = 0.0
        refuting: tuple[int, ...] = ()
        waiting: list[tuple[float, float, int, frozenset[int], tuple[int, ...]]] = []
        heapq.heappush(waiting, (0.0, 0.0, 0, frozenset(), ()))
        known: dict[int, list[tuple[float, float, frozenset[int]]]] = {k: [] for k in self.nodes}
        while waiting:
            time, loss, tail, memory, route = heapq.heappop(waiting)
            self.count += 1
            if self.count % 100 == 1 and clock.expired:
                return worst, refuting
            if tail and self._is_dropped(known[tail], time, -loss, memory):
                continue
            for auv_class, limit in enumerate(self.limits):
                if time + self.leg[tail, self.end] <= limit:
                    excess = -loss - self.claim.worth[auv_class]
                    if excess > worst:
                        worst, refuting = excess, route
                    break
            if worst > self.slack:
                return worst, refuting
            for head, then, value in self._next(time, -loss, tail, memory):
                kept = (memory & self.claim.neighbours[head]) | {head}
                heapq.heappush(waiting, (then, -value, head, kept, (*route, head)))
        self.is_complete = True
        return worst, refuting

    def _is_dropped(
        self,
        others: list[tuple[float, float, frozenset[int]]],
        time: float,
        value: float,
        memory: frozenset[int],
    ) -> bool:
        """Whether an earlier partial route does as well; it joins the others if not."""
        for _, worth, remembered in others:  # all of them are as early
            if worth >= value and remembered <= memory:
                return True
        others.append((time, value, memory))
        return False

    def _next(
        self, time: float, value: float, tail: int, memory: frozenset[int]
    ) -> Iterator[tuple[int, float, float]]:
        """Nodes to go to, with time and value there, that may refute the claim."""
        for head in self.nodes:
            if head == tail or head in memory:
                continue
            then = time + float(self.leg[tail, head])
            if self._may_refute(then, value, tail, head):
                yield head, then, value + float(self.gain[head])

    def _may_refute(self, time: float, value: float, tail: int, head: int) -> bool:
        best, after, other = self.walks
        for limit, floor in zip(self.limits, self.floors, strict=True):
            if time <= limit:
                k = min(int((limit - time) / self.limits[-1] * _STEPS + 1e-6), _STEPS)
                rest = other[k, head] if after[k, head] == tail else best[k, head]
                if value + rest > floor:
                    return True
        return False

    def _worth_a_visit(self, problem: TeamOrienteering) -> list[int]:
        """Nodes without those that gain nothing and that no detour over them is quicker for."""
        slack = 1e-14 * self.limits[-1]
        kept = []
        for k in range(1, self.end):
            over = problem.travel[:, [k]] + problem.service[k] + problem.travel[[k]]
            if self.gain[k] > 0.0 or (problem.travel > over + slack).any():
                kept.append(k)
        return kept

    def _walks_home(self) -> tuple[Floats, Ints, Floats]:
        """Most value of a walk from every node to the destination within k steps.

        The best walk, gains at both ends included, the node that it goes to first, and the
        best walk that goes elsewhere first, shape (steps + 1, n + 2). Nodes with legs shorter than
        a step between them count together: all their gains, once, for whoever enters.
        """
        step = (self.limits[-1] or 1.0) / _STEPS
        whole = np.floor(np.minimum(self.leg / step, _STEPS + 1) + 1e-9).astype(np.int64)
        cluster = _clusters(whole, self.nodes)
        best = np.full((_STEPS + 1, self.end + 1), -np.inf)
        other, after = best.copy(), np.full(best.shape, -1)
        best[:, self.end] = other[:, self.end] = 0.0
        heads = np.array([*self.nodes, self.end])
        for k in range(_STEPS + 1):
            for group in cluster:
                exits = []
                for tail in group:
                    steps = whole[tail, heads]
                    usable = (steps <= k) & ~np.isin(heads, group)
                    goal, before = heads[usable], k - steps[usable]
                    values = np.where(
                        after[before, goal] == tail, other[before, goal], best[before, goal]
                    )
                    exits.append((values, goal))
                self._enter(k, group, exits, best, after, other)
        return best, after, other

    def _enter(
        self,
        k: int,
        group: list[int],
        exits: list[tuple[Floats, Ints]],
        best: Floats,
        after: Ints,
        other: Floats,
    ) -> None:
        """Values of the nodes of a cluster from the ways out of it."""
        if len(group) > 1:
            gains = float(np.maximum(self.gain[group], 0.0).sum())
            out = max((float(values.max()) for values, _ in exits if len(values)), default=-np.inf)
            best[k, group] = other[k, group] = gains + out
            return
        (values, goal), node = exits[0], group[0]
        if len(values):
            first = int(values.argmax())
            best[k, node], after[k, node] = values[first] + self.gain[node], goal[first]
            values[first] = -np.inf
            other[k, node] = values.max() + self.gain[node]


def _clusters(whole: Ints, nodes: list[int]) -> list[list[int]]:
    """Nodes grouped by legs of no whole step."""
    groups: list[list[int]] = []
    for node in nodes:
        linked = [g for g in groups if any(whole[node, i] == 0 or whole[i, node] == 0 for i in g)]
        groups = [g for g in groups if g not in linked]
        groups.append([node, *(i for g in linked for i in g)])
    return groups
