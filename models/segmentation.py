"""Segmentation of the giant route exactly: where to cut R_0 so that the AUVs share it evenly.

The giant route R_0 is cut into M consecutive segments, (13) and (15) of the paper, and
T(R_i) is the full time of AUV i: from the start to its segment, along it with all
services, and on to the destination. With T' the mean of the T(R_i), the cut minimises

    squared    sum_i (T(R_i) - T')^2
    absolute   sum_i |T(R_i) - T'|
    minmax     max_i T(R_i)

Equation (18) as printed, sum_i (T(R_i) - T'), is zero for every cut: squares are the
reading taken by default.

*Squared* is a bicriteria problem in disguise. Since the mean is the best common target,
the optimum is min over c of min over cuts of sum_i (T_i - c)^2, and the optimal cut is
optimal for c = its own mean. For a fixed c a dynamic programme finds the best cut. Its
value less M c^2 is a minimum of functions linear in c, one per cut, hence concave: over
an interval of c it lies above its chord, which bounds every cut that is optimal inside,
and two cuts optimal at the two ends cross at the one c where another may beat both.
Following the crossings finds every cut that can be optimal for any c.

*Minmax* is a bisection over the limit on all T_i, and ties are broken by sum_i T_i^2.
*Absolute* has its own module, `fiveroute.models.absolute_balance`.

References
----------
M. J. Eisner and D. G. Severance, "Mathematical techniques for efficient record
segmentation in large shared databases", J. ACM 23(4), 1976, doi 10.1145/321978.321982
(the search over crossings).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

__all__ = ["Balance", "imbalance", "segment"]

Times = NDArray[np.float64]
Offsets = NDArray[np.int64]

_ROUNDING = 1e-12
"""Relative difference that floating-point sums of this kind cannot tell from zero."""


class Balance(StrEnum):
    """What it means that the AUVs share the giant route evenly."""

    SQUARED = "squared"
    ABSOLUTE = "absolute"
    MINMAX = "minmax"


def segment(
    problem: TeamOrienteering,
    giant_route: Route,
    fleet_size: int,
    balance: Balance = Balance.SQUARED,
) -> tuple[Route, ...]:
    """Cut a giant route into one sub-route per AUV, as evenly as possible.

    Parameters
    ----------
    problem
        Gives the times; its budgets play no part (the paper's Section III-A).
    giant_route
        R_0, or any other route.
    fleet_size
        Number M of sub-routes.
    balance
        The measure of evenness. `SQUARED` and `MINMAX` are optimal for every size,
        `ABSOLUTE` as its module says.

    Returns
    -------
    tuple of Route
        M routes, which joined give the giant route. None is empty unless there are fewer
        nodes than AUVs; then every node is a route and the surplus routes are empty.
    """
    if fleet_size < 1:
        raise InputError("a fleet has at least one AUV", field="fleet_size", value=fleet_size)
    count = len(giant_route)
    if fleet_size >= count:
        single = tuple((node,) for node in giant_route)
        return single + ((),) * (fleet_size - count)
    enter, leave = _ends(problem, giant_route)
    ends = _METHODS[balance](enter, leave, fleet_size)
    stops = [0, *(ends + np.arange(1, fleet_size + 1)).tolist()]
    return tuple(giant_route[a:b] for a, b in pairwise(stops))


def imbalance(times: NDArray[np.float64], balance: Balance = Balance.SQUARED) -> float:
    """How uneven route times are: the objective that `segment` minimises.

    Parameters
    ----------
    times
        Times T(R_i) in seconds, shape (M,).
    balance
        The measure.
    """
    away = times - times.mean()
    match balance:
        case Balance.SQUARED:
            return float(away @ away)
        case Balance.ABSOLUTE:
            return float(np.abs(away).sum())
        case Balance.MINMAX:
            return float(times.max())


@dataclass(frozen=True, slots=True)
class Cut:
    """A cut of the giant route and what it is worth.

    Parameters
    ----------
    ends
        Offsets of the ends, shape (M,), see `fiveroute.models.cut_kernels`.
    mean
        Mean time of the segments in seconds.
    scatter
        Sum of the squared deviations from it.
    """

    ends: Offsets
    mean: float
    scatter: float

    @classmethod
    def of(cls, enter: Times, leave: Times, ends: Offsets) -> Cut:
        """Measure a cut."""
        from fiveroute.models.cut_kernels import segment_times

        times = segment_times(enter, leave, ends)
        return cls(ends, float(times.mean()), imbalance(times))

    def spread(self, target: float) -> float:
        """Sum of the squared deviations from a common target."""
        return self.scatter + len(self.ends) * (target - self.mean) ** 2


def promising_cuts(enter: Times, leave: Times, segments: int) -> Iterator[Cut]:
    """Cuts that are optimal for some common target, the least scattered of all among them."""
    from fiveroute.models.cut_kernels import cut_at_target

    def optimal(target: float) -> tuple[float, Cut]:
        return target, Cut.of(enter, leave, cut_at_target(enter, leave, segments, target))

    shortest = float((leave + np.minimum.accumulate(enter)).min())
    longest = float((leave + np.maximum.accumulate(enter)).max())
    left, right = optimal(shortest), optimal(longest)
    yield from (left[1], right[1])
    least = min(left[1].scatter, right[1].scatter)
    intervals = [(left, right)]
    while intervals:
        (low, below), (high, above) = intervals.pop()
        if above.mean - below.mean <= _ROUNDING * abs(above.mean):
            continue  # one and the same line: nothing lies under it in between
        value = (below.spread(low), above.spread(high))
        if _chord_bound(low, high, value, segments) >= least * (1.0 - _ROUNDING):
            continue
        crossing = (below.mean + above.mean) / 2.0 + (above.scatter - below.scatter) / (
            2.0 * segments * (above.mean - below.mean)
        )
        between = optimal(min(max(crossing, low), high))
        yield between[1]
        least = min(least, between[1].scatter)
        if between[1].spread(crossing) < below.spread(crossing) * (1.0 - _ROUNDING):
            intervals += [((low, below), between), (between, (high, above))]


def _chord_bound(low: float, high: float, value: tuple[float, float], segments: int) -> float:
    """Least value over [low, high] of a concave function plus M c^2, known at both ends.

    With c = low + s (high - low), the chord plus M c^2 is
    (1 - s) value[0] + s value[1] - M s (1 - s) (high - low)^2.
    """
    curvature = segments * (high - low) ** 2
    s = 0.5 - (value[1] - value[0]) / (2.0 * curvature) if curvature > 0.0 else 0.0
    s = min(max(s, 0.0), 1.0)
    return (1.0 - s) * value[0] + s * value[1] - s * (1.0 - s) * curvature


def _squared(enter: Times, leave: Times, segments: int) -> Offsets:
    best = min(promising_cuts(enter, leave, segments), key=lambda cut: cut.scatter)
    return best.ends


def _minmax(enter: Times, leave: Times, segments: int) -> Offsets:
    """Bisect the limit between one that no cut keeps and the longest time of a known cut."""
    from fiveroute.models.cut_kernels import cut_below, cut_least_squares, segment_times

    unreachable, reached = -1.0, float((leave + np.maximum.accumulate(enter)).max())
    while unreachable < (limit := (unreachable + reached) / 2.0) < reached:
        ends = cut_below(enter, leave, segments, limit)
        if ends.size:
            reached = float(segment_times(enter, leave, ends).max())
        else:
            unreachable = limit
    best: Offsets = cut_least_squares(enter, leave, segments, reached)
    return best


def _absolute(enter: Times, leave: Times, segments: int) -> Offsets:
    from fiveroute.models.absolute_balance import AbsoluteSearch

    cuts = [cut.ends for cut in promising_cuts(enter, leave, segments)]
    search = min((AbsoluteSearch(enter, leave, ends) for ends in cuts), key=lambda s: s.value)
    search.run()
    return search.ends


_METHODS = {Balance.SQUARED: _squared, Balance.ABSOLUTE: _absolute, Balance.MINMAX: _minmax}


def _ends(problem: TeamOrienteering, giant_route: Route) -> tuple[Times, Times]:
    """`enter` and `leave` of `fiveroute.models.cut_kernels`, each of shape (n,).

    With P_k the time from arrival at the first node to arrival at the k-th, services
    before it included: enter[a] = t(start, r_a) - P_a, and leave[b] = P_b + t_b +
    t(r_b, destination).
    """
    nodes = np.array(giant_route)
    service = problem.service[nodes]
    legs = problem.travel[nodes[:-1], nodes[1:]]
    arrival = np.concatenate(([0.0], np.cumsum(legs + service[:-1])))
    enter: Times = problem.travel[0, nodes] - arrival
    leave: Times = arrival + service + problem.travel[nodes, problem.destination]
    return enter, leave
