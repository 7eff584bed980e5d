"""Branch and cut for the giant route: from a relaxation to a proof.

A subproblem fixes some links at one and some at zero. It is bounded by the relaxation of
`fiveroute.models.tour_relaxation`, to which violated inequalities are added as long as any
are found. It is done when its bound reaches the cutoff, below which a route would have to
lie to be worth finding, or when the relaxation is itself a route; otherwise it is split on
a fractional link. Of a few links near one half, the one is taken that lifts both bounds
most in a short trial. The subproblem with the lowest bound comes next.

A link whose reduced cost carries the bound beyond the cutoff is fixed; found at the first
subproblem, it is dropped for good, again after every better route.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock
from fiveroute.models.highs import Outcome
from fiveroute.models.tour_cuts import Pairs, violated_cuts
from fiveroute.models.tour_descent import good_route, nearest_neighbours
from fiveroute.models.tour_relaxation import Links, TourRelaxation
from fiveroute.problem import TeamOrienteering
from fiveroute.result import PROOF_TOLERANCE
from fiveroute.routes import Route

__all__ = ["BranchAndCut", "Incumbent"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_INTEGRAL = 1e-6
"""Distance to the nearest integer that counts as none."""

_CANDIDATES = 4
"""Links tried before a subproblem is split."""

_ROUNDING_EVERY = 10
"""Subproblems for each attempt to round a relaxation to a route."""

_ROUNDING_KICKS = 50
"""Random changes of the local search that follows."""

_WORTH_DROPPING = 0.9
"""Share of the links that may be left when some are dropped."""


@dataclass(slots=True)
class Incumbent:
    """The best route so far, and what it takes to beat it.

    Parameters
    ----------
    problem
        The problem.
    route
        The route.
    gap
        Relative gap that satisfies the caller.
    """

    problem: TeamOrienteering
    route: Route
    gap: float = 0.0
    _service: float = field(init=False)
    _whole: bool = field(init=False)

    def __post_init__(self) -> None:
        self._service = float(self.problem.service.sum())
        self._whole = bool((self.problem.travel == np.floor(self.problem.travel)).all())

    @property
    def duration(self) -> float:
        """Travel and service time T_0 in seconds."""
        return self.problem.duration(self.route)

    @property
    def cutoff(self) -> float:
        """Travel time that a lower bound must reach to settle that nothing better is wanted.

        Where all leg times are integers, a route is better by at least one.
        """
        travel = self.duration - self._service
        tolerance = max(0.1 * PROOF_TOLERANCE * travel, self.gap * self.duration)
        if self._whole:
            tolerance = max(tolerance, 1.0 - 2.0 * self._doubt)
        return travel - tolerance

    def proved(self, bound: float) -> float:
        """Lower bound on T_0 in seconds that follows from one on the travel time."""
        bound = min(bound, self.duration) - self._doubt
        if self._whole:
            bound = math.ceil(bound)
        return min(bound + self._service, self.duration)

    def offer(self, route: Route) -> None:
        """Take a route if it is shorter."""
        if self.problem.duration(route) < self.duration:
            self.route = route

    @property
    def _doubt(self) -> float:
        """What the rounding of long sums stays far below."""
        return 1e-10 * self.duration


@dataclass(order=True, frozen=True, slots=True)
class Subproblem:
    """Routes that use some links and avoid others, and a lower bound on their travel time."""

    bound: float
    number: int
    used: tuple[int, ...] = field(default=(), compare=False)
    avoided: tuple[int, ...] = field(default=(), compare=False)

    @property
    def is_root(self) -> bool:
        """Whether nothing is fixed yet."""
        return not self.used and not self.avoided


class BranchAndCut:
    """The search. `run` it; then the incumbent and the bound say what is known.

    Parameters
    ----------
    links
        All links that a route below the incumbent's cutoff can use.
    incumbent
        A route to begin with; it is given better ones.
    bound
        Lower bound on the travel time from elsewhere.
    clock
        When to stop.
    report
        Told the bound after every subproblem.
    """

    def __init__(
        self,
        links: Links,
        incumbent: Incumbent,
        bound: float,
        clock: Clock,
        report: Callable[[float], None],
    ) -> None:
        self._incumbent = incumbent
        self._clock = clock
        self._report = report
        self._relaxation = TourRelaxation(links, clock)
        self._pairs = Pairs.of(links.tails, links.heads, links.nodes)
        self._names = np.arange(len(links))  # which links the columns are
        self._forced = np.full(len(links), bound)  # lower bound on routes with each link
        self._waiting = [Subproblem(bound, 0)]
        self._explored = 0
        self._settled = math.inf

    @property
    def bound(self) -> float:
        """Lower bound on the travel time of every route not known yet."""
        return min([self._settled, *(subproblem.bound for subproblem in self._waiting)])

    def run(self) -> None:
        """Go on until every subproblem is settled or the clock expires."""
        while self._waiting and not self._clock.expired:
            subproblem = heapq.heappop(self._waiting)
            used = self._columns(subproblem.used)
            if subproblem.bound >= self._incumbent.cutoff:
                self._settle(subproblem.bound)
            elif len(used) < len(subproblem.used):  # one is known to lead beyond the cutoff
                self._settle(self._incumbent.cutoff)
            else:
                self._explore(subproblem, used)
            self._report(self.bound)

    def _settle(self, bound: float) -> None:
        self._settled = min(self._settled, bound)

    def _columns(self, links: tuple[int, ...]) -> Integers:
        """Where those of the links stand that have not been dropped."""
        return np.flatnonzero(np.isin(self._names, links))

    def _explore(self, subproblem: Subproblem, used: Integers) -> None:
        lower, upper = np.zeros(len(self._names)), np.ones(len(self._names))
        lower[used] = 1.0
        upper[self._columns(subproblem.avoided)] = 0.0
        bound, values = self._relax(subproblem, lower, upper)
        if self._clock.expired:
            heapq.heappush(self._waiting, replace(subproblem, bound=bound))
            return
        if values is None:
            self._settle(bound)
            return
        loose = np.minimum(values, 1.0 - values)
        route_found = loose.max() <= _INTEGRAL
        if route_found:
            self._settle(bound)
        else:
            link = int(self._names[self._choose(loose, bound)])
            self._split(subproblem, bound, link)
        if route_found or self._explored % _ROUNDING_EVERY == 0:
            self._round(values)
        self._explored += 1
        self._drop()

    def _relax(
        self, subproblem: Subproblem, lower: Floats, upper: Floats
    ) -> tuple[float, Floats | None]:
        """Bound a subproblem, cutting as long as there are cuts.

        Returns the bound, and the link values where it leaves anything to be split.
        """
        bound = subproblem.bound
        while True:
            self._relaxation.restrict(lower, upper)
            outcome = self._relaxation.solve()
            if outcome is Outcome.INFEASIBLE and self._relaxation.proves_infeasibility():
                return math.inf, None
            if outcome is not Outcome.OPTIMAL:
                return bound, None
            value, reduced = self._relaxation.certify()
            bound = max(bound, value)
            if subproblem.is_root:
                self._forced = np.where(upper > 0.0, value + np.maximum(reduced, 0.0), math.inf)
            if bound >= self._incumbent.cutoff or self._clock.expired:
                return bound, None
            values = self._relaxation.values
            cuts = violated_cuts(self._pairs, values, self._clock)
            if not cuts:
                return bound, values
            self._relaxation.add(cuts)
            room = self._incumbent.cutoff - value
            upper[(reduced > room) & (lower == 0.0)] = 0.0
            lower[(reduced < -room) & (upper == 1.0)] = 1.0

    def _choose(self, loose: Floats, bound: float) -> int:
        """The link to split on: of the loosest ones, that which lifts both bounds most."""
        candidates = np.argsort(-loose, kind="stable")[:_CANDIDATES]
        candidates = candidates[loose[candidates] > _INTEGRAL]
        room = max(self._incumbent.cutoff - bound, 0.0)
        gains = []
        for candidate in candidates:
            lifted = [self._relaxation.trial(candidate, value) - bound for value in (0.0, 1.0)]
            gains.append(math.prod(min(max(gain, 1e-6 * room), room) for gain in lifted))
        return int(candidates[int(np.argmax(gains))])

    def _split(self, subproblem: Subproblem, bound: float, link: int) -> None:
        used, avoided = subproblem.used, subproblem.avoided
        number = 2 * self._explored
        for half in (
            Subproblem(bound, number + 1, used, (*avoided, link)),
            Subproblem(bound, number + 2, (*used, link), avoided),
        ):
            heapq.heappush(self._waiting, half)

    def _round(self, values: Floats) -> None:
        """Follow links of high value from the start, and improve the route that results."""
        links, problem = self._relaxation.links, self._incumbent.problem
        unit = float(links.times.mean()) or 1.0  # links of no time are still to be followed
        lessened = (1.0 - values) * links.times - values * unit
        times = problem.travel.copy()
        times[links.tails, links.heads] = lessened
        if links.symmetric:
            times[links.heads, links.tails] = lessened
        times.setflags(write=False)
        first = tuple(nearest_neighbours(times).tolist())
        self._incumbent.offer(good_route(problem, self._clock, first, _ROUNDING_KICKS))

    def _drop(self) -> None:
        """Drop the links that no route below the cutoff can use, if they are many."""
        kept = np.flatnonzero(self._forced < self._incumbent.cutoff)
        if len(kept) < _WORTH_DROPPING * len(self._names):
            self._relaxation.keep(kept)
            self._names, self._forced = self._names[kept], self._forced[kept]
            links = self._relaxation.links
            self._pairs = Pairs.of(links.tails, links.heads, links.nodes)
