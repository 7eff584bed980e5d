"""What somebody else needs to confirm the root bound: multipliers, and what routes are worth.

A certificate states a multiplier pi_i >= 0 for every sensor node, for every class c of equal
AUVs what its routes are worth at most, best_c, and which nodes a route remembers where. Then

    bound = sum_i pi_i + sum_c M_c best_c

bounds the data of every plan, if indeed no route within the budget of class c is worth more than
best_c; `fiveroute.models.certificate_check` finds that out with nothing of this package.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from fiveroute.limits import Limits
from fiveroute.models.branch_price.branching import Branch
from fiveroute.models.branch_price.neighbourhoods import nearest
from fiveroute.models.branch_price.pricing import Pricer
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.branch_price.subproblem import Subproblem
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering

__all__ = ["FORMAT", "Certificate", "certify"]

FORMAT = "fiveroute root bound 1"

_NEIGHBOURS = 8


@dataclass(frozen=True, slots=True)
class Certificate:
    """Multipliers and claims; see the head of this module.

    Parameters
    ----------
    multipliers
        pi_1 to pi_n, in data.
    neighbours
        For every sensor node the nodes that a route remembers there.
    worth
        best_c for every distinct budget, ascending, in data.
    bound
        The bound that follows, in data.
    """

    multipliers: tuple[float, ...]
    neighbours: tuple[tuple[int, ...], ...]
    worth: tuple[float, ...]
    bound: float

    def document(self) -> dict[str, Any]:
        """The certificate as a JSON document."""
        return {
            "format": FORMAT,
            "multipliers": list(self.multipliers),
            "neighbours": [list(nodes) for nodes in self.neighbours],
            "worth": list(self.worth),
            "bound": self.bound,
        }


def certify(problem: TeamOrienteering, limits: Limits | None = None) -> Certificate | None:
    """Solve the root relaxation and write down its proof.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop; None without any limit.

    Returns
    -------
    Certificate or None
        The best that the limits allow; None without a bound, or where no plan exists.
    """
    network = Network.of(problem)
    clock = (limits or Limits()).start()
    if network.has_no_route:
        return None
    roads = Roads.of(network)
    size = len(roads.leg)
    whole = Branch(np.zeros((size, size), dtype=np.bool_), frozenset())
    near = nearest(roads, _NEIGHBOURS)
    root = Subproblem(roads, whole, near, clock, lambda: -math.inf)
    root.start_from([], [])
    root.relax(lambda _: None)
    if root.relaxation is None or not np.isfinite(root.relaxation.value):
        return None
    assert isinstance(root.pricer, Pricer)
    duals, worth = root.relaxation.duals, root.relaxation.best.tolist()
    near |= root.pricer.remembered_by_walks(duals)
    node = duals.node[1:-1].tolist()
    parts = [*node, *(k * most for k, most in zip(roads.routes.tolist(), worth, strict=True))]
    return Certificate(
        tuple(node),
        tuple(tuple(np.flatnonzero(near[k]).tolist()) for k in range(1, size - 1)),
        tuple(worth),
        math.fsum(parts),
    )
