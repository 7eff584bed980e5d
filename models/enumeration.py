r"""Complete enumeration: every node set that one AUV can take, then the best choice of them.

For every set S of nodes and every last node k the least time d(S, k) follows from smaller sets as
in `fiveroute.models.brute_force`, but only sets within reach are kept: those from whose last node
the destination can still be reached in time. With the quickest route of every set, the problem is

    max  sum_i rho_i y_i
    s.t. y_i <= sum over S with i in S of lambda_S <= 1     for every sensor node i
         sum over S of class >= c of lambda_S <= sum_(c' >= c) M_c'      for every class c
         lambda binary, 0 <= y <= 1,

the class of a set being the first budget that is long enough for it. Where legs and services
fulfil the triangle inequality, a node can be left out of a route without making it longer. Sets of
more nodes then make those of fewer superfluous, the second half of the first row goes, and a node
on several routes stays on one of them.

It shares no code with the column generation but the problem: the simple second opinion wherever
routes are short, some 10 to 12 nodes. Beyond `MOST_PARTIAL` partial routes it gives up and
leaves a quick bound.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, eye_array, hstack

from fiveroute.limits import Clock, Limits, ProgressCallback
from fiveroute.models.bounds import Effort, quick_bound
from fiveroute.models.common_divisor import common_divisor
from fiveroute.models.greedy_plan import offer_greedy_plan
from fiveroute.models.highs import Outcome, Program
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.network import Network
from fiveroute.models.unreduced import UNREDUCED
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["MOST_PARTIAL", "solve", "supports"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

MOST_PARTIAL = 1_000_000
"""Partial routes, pairs of a set and its last node, after which enumeration gives up."""

_BITS = 62  # nodes in a word
_SAFE = 1.0 + 1e-11  # limits grow by this factor: the order of a sum must not cost a route
_METRIC = 1e-14  # share of the horizon by which a detour may be shorter, through rounding
_MARGIN = 1e-7  # what HiGHS may be wrong by, in units of the data


def supports(problem: TeamOrienteering) -> bool:
    """Any problem, though only those with short routes get more than a quick bound."""
    return True


def solve(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Plan | None = None,
    progress: ProgressCallback | None = None,
) -> Result:
    """Best plan of all, or a quick bound where there are too many routes.

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
    incumbent = Incumbent(problem, "enumeration", limits, warm_start=warm_start, progress=progress)
    network = Network.of(problem)
    if network.has_no_route:
        return incumbent.infeasible()
    if incumbent.must_stop:
        return incumbent.result()
    incumbent.lower(quick_bound(problem, incumbent.clock.rest(), effort=Effort.LEAST).value)
    offer_greedy_plan(incumbent, problem.profit)
    if incumbent.must_stop:
        return incumbent.result()
    layers = _enumerate(network, incumbent.clock)
    if layers is None:
        return incumbent.result()
    choice = _Choice(network, layers, incumbent)
    if choice.solve() is Outcome.INFEASIBLE and incumbent.plan is None:
        return incumbent.infeasible()
    return incumbent.result()


@dataclass(frozen=True, slots=True, eq=False)
class _Layer:
    """All partial routes of one length: sets as words of bits, last node, time, the one before."""

    words: Ints
    last: Ints
    time: Floats
    parent: Ints

    def best(self, home: Floats) -> Ints:
        """Places of the partial routes that are quickest home, one a set."""
        order = np.lexsort((self.time + home[self.last], *self.words.T))
        return order[_firsts(self.words[order])]


