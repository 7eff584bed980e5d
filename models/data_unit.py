"""The same problem in a unit of data that fits it.

Solvers have absolute tolerances: what counts less than a millionth is nothing to them, and where
data are stated in terabytes they would prove that none can be collected. In a smaller unit the
data count enough. It is a power of two, which loses no bit: plans, proofs and gaps stay the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fiveroute.limits import Progress, ProgressCallback
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result, Status

__all__ = ["in_fitting_unit"]

_ENOUGH = 0.5  # what the largest data within reach must count
_LEAST = -1000  # exponent of the unit; beyond it data divided by the unit overflow


def in_fitting_unit(
    solve: Callable[[TeamOrienteering, ProgressCallback | None], Result],
    problem: TeamOrienteering,
    progress: ProgressCallback | None,
) -> Result:
    """Solve a problem in a unit in which the largest data within reach count a half or more.

    Parameters
    ----------
    solve
        A method, from a problem and whom to tell of progress.
    problem
        The problem.
    progress
        Told of better plans and bounds, in the unit of the problem.
    """
    if problem.profit.min(initial=np.inf, where=problem.profit > 0.0) >= _ENOUGH:
        return solve(problem, progress)
    reachable = Network.of(problem).reachable
    largest = float(problem.profit[reachable].max(initial=0.0))
    if largest == 0.0 or largest >= _ENOUGH:
        return solve(problem, progress)
    unit = math.ldexp(1.0, max(math.frexp(largest)[1] - 1, _LEAST))
    profit = np.zeros(problem.n + 2)
    profit[reachable] = problem.profit[reachable] / unit

    def tell(news: Progress) -> None:
        assert progress is not None
        objective, bound = (None if v is None else v * unit for v in (news.objective, news.bound))
        progress(replace(news, objective=objective, bound=bound))

    told = None if progress is None else tell
    return _restated(problem, solve(replace(problem, profit=profit), told), unit)


def _restated(problem: TeamOrienteering, result: Result, unit: float) -> Result:
    """An answer in the unit of the problem."""
    if result.status is Status.INFEASIBLE:
        return result
    bound = None if result.bound is None else result.bound * unit
    return Result.judged(
        problem,
        result.plan,
        method=result.method,
        seconds=result.seconds,
        bound=bound,
        seed=result.seed,
    )
