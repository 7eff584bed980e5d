"""How many AUVs the mission needs, estimated from the giant route, equation (17).

Cut into M routes, the giant route of duration T_0 grows by about t~ at every cut: an AUV
has to reach its first node and to come home from its last. Were all AUVs to use up their
time, T_0 + (M - 1) t~ = M T_max would hold, hence

    M = (T_0 - t~) / (T_max - t~).                                              (17)

The paper takes for t~ the first plus the last leg of the giant route (rule ``ends``).
That is too little: a cut after node q really costs t(q, D) + t(S, q') - t(q, q'), which
the rule ``mean-cut`` averages over all cuts. The estimate is rounded to the nearest
integer, halves up, which alone gives the paper's fleets of three and four.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fiveroute.errors import InputError
from fiveroute.problem import TeamOrienteering

__all__ = ["CutRule", "FleetEstimate", "estimate_fleet_size"]

CutRule = Literal["ends", "mean-cut"]


@dataclass(frozen=True, slots=True)
class FleetEstimate:
    """The estimated number of AUVs.

    Parameters
    ----------
    value
        M by (17), before rounding.
    size
        Number of AUVs to send.
    t_tilde
        Added time t~ of a cut in seconds.
    """

    value: float
    size: int
    t_tilde: float


def estimate_fleet_size(
    problem: TeamOrienteering,
    giant_route: Sequence[int],
    rule: CutRule = "ends",
    *,
    least: int = 2,
) -> FleetEstimate:
    """Estimate M from one route through all nodes.

    Parameters
    ----------
    problem
        The problem; T_max is the mean of its budgets, and their number does not matter.
    giant_route
        The giant route R_0. Without nodes there is nothing to share, and one AUV is
        enough.
    rule
        How to measure t~.
    least
        Smallest size of a fleet; the paper demands two.

    Raises
    ------
    InputError
        If t~ is not less than T_max: an AUV that must spend all its time on the way out
        and home collects nothing, however many there are.
    """
    if not giant_route:
        return FleetEstimate(0.0, 1, 0.0)
    t_tilde = _RULES[rule](problem, giant_route)
    t_max = float(problem.budgets.mean())
    if t_tilde >= t_max:
        raise InputError(
            f"an AUV spends the {t_tilde:.0f} s of t~ on its way out and home, so its endurance"
            " must be longer for an estimate of M; state the fleet size, or a longer endurance",
            field="fleet.endurance",
            value=t_max,
        )
    value = (problem.duration(giant_route) - t_tilde) / (t_max - t_tilde)
    return FleetEstimate(value, max(math.floor(value + 0.5), least), t_tilde)


def _ends(problem: TeamOrienteering, route: Sequence[int]) -> float:
    travel = problem.travel
    return float(travel[0, route[0]] + travel[route[-1], problem.destination])


def _mean_cut(problem: TeamOrienteering, route: Sequence[int]) -> float:
    if len(route) < 2:
        return _ends(problem, route)
    travel = problem.travel
    ahead, behind = np.array(route[:-1]), np.array(route[1:])
    cuts = travel[ahead, problem.destination] + travel[0, behind] - travel[ahead, behind]
    return float(cuts.mean())


_RULES = {"ends": _ends, "mean-cut": _mean_cut}
