"""One AUV among uncertain leg times, exactly on samples: the reference of S-GGARP.

K samples of all leg times stand for their distribution (sample average approximation). A
route through the nodes S in some order takes T_1 to T_K seconds in the samples, and

    maximise    sum over j in S of rho_j                         (19)
    subject to  statistic(T_1, ..., T_K) <= T_max                (6)

where the statistic is the mean or a quantile, see `fiveroute.sampling.RouteStatistic`.

*Mean.* The mean time of a route is its time over the mean legs: the problem is the
deterministic one, and goes to `fiveroute.models.circuit`.

*Quantile.* At least c = ceil(quantile K) samples must be in time, which no single leg
time expresses. A dynamic programme goes through the sets of visited nodes. For a set S and
its last node j it keeps the vectors of elapsed times of all orders that may still matter:

- a sample whose shortest way home is too late is lost, its time set to infinity, and a
  vector with fewer than c samples left is dropped;
- a vector is dropped if another one is no later in any sample: whatever follows, the other
  route collects the same and its quantile is no larger;
- a vector is dropped if even all nodes that c samples can still reach do not make up for
  the best route known.

The number of sets doubles with every node: nine nodes take a tenth of a second, fifteen up to
half a minute.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.limits import Clock, Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Route
from fiveroute.sampling import RouteStatistic, route_times

__all__ = ["MOST_NODES", "SampledResult", "solve_sampled"]

Floats = NDArray[np.float64]

MOST_NODES = 15
"""Largest number of nodes for which a quantile is optimised."""


@dataclass(frozen=True, slots=True)
class SampledResult:
    """Answer to the sampled problem.

    Parameters
    ----------
    status
        ``optimal`` unless stopped early; ``infeasible`` if no route is in time, not even
        the empty one.
    route
        The best route; None without one.
    profit
        Its data; None without a route.
    value
        Statistic of its sampled durations in seconds; None without a route. Of several
        best routes a quantile's answer has the least one.
    bound
        Upper bound on the data of any route.
    seconds
        Wall-clock time.
    """

    status: Status
    route: Route | None
    profit: float | None
    value: float | None
    bound: float
    seconds: float


def solve_sampled(
    samples: ArrayLike,
    service: ArrayLike,
    profit: ArrayLike,
    budget: float,
    statistic: RouteStatistic | None = None,
    limits: Limits | None = None,
) -> SampledResult:
    """Best route under sampled leg times.

    Parameters
    ----------
    samples
        Leg times in seconds, shape (K, n + 2, n + 2).
    service
        Service times in seconds, shape (n + 2,).
    profit
        Data, shape (n + 2,).
    budget
        Time limit T_max in seconds.
    statistic
        The figure of a route's sampled durations that must keep within it; None takes the
        mean.
    limits
        When to stop; the gap is of no use for a quantile.

    Raises
    ------
    InputError
        If the samples are no leg times, or a quantile is asked for over too many nodes.
    """
    legs = np.array(samples, dtype=np.float64)
    if legs.ndim != 3 or not len(legs) or not (np.isfinite(legs) & (legs >= 0.0)).all():
        raise InputError(
            "must be one matrix of finite, non-negative leg times per sample",
            field="samples",
            value=legs.shape,
        )
    clock = (limits or Limits()).start()
    mean = TeamOrienteering(legs.mean(axis=0), service, profit, [budget])
    if statistic is None or statistic.quantile is None:
        return _solve_mean(legs, mean, clock)
    if mean.n > MOST_NODES:
        raise InputError(
            f"a quantile is optimised over at most {MOST_NODES} nodes; take fewer, or the mean",
            field="samples",
            value=legs.shape,
        )
    search = QuantileSearch(legs, mean, statistic)
    finished = search.run(clock)
    return _answer(search, finished, clock.seconds)


def _solve_mean(legs: Floats, mean: TeamOrienteering, clock: Clock) -> SampledResult:
    from fiveroute.models import circuit

    result = circuit.solve(mean, clock.rest())
    bound = mean.total_profit if result.bound is None else result.bound
    if result.plan is None:
        return SampledResult(result.status, None, None, None, bound, clock.seconds)
    route = result.plan.routes[0]
    value = RouteStatistic().of(route_times(legs, mean.service, route))
    return SampledResult(result.status, route, result.objective, value, bound, clock.seconds)


def _answer(search: QuantileSearch, finished: bool, seconds: float) -> SampledResult:
    if search.route is None:
        if finished:
            return SampledResult(Status.INFEASIBLE, None, None, None, 0.0, seconds)
        return SampledResult(Status.NO_SOLUTION, None, None, None, search.reachable, seconds)
    status = Status.OPTIMAL if finished else Status.FEASIBLE
    bound = search.profit if finished else search.reachable
    return SampledResult(status, search.route, search.profit, search.value, bound, seconds)


@dataclass(frozen=True, slots=True, eq=False)
class Partial:
    """Orders in which a set of nodes can be visited, ending at one and the same node.

    Parameters
    ----------
    routes
        The orders.
    elapsed
        Sampled times until the service at the last node ends, shape (len(routes), K);
        infinite where the sample is lost.
    """

    routes: Sequence[Route]
    elapsed: Floats

    def take(self, places: NDArray[np.intp]) -> Partial:
        """Some of the orders."""
        return Partial([self.routes[place] for place in places], self.elapsed[places])

    def undominated(self) -> Partial:
        """Those that no other one beats or equals in every sample."""
        lost = np.isinf(self.elapsed)
        sums = np.where(lost, 0.0, self.elapsed).sum(axis=1)
        kept: list[int] = []
        for place in np.lexsort((sums, lost.sum(axis=1))):  # who beats comes before the beaten
            if not (self.elapsed[kept] <= self.elapsed[place]).all(axis=1).any():
                kept.append(int(place))
        return self.take(np.array(kept, dtype=np.intp))


class QuantileSearch:
    """The dynamic programme, one number of visited nodes after the other.

    Parameters
    ----------
    legs
        Sampled leg times in seconds, shape (K, n + 2, n + 2).
    problem
        Services, data and budget.
    statistic
        A quantile.
    """

    def __init__(self, legs: Floats, problem: TeamOrienteering, statistic: RouteStatistic) -> None:
        self.route: Route | None = None
        self.profit = 0.0
        self.value = np.inf
        self._legs, self._problem, self._statistic = legs, problem, statistic
        self._allowed = float(problem.allowed[0])
        self._needed = statistic.needed(len(legs))
        self._least = _shortest_times(legs, problem.service)
        self._tie = 1e-12 * problem.total_profit

    @property
    def reachable(self) -> float:
        """Data of all nodes on some route in time: no route collects more."""
        return float(self._within_reach(0, np.zeros((1, len(self._legs))), range(self._end))[0])

    @property
    def _end(self) -> int:
        return self._problem.destination

    def run(self, clock: Clock) -> bool:
        """Search through; False if the clock expires before."""
        layer = {(frozenset[int](), 0): Partial([()], np.zeros((1, len(self._legs))))}
        self._offer((), layer[frozenset(), 0])
        while layer:
            origins: dict[tuple[frozenset[int], int], list[tuple[int, Partial]]] = {}
            for (visited, last), partial in layer.items():
                for node in range(1, self._end):
                    if node not in visited:
                        origins.setdefault((visited | {node}, node), []).append((last, partial))
            layer = {}
            for (visited, node), partials in origins.items():
                if clock.expired:
                    return False
                partial = self._useful(visited, node, self._extended(partials, node))
                if partial.routes:
                    self._offer(visited, partial)
                    layer[visited, node] = partial
        return True

    def _extended(self, partials: Iterable[tuple[int, Partial]], node: int) -> Partial:
        """All the orders, with one more node at the end."""
        service = self._problem.service[node]
        times = [p.elapsed + self._legs[:, last, node] + service for last, p in partials]
        routes = [(*route, node) for _, p in partials for route in p.routes]
        return Partial(routes, np.concatenate(times))

    def _useful(self, visited: frozenset[int], node: int, partial: Partial) -> Partial:
        """Without lost samples, and without orders that cannot lead to the best route."""
        elapsed = partial.elapsed
        elapsed[elapsed + self._least[:, node, -1] > self._allowed] = np.inf
        enough = np.isfinite(elapsed).sum(axis=1) >= self._needed
        others = [other for other in range(1, self._end) if other not in visited]
        collected = self._problem.collected(sorted(visited))
        most = collected + self._within_reach(node, elapsed, others)
        worth = most >= self.profit - self._tie
        return partial.take(np.flatnonzero(enough & worth)).undominated()

    def _within_reach(self, node: int, elapsed: Floats, others: Sequence[int]) -> Floats:
        """Data of those other nodes that can be visited next, in enough samples."""
        places = list(others)
        detour = self._least[:, node, places] + self._least[:, places, -1]
        detour += self._problem.service[places]
        in_time = elapsed[:, :, None] + detour <= self._allowed
        gains: Floats = (in_time.sum(axis=1) >= self._needed) @ self._problem.profit[places]
        return gains

    def _offer(self, visited: Iterable[int], partial: Partial) -> None:
        """Keep the quickest of these orders if it is better than the best route."""
        profit = self._problem.collected(sorted(visited))
        last = partial.routes[0][-1] if partial.routes[0] else 0
        totals = partial.elapsed + self._legs[:, last, -1]
        values = np.partition(totals, self._needed - 1, axis=1)[:, self._needed - 1]
        route = partial.routes[int(values.argmin())]
        value = self._statistic.of(route_times(self._legs, self._problem.service, route))
        equal = abs(profit - self.profit) <= self._tie and value < self.value
        if value <= self._allowed and (equal or profit > self.profit + self._tie):
            self.route, self.profit, self.value = route, profit, value


def _shortest_times(legs: Floats, service: Floats) -> Floats:
    """Least times from leaving one vertex to arriving at another, over any nodes between.

    Floyd and Warshall's algorithm in all samples at once, shape (K, n + 2, n + 2).
    """
    least = legs.copy()
    for node in range(1, legs.shape[1] - 1):
        through = least[:, :, node, None] + service[node] + least[:, None, node, :]
        np.minimum(least, through, out=least)
    return least
