"""Whole numbers for solvers that know no others, rounded to the safe side.

Times are multiplied by s, leg and service times rounded up and budgets rounded down:

    t'_ij = ceil((1 - e) s t_ij),    b'_m = floor((1 + e) s b_m),

so that every route within b'_m takes at most (1 + e) / (1 - e) b_m. The slack e = 1e-10 keeps
whole numbers what they are in spite of rounding errors, and stays well within the tolerance of
the judge, 1e-9: what is feasible for the peer is feasible for us. A peer loses routes that are in
time by less than one unit a leg.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.problem import TeamOrienteering

__all__ = ["ScaledTimes", "scaled_profit", "scaled_times"]

_SLACK = 1e-10

Integers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class ScaledTimes:
    """Times in whole units.

    Parameters
    ----------
    travel
        Leg times, shape (n + 2, n + 2).
    service
        Service times, shape (n + 2,).
    budgets
        Time limit of every AUV, shape (M,).
    """

    travel: Integers
    service: Integers
    budgets: Integers

    @property
    def through(self) -> Integers:
        """Leg times with the service at their first end, shape (n + 2, n + 2)."""
        return self.travel + self.service[:, None]


def scaled_times(problem: TeamOrienteering, units: int) -> ScaledTimes:
    """The problem's times, the largest budget about `units` long.

    What no route could ever need is cut off at twice the units, so that sums stay in range. Times
    that are whole numbers already stay so: they are multiplied by a whole number.
    """
    longest = float(problem.budgets.max())
    times = problem.travel, problem.service, problem.budgets
    scale = units / longest if longest > 0.0 else 1.0
    if scale > 1.0 and all((values == np.rint(values)).all() for values in times):
        scale = float(np.floor(scale))
    most = 2.0 * max(longest * scale, 1.0)
    travel, service = (
        np.minimum(np.ceil((1.0 - _SLACK) * scale * values), most).astype(np.int64)
        for values in times[:2]
    )
    budgets = np.floor((1.0 + _SLACK) * scale * problem.budgets).astype(np.int64)
    return ScaledTimes(travel, service, budgets)


def scaled_profit(problem: TeamOrienteering, most: int) -> Integers:
    """Data in whole numbers of at most `most`, shape (n + 2,).

    Whole numbers that are small enough stay as they are, or are multiplied by a whole number.
    """
    largest = float(problem.profit.max(initial=0.0))
    scale = most / largest if largest > 0.0 else 1.0
    if scale > 1.0 and (problem.profit == np.rint(problem.profit)).all():
        scale = float(np.floor(scale))
    return np.rint(scale * problem.profit).astype(np.int64)
