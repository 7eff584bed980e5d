"""What a method answers: a plan, what is known about its quality, and how it was found."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from fiveroute.check import check
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan, Route

__all__ = ["PROOF_TOLERANCE", "GiantRouteResult", "Result", "Status", "is_closed", "optimality_gap"]

PROOF_TOLERANCE = 1e-6
"""Relative distance of bound and objective below which a plan counts as proved optimal."""


class Status(StrEnum):
    """How a run ended; the four cases are never mixed up."""

    OPTIMAL = "optimal"
    FEASIBLE = "feasible"
    NO_SOLUTION = "no_solution"
    INFEASIBLE = "infeasible"


@dataclass(frozen=True, slots=True)
class Result:
    """Answer of a method. Build it with `Result.judged`, which asks the judge first.

    Parameters
    ----------
    method
        Name of the method.
    status
        See `Status`.
    plan
        The plan; None without one.
    objective
        Collected data of the plan; 0 when the problem is infeasible, None without a plan.
    bound
        Proven upper bound on the data any plan can collect; None where none was computed.
    seconds
        Wall-clock time.
    seed
        Seed of the random numbers; None for a deterministic method.
    """

    method: str
    status: Status
    plan: Plan | None
    objective: float | None
    bound: float | None
    seconds: float
    seed: int | None = None

    @property
    def gap(self) -> float | None:
        """Relative optimality gap; None where bound or objective is missing."""
        if self.status in (Status.OPTIMAL, Status.INFEASIBLE):
            return 0.0
        return optimality_gap(self.objective, self.bound)

    @classmethod
    def judged(
        cls,
        problem: TeamOrienteering,
        plan: Plan | None,
        *,
        method: str,
        seconds: float,
        bound: float | None = None,
        seed: int | None = None,
    ) -> Result:
        """Result of a plan that the judge has accepted, its objective recomputed.

        The status follows from the figures: optimal where bound and objective meet,
        feasible otherwise, no_solution without a plan.

        Raises
        ------
        AssertionError
            If the plan is infeasible, or its objective exceeds the bound: a bug in the
            method, never an answer.
        """
        if plan is None:
            return cls(method, Status.NO_SOLUTION, None, None, bound, seconds, seed)
        violations = check(problem, plan)
        assert not violations, f"{method} returned an infeasible plan: {violations[:3]}"
        objective = plan.objective(problem)
        if bound is not None:
            assert bound >= (1.0 - PROOF_TOLERANCE) * objective, (
                f"{method} claims bound {bound} below objective {objective}"
            )
            bound = max(bound, objective)
        proved = bound is not None and is_closed(objective, bound)
        status = Status.OPTIMAL if proved else Status.FEASIBLE
        return cls(method, status, plan, objective, bound, seconds, seed)

    @classmethod
    def infeasible(cls, *, method: str, seconds: float) -> Result:
        """Result of a proof that no plan exists: nothing can be collected."""
        return cls(method, Status.INFEASIBLE, None, 0.0, 0.0, seconds)


def optimality_gap(objective: float | None, bound: float | None) -> float | None:
    """(bound - objective) / max(objective, 1e-12), or None where one of them is missing."""
    if objective is None or bound is None:
        return None
    return max(bound - objective, 0.0) / max(objective, 1e-12)


def is_closed(objective: float, bound: float) -> bool:
    """Whether objective and bound meet within the proof tolerance."""
    return bound - objective <= PROOF_TOLERANCE * objective


@dataclass(frozen=True, slots=True)
class GiantRouteResult:
    """Answer to the giant-route problem (13), (14): one route through every node.

    Parameters
    ----------
    method
        Name of the method.
    status
        ``optimal`` when proved, ``feasible`` otherwise.
    order
        All sensor nodes in the order of the visits.
    duration
        T_0, travel plus service time of the route in seconds.
    bound
        Proven lower bound on that duration; None where none was computed.
    seconds
        Wall-clock time.
    """

    method: str
    status: Status
    order: Route
    duration: float
    bound: float | None
    seconds: float

    @property
    def gap(self) -> float | None:
        """(duration - bound) / duration; None without a bound."""
        if self.status is Status.OPTIMAL:
            return 0.0
        if self.bound is None:
            return None
        return max(self.duration - self.bound, 0.0) / max(self.duration, 1e-12)
