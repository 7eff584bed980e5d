"""The judge of plans: feasible or not, and if not, where and by how much.

It knows the problem and nothing else. No solver uses it to build a plan, and every plan
that leaves fiveroute has passed it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["CLAIM_TOLERANCE", "Violation", "check", "check_claims"]

CLAIM_TOLERANCE = 1e-6
"""Relative error that a claimed objective or duration may have."""


@dataclass(frozen=True, slots=True)
class Violation:
    """One broken rule.

    Parameters
    ----------
    kind
        ``fleet_size``, ``unknown_node``, ``visited_twice`` or ``over_budget``; and of
        what a plan says of itself, ``objective`` or ``duration``.
    auv
        AUV concerned, counted from 0; None where the whole plan is concerned.
    node
        Vertex concerned; None where a whole route is.
    amount
        Size of the fault: AUVs too many or missing, visits too many, seconds over the
        budget, or how much more is claimed than is true.
    """

    kind: str
    auv: int | None
    node: int | None
    amount: float


def check(problem: TeamOrienteering, plan: Plan) -> list[Violation]:
    """Judge a plan against constraints (3) to (8) of the paper.

    Returns
    -------
    list of Violation
        Every violation; empty when the plan is feasible.
    """
    violations = []
    surplus = len(plan.routes) - problem.fleet_size
    if surplus:  # (3): one route per AUV
        violations.append(Violation("fleet_size", None, None, float(surplus)))
    visits: Counter[int] = Counter()
    for auv, route in enumerate(plan.routes):
        strangers = [node for node in route if not 1 <= node <= problem.n]
        violations += [Violation("unknown_node", auv, node, 1.0) for node in strangers]
        for node in route:  # (4): at most once over the fleet
            visits[node] += 1
            if visits[node] > 1:
                violations.append(Violation("visited_twice", auv, node, 1.0))
        if strangers or auv >= problem.fleet_size:
            continue
        duration = problem.duration(route)
        if duration > problem.allowed[auv]:  # (6)
            excess = duration - float(problem.budgets[auv])
            violations.append(Violation("over_budget", auv, None, excess))
    return violations


def check_claims(
    problem: TeamOrienteering, plan: Plan, objective: float, durations: Sequence[float]
) -> list[Violation]:
    """Judge what a feasible plan says of itself.

    Parameters
    ----------
    problem
        The problem.
    plan
        A plan in which `check` found nothing.
    objective
        The data that it claims to collect.
    durations
        The time that it claims for every route, in seconds.

    Returns
    -------
    list of Violation
        Claims that differ from the truth by more than one part in a million, and times by more
        than a microsecond besides.
    """
    claims: list[tuple[str, int | None, float, float, float]] = [
        ("objective", None, objective, plan.objective(problem), 0.0)
    ]
    claims += [
        ("duration", auv, claimed, true, 1.0)
        for auv, (claimed, true) in enumerate(zip(durations, plan.durations(problem), strict=True))
    ]
    return [
        Violation(kind, auv, None, claimed - true)
        for kind, auv, claimed, true, least in claims
        if abs(claimed - true) > CLAIM_TOLERANCE * max(least, abs(true))
    ]