def _enumerate(network: Network, clock: Clock) -> list[_Layer] | None:
    """All partial routes, layer by layer, the empty one first; None if time or room ends."""
    problem = network.problem
    leg = problem.travel + problem.service
    horizon = float(problem.allowed.max()) * _SAFE
    words = np.zeros((1, problem.n // _BITS + 1), dtype=np.int64)
    zero = np.zeros(1, dtype=np.int64)
    layers = [_Layer(words, zero, np.zeros(1), zero - 1)]
    count = 1
    while problem.n and len(layers[-1].last):
        parts = []
        for part in _extensions(layers[-1], leg, horizon - network.remaining * (1.0 - 1e-12)):
            parts.append(part)
            count += len(part.last)
            if clock.expired or count > MOST_PARTIAL:
                return None
        layers.append(_together(parts))
    return layers[:-1] if problem.n else layers


def _extensions(layer: _Layer, leg: Floats, latest: Floats) -> Iterator[_Layer]:
    """Partial routes with one node more, a last node at a time; of equal sets the quickest."""
    for node in range(1, len(leg) - 1):
        word, bit = node // _BITS, 1 << (node % _BITS)
        time = layer.time + leg[layer.last, node]
        fits = (time <= latest[node]) & (layer.words[:, word] & bit == 0)
        parent = np.flatnonzero(fits)
        words = layer.words[parent]
        words[:, word] |= bit
        order = np.lexsort((time[parent], *words.T))
        kept = order[_firsts(words[order])]
        yield _Layer(words[kept], np.full(len(kept), node), time[parent][kept], parent[kept])


def _together(parts: list[_Layer]) -> _Layer:
    names = ("words", "last", "time", "parent")
    return _Layer(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def _firsts(rows: Ints) -> NDArray[np.bool_]:
    """Which of sorted rows differ from the one before."""
    first = np.ones(len(rows), dtype=np.bool_)
    first[1:] = (rows[1:] != rows[:-1]).any(axis=1)
    return first


class _Choice:
    """The programme that chooses among the sets."""

    def __init__(self, network: Network, layers: list[_Layer], incumbent: Incumbent) -> None:
        self.problem, self.layers, self.incumbent = network.problem, layers, incumbent
        self.network = network
        self.limits = np.unique(self.problem.allowed) * _SAFE
        self.is_metric = _is_metric(self.problem)
        self.places, classes, visits = self._sets()
        self.unit = common_divisor(self.problem.profit) or float(self.problem.profit.max()) or 1.0
        self.program = Program(
            incumbent.clock,
            maximise=True,
            on_progress=lambda _, bound: self._lower(bound),
            on_solution=self._offer,
        )
        self._build(classes, visits)

    def solve(self) -> Outcome:
        """Solve, and report plans and bounds."""
        self.program.require_integers(True)
        self.program.set("mip_rel_gap", self.incumbent.clock.limits.gap)
        self.program.set("mip_abs_gap", 0.0)
        for option, value in UNREDUCED.items():
            self.program.set(option, value)
        outcome = self.program.solve()
        if self.program.has_solution:
            self._offer(self.program.values)
        if outcome is not Outcome.INFEASIBLE:
            self._lower(self.program.bound)
        return outcome

    def _sets(self) -> tuple[Ints, Ints, csr_array]:
        """Layer and place of the sets worth choosing, their classes and members."""
        home = self.problem.travel[:, -1]
        sets = []
        longer: tuple[Ints, Ints] | None = None
        for depth in range(len(self.layers) - 1, -1, -1):
            layer = self.layers[depth]
            places = layer.best(home)
            duration = layer.time[places] + home[layer.last[places]]
            classes = np.searchsorted(self.limits, duration)
            fits = classes < len(self.limits)
            places, classes = places[fits], classes[fits]
            words = layer.words[places]
            used = np.ones(len(places), dtype=np.bool_)
            if self.is_metric and longer is not None:
                used = classes < _least_class_above(words, *longer, self.problem.n)
            longer = words, classes
            sets.append((np.full(used.sum(), depth), places[used], classes[used], words[used]))
        depths, places, classes, words = (
            np.concatenate([part[k] for part in sets]) for k in range(4)
        )
        node = np.arange(1, self.problem.n + 1)
        member = words[:, node // _BITS] >> (node % _BITS) & 1
        return np.column_stack([depths, places]), classes, csr_array(member.T.astype(np.float64))

    def _build(self, classes: Ints, visits: csr_array) -> None:
        n, count = visits.shape
        above = self.network.routes[::-1].cumsum()[::-1]
        least = np.full(len(above), -np.inf)
        if self.problem.travel[0, -1] > self.limits[0]:
            least[0] = above[0]  # some AUV cannot sail straight to the destination
        most = np.where(self.places[:, 0] == 0, float(self.problem.fleet_size), 1.0)
        self.program.add_columns(np.zeros(count), 0.0, most, integer=True)
        self.program.add_columns(self.problem.profit[1:-1] / self.unit, 0.0, 1.0)
        self.program.add_rows(csr_array(hstack([-visits, eye_array(n)])), -np.inf, 0.0)
        if not self.is_metric:
            self.program.add_rows(csr_array(hstack([visits, csr_array((n, n))])), -np.inf, 1.0)
        column = np.repeat(np.arange(count), classes + 1)
        row = np.concatenate([np.arange(c + 1) for c in classes] or [np.zeros(0, np.int64)])
        fleet = coo_array((np.ones(len(row)), (row, column)), shape=(len(above), count + n))
        self.program.add_rows(csr_array(fleet), least, above)

    def _lower(self, bound: float | None) -> None:
        if bound is not None and np.isfinite(bound):
            self.incumbent.lower(max((bound + _MARGIN) * self.unit, self.incumbent.objective))

    def _offer(self, values: Floats) -> None:
        times = np.rint(values[: len(self.places)]).astype(np.int64)
        chosen = np.repeat(np.arange(len(times)), times)
        if len(chosen) > self.problem.fleet_size:
            return
        routes = sorted(
            (self._route(int(k)) for k in chosen), key=self.problem.duration, reverse=True
        )
        plan: list[Route] = [()] * self.problem.fleet_size
        visited: set[int] = set()
        auvs = np.argsort(-self.problem.budgets, kind="stable").tolist()
        for auv, route in zip(auvs, routes, strict=False):
            plan[auv] = tuple(node for node in route if node not in visited)
            visited |= set(route)
        self.incumbent.offer(Plan(tuple(plan)))

    def _route(self, k: int) -> Route:
        depth, place = (int(v) for v in self.places[k])
        nodes = []
        while depth > 0:
            layer = self.layers[depth]
            nodes.append(int(layer.last[place]))
            place, depth = int(layer.parent[place]), depth - 1
        return tuple(reversed(nodes))


def _least_class_above(words: Ints, longer: Ints, classes: Ints, n: int) -> Ints:
    """Least class of the sets `longer` that hold one node more than each of `words`."""
    least = np.full(len(words), np.iinfo(np.int64).max)
    for node in range(1, n + 1):
        word, bit = node // _BITS, 1 << (node % _BITS)
        having = np.flatnonzero(longer[:, word] & bit)
        fewer = longer[having]
        fewer[:, word] ^= bit
        place = _places(fewer, words)
        known = place >= 0
        np.minimum.at(least, place[known], classes[having][known])
    return least


def _places(rows: Ints, among: Ints) -> Ints:
    """Where each row stands among different others; -1 if it is none of them."""
    if not len(among):
        return np.full(len(rows), -1)
    known = np.ones(len(rows), dtype=np.bool_)
    key, other = np.zeros(len(rows), dtype=np.int64), np.zeros(len(among), dtype=np.int64)
    for w in range(among.shape[1]):  # one number a row: ranks among the prefixes that occur
        place, rank = _ranks(rows[:, w], among[:, w])
        known &= place >= 0
        width = len(among) + 1
        place, other = _ranks(key * width + place, other * width + rank)
        known &= place >= 0
        key = place
    where = np.empty(len(among), dtype=np.int64)
    where[other] = np.arange(len(among))
    return np.where(known, where[key], -1)


def _ranks(values: Ints, others: Ints) -> tuple[Ints, Ints]:
    """Ranks among the distinct `others`, -1 for values that are none of them; and their own."""
    table = np.unique(others)
    place = np.minimum(np.searchsorted(table, values), len(table) - 1)
    return np.where(table[place] == values, place, -1), np.searchsorted(table, others)


def _is_metric(problem: TeamOrienteering) -> bool:
    """Whether no detour over a node, served there, is quicker than the direct leg."""
    slack = _METRIC * float(problem.allowed.max())
    return all(
        bool(
            (
                problem.travel
                <= problem.travel[:, [k]] + problem.service[k] + problem.travel[[k]] + slack
            ).all()
        )
        for k in range(1, problem.n + 1)
    )
