"""How to divide a subproblem in two that share all its plans between them.

Either a node must be visited or it must not, or a leg is taken or it is not. Of the nodes and legs
that a fractional solution leaves most in doubt, that one is best whose two halves lose most of the
bound, judged by the linear programme over the routes known so far: strong branching without
pricing (D. Applegate, R. Bixby, V. Chvatal and W. Cook 1995, DIMACS report 95-05).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fiveroute.models.branch_price.pool import Pool
from fiveroute.routes import Route

__all__ = ["Branch", "by_leg", "by_node", "doubtful_legs", "doubtful_nodes", "most_telling"]

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]
Leg = tuple[int, int]

_CERTAIN = 0.5 - 1e-4  # distance from one half at which a node or leg counts as decided
_LEAST_GAIN = 1e-6  # share of the larger gain that both halves are granted


@dataclass(frozen=True, slots=True)
class Branch:
    """What sets a subproblem apart: forbidden legs, required nodes, and its routes if known."""

    forbidden: Booleans
    required: frozenset[int]
    pool: Pool | None = None


def doubtful_nodes(routes: list[Route], shares: Floats, size: int, count: int) -> list[int]:
    """At most `count` nodes whose visits are the least decided, the most doubtful first."""
    visits = np.zeros(size)
    for route, share in zip(routes, shares, strict=True):
        visits[list(route)] += share
    distance = np.abs(visits - 0.5)
    distance[[0, -1]] = 0.5
    order = np.argsort(distance, kind="stable")[:count]
    return [int(node) for node in order if distance[node] < _CERTAIN]


def doubtful_legs(routes: list[Route], shares: Floats, size: int, count: int) -> list[Leg]:
    """At most `count` legs whose use is the least decided, the most doubtful first."""
    use: dict[Leg, float] = {}
    for route, share in zip(routes, shares.tolist(), strict=True):
        for leg in pairwise((0, *route, size - 1)):
            use[leg] = use.get(leg, 0.0) + share
    use.pop((0, size - 1), None)
    distance = {leg: abs(total - 0.5) for leg, total in use.items()}
    order = sorted(distance, key=lambda leg: (distance[leg], leg))[:count]
    return [leg for leg in order if distance[leg] < _CERTAIN]


def by_node(branch: Branch, node: int) -> list[Branch]:
    """With a node, and without."""
    idle = branch.forbidden.copy()
    idle[node] = idle[:, node] = True
    return [
        Branch(branch.forbidden, branch.required | {node}, branch.pool),
        Branch(idle, branch.required, branch.pool),
    ]


def by_leg(branch: Branch, leg: Leg) -> list[Branch]:
    """With a leg, and without."""
    without, only = branch.forbidden.copy(), branch.forbidden.copy()
    without[leg] = True
    ends = {k for k in leg if 0 < k < len(without) - 1}
    if leg[0] in ends:
        only[leg[0]] = True
    if leg[1] in ends:
        only[:, leg[1]] = True
    only[leg] = branch.forbidden[leg]
    return [
        Branch(only, branch.required | ends, branch.pool),
        Branch(without, branch.required, branch.pool),
    ]


def most_telling(
    choices: list[list[Branch]], loss: Callable[[Branch], float | None]
) -> list[Branch]:
    """The division whose halves have the largest product of losses.

    Parameters
    ----------
    choices
        Divisions.
    loss
        What a half loses of the bound; None when there is no time left to tell.
    """
    if len(choices) < 2:
        return choices[0] if choices else []
    best, chosen = -1.0, choices[0]
    for halves in choices:
        losses = [loss(half) for half in halves]
        if None in losses:
            break
        first, second = (float(value or 0.0) for value in losses)
        least = _LEAST_GAIN * max(first, second)
        product = max(first, least) * max(second, least)
        if product > best:
            best, chosen = product, halves
    return chosen
