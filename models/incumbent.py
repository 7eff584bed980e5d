"""The running answer of an exact method: the best plan so far and the least bound.

Every method keeps its answer here while it runs. Plans pass the judge on their way in, so
that a solver's tolerances never reach the caller; bounds only ever fall; and whatever
improves is told to the progress callback at once. Solvers call back from threads of their
own, hence the lock.
"""

from __future__ import annotations

import math
import threading

from fiveroute.check import check
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.models.common_divisor import rounded_down
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result, is_closed, optimality_gap
from fiveroute.routes import Plan

__all__ = ["Incumbent"]


class Incumbent:
    """The best plan and the least bound of one run, whose clock starts here.

    It begins with all data as the bound, and with the empty plan and the warm start where
    the judge accepts them.

    Parameters
    ----------
    problem
        The problem.
    method
        Name of the method, for the result.
    limits
        When to stop; None without any limit.
    warm_start
        A plan to start from; one that the judge rejects is left aside.
    progress
        Told of every improvement.

    Attributes
    ----------
    note
        What to add to the method's name when progress is told.
    """

    def __init__(
        self,
        problem: TeamOrienteering,
        method: str,
        limits: Limits | None = None,
        *,
        warm_start: Plan | None = None,
        progress: ProgressCallback | None = None,
    ) -> None:
        self.problem, self.method = problem, method
        self.clock = (limits or Limits()).start()
        self.plan: Plan | None = None
        self.objective = -math.inf
        self.bound = problem.total_profit
        self.note = ""
        self._progress = progress
        self._lock = threading.RLock()
        self.offer(Plan.empty(problem.fleet_size))
        if warm_start is not None:
            self.offer(warm_start)

    @property
    def is_settled(self) -> bool:
        """Whether plan and bound are as close as the limits ask."""
        if self.plan is None:
            return False
        gap = optimality_gap(self.objective, self.bound)
        return is_closed(self.objective, self.bound) or (
            gap is not None and gap <= self.clock.limits.gap
        )

    @property
    def must_stop(self) -> bool:
        """Whether nothing is left to do, or no time to do it."""
        return self.is_settled or self.clock.expired

    def offer(self, plan: Plan) -> bool:
        """Keep a plan if it is the best so far; return whether the judge accepts it."""
        if check(self.problem, plan):
            return False
        objective = plan.objective(self.problem)
        with self._lock:
            if objective > self.objective:
                self.plan, self.objective = plan, objective
                self._tell()
        return True

    def lower(self, bound: float) -> None:
        """Keep a proven bound if, rounded down to what plans collect, it is the least so far."""
        bound = rounded_down(max(bound, 0.0), self.problem.profit)
        with self._lock:
            if bound < self.bound:
                self.bound = bound
                self._tell()

    def result(self) -> Result:
        """The answer as it stands."""
        return Result.judged(
            self.problem,
            self.plan,
            method=self.method,
            seconds=self.clock.seconds,
            bound=self.bound,
        )

    def infeasible(self) -> Result:
        """The answer when it is proved that no plan exists.

        Raises
        ------
        AssertionError
            If a plan is known: a bug in the method, never an answer.
        """
        assert self.plan is None, f"{self.method} proves infeasible what {self.plan} solves"
        return Result.infeasible(method=self.method, seconds=self.clock.seconds)

    def _tell(self) -> None:
        if self._progress is not None:
            objective = None if self.plan is None else self.objective
            message = f"{self.method} {self.note}" if self.note else self.method
            self._progress(Progress(self.clock.seconds, objective, self.bound, message))
