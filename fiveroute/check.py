"""The judge of plans: feasible or not, and if not, where and by how much.

It knows the problem and nothing else. No solver uses it to build a plan, and every plan
that leaves fiveroute has passed it.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from fiveroute.plan import Plan
from fiveroute.problem import TeamOrienteering

__all__ = ["Violation", "check"]


@dataclass(frozen=True, slots=True)
class Violation:
    """One broken rule.

    Parameters
    ----------
    kind
        ``fleet_size``, ``unknown_node``, ``visited_twice`` or ``over_budget``.
    auv
        AUV concerned, counted from 0; None where the whole plan is concerned.
    node
        Vertex concerned; None where a whole route is.
    amount
        Size of the fault: AUVs too many or missing, visits too many, or seconds over
        the budget.
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
