"""What every AUV expects of the sea, and what it keeps in hand for its luck.

The AUV knows the law of the legs (12), not its luck, so it expects their means and reckons with
their variances. How much time it keeps in hand is a number of standard deviations, the reserve, see
`fiveroute.sea.courses.course`; an AUV that looks ahead weighs the price of a late return besides,
see `fiveroute.sea.courses.recourse`.

Where a vehicle sails, legs are neither independent nor normal. Of the leg home, which nothing can
correct, the pace is normal (`Pace`), its time has a heavy tail, and its variance is that of a
normal leg that is as late once in two hundred times. Legs on the way have the drift that the fit
finds for walks of several legs. That slow legs come together, the reserve makes up for: it is
larger by the first number of `IN_CURRENTS`, and that of a last bet by the second.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.problem import TeamOrienteering
from fiveroute.tiers.actuation import LegLaw, expected_legs, overruns

__all__ = ["IN_CURRENTS", "LAST_BET", "LONGEST_LEG", "Outlook", "Pace"]

LONGEST_LEG = 1.5
"""How often the variance of the longest leg counts besides its own place in the sum."""

LAST_BET = 1.35
"""Standard deviations that the last bet keeps for each of the reserve, see `recourse`."""

IN_CURRENTS = 1.25, 2.1
"""What the reserve is multiplied by where a vehicle sails, and `LAST_BET` there."""

_RARE = 2.576  # deviations that one normal number in two hundred is beyond
_SLOWEST = 0.2  # least pace that is reckoned with
_STEPS, _MOST_STEPS = 100, 400  # of time in the longest budget
_FINENESS = 0.75  # longest step, in standard deviations of a short leg
_SUREST = 1e-9  # least probability that a last bet is lost


class Pace(NamedTuple):
    """Expected over real time of a leg that a vehicle sails: a normal number.

    Parameters
    ----------
    mean, scatter
        Its mean and standard deviation, whatever the length of the leg.
    """

    mean: float
    scatter: float


class Outlook(NamedTuple):
    """What every AUV expects of the sea, as kernels take it.

    Parameters
    ----------
    legs
        Expected leg times in seconds, service at the head included, shape (n + 2, n + 2).
    variance
        Variances of the leg times in s^2, same shape.
    service
        Service times t_j in seconds, shape (n + 2,).
    profit
        Data rho_j of every vertex, shape (n + 2,).
    reserve
        z, standard deviations of the remaining time kept in hand.
    longest
        How often the variance of the longest leg counts besides its own place in the sum; 0 for who
        looks ahead.
    slack
        Seconds by which a budget may be overrun, for rounding.
    late
        Probability that the leg home from a vertex takes longer than 0, 1, 2, ... steps, shape
        (n + 2, steps).
    step
        Seconds of a step.
    price
        Data that a late return costs, see `fiveroute.sea.courses.recourse`.
    """

    legs: NDArray[np.float64]
    variance: NDArray[np.float64]
    service: NDArray[np.float64]
    profit: NDArray[np.float64]
    reserve: float
    longest: float
    slack: float
    late: NDArray[np.float64]
    step: float
    price: float

    @property
    def destination(self) -> int:
        """The destination vertex."""
        return len(self.profit) - 1

    @classmethod
    def of(
        cls, problem: TeamOrienteering, law: LegLaw, reserve: float, pace: Pace | None = None
    ) -> Outlook:
        """What the AUVs expect where legs follow a law, and what they keep in hand.

        Parameters
        ----------
        problem, law
            The problem, and the law of its legs.
        reserve
            Standard deviations of the remaining time kept in hand.
        pace
            That of the legs home, where a vehicle sails; None where they follow the law as well.
        """
        mean, variance = expected_legs(law)
        slack = float((problem.allowed - problem.budgets).min())
        service, profit = problem.service.copy(), problem.profit.copy()
        longest, short = float(problem.budgets.max()), float(np.quantile(np.sqrt(variance), 0.1))
        steps = min(max(math.ceil(longest / max(_FINENESS * short, 1e-9)), _STEPS), _MOST_STEPS)
        times = np.linspace(0.0, longest, steps + 1)
        view = cls(
            legs=mean + service,
            variance=variance,
            service=service,
            profit=profit,
            reserve=reserve,
            longest=LONGEST_LEG,
            slack=slack,
            late=overruns(law, problem.destination, times),
            step=longest / steps,
            price=_price_of_being_late(profit, LAST_BET * reserve),
        )
        return view if pace is None else _in_currents(view, law, pace)


def _in_currents(view: Outlook, law: LegLaw, pace: Pace) -> Outlook:
    """The same with the heavy tail of legs home, and a reserve for what else currents do."""
    from scipy.special import ndtr

    home = view.destination
    expected = law.planned[:, home]
    variance, slowest = view.variance.copy(), max(pace.mean - _RARE * pace.scatter, _SLOWEST)
    variance[:, home] = (expected * max(1.0 / slowest - 1.0, 0.0) / _RARE) ** 2
    times = view.step * np.arange(view.late.shape[1])
    spare = np.maximum(times - law.encounters[:, home, None] * law.manoeuvre_time, 1e-9)
    late = ndtr((expected[:, None] / spare - pace.mean) / max(pace.scatter, 1e-9))
    late[home] = 0.0
    caution, last_bet = IN_CURRENTS
    return view._replace(
        variance=variance,
        reserve=caution * view.reserve,
        late=late,
        price=_price_of_being_late(view.profit, last_bet * view.reserve),
    )


def _price_of_being_late(profit: NDArray[np.float64], deviations: float) -> float:
    """Data that a late return costs, if a mean node is worth the last bet that may be made."""
    data, lost = profit[1:-1], 0.5 * math.erfc(deviations / math.sqrt(2.0))
    return float(data.mean()) / max(lost, _SUREST) if len(data) else 0.0
