"""Equal AUVs in a fixed order.

AUVs with equal budgets are interchangeable, and a model that does not know so searches
every plan once per permutation. Demand therefore that of two equal AUVs, a before b, the
smallest node of a's route is smaller than that of b's; an empty route comes last:

    y_kb <= sum over j < k of y_ja    for every node k.

Every plan obeys this after renaming equal AUVs, which `in_order` does.
"""

from __future__ import annotations

from itertools import pairwise

from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["equal_pairs", "in_order"]


def equal_pairs(problem: TeamOrienteering) -> list[tuple[int, int]]:
    """Neighbours (a, b) in every class of equal AUVs, a before b."""
    return [pair for auvs in _classes(problem) for pair in pairwise(auvs)]


def in_order(problem: TeamOrienteering, plan: Plan) -> Plan:
    """The same plan with equal AUVs renamed so that it obeys the order."""
    routes = list(plan.routes)
    for auvs in _classes(problem):
        ordered = sorted(
            (plan.routes[m] for m in auvs), key=lambda r: min(r, default=len(r) or 1e9)
        )
        for m, route in zip(auvs, ordered, strict=True):
            routes[m] = route
    return Plan(tuple(routes))


def _classes(problem: TeamOrienteering) -> list[list[int]]:
    """AUVs of equal budget, class by class."""
    classes: dict[float, list[int]] = {}
    for m, budget in enumerate(problem.budgets.tolist()):
        classes.setdefault(budget, []).append(m)
    return list(classes.values())
