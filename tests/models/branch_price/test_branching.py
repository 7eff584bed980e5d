"""Divisions share all plans between their halves, and the most telling one is taken."""

from __future__ import annotations

import numpy as np

from fiveroute.models.branch_price.branching import (
    Branch,
    by_leg,
    by_node,
    doubtful_legs,
    doubtful_nodes,
    most_telling,
)
from fiveroute.models.branch_price.pool import stops_of, taking

ROUTES = [(1, 2), (2, 3), (3, 1), (4,)]
SHARES = np.array([0.5, 0.5, 0.25, 1.0])
WHOLE = Branch(np.zeros((6, 6), dtype=np.bool_), frozenset())


def allowed(branch: Branch, plan: list[tuple[int, ...]]) -> bool:
    visited = {node for route in plan for node in route}
    return branch.required <= visited and not taking(stops_of(plan), branch.forbidden).any()


def test_what_is_decided_is_not_in_doubt() -> None:
    assert doubtful_nodes(ROUTES, SHARES, 6, 9) == [1, 3]
    legs = doubtful_legs(ROUTES, SHARES, 6, 99)
    assert legs[:2] == [(0, 1), (0, 2)]
    assert not {(0, 4), (4, 5)} & set(legs)
    assert doubtful_legs(ROUTES, SHARES, 6, 1) == [(0, 1)]
    assert doubtful_nodes([(1,), ()], np.ones(2), 6, 9) == []


def test_every_plan_is_in_one_half() -> None:
    plans: list[list[tuple[int, ...]]] = [
        [(1, 2), (3,)],
        [(2, 1)],
        [(3, 4), (1,)],
        [()],
        [(1, 4, 2), (3,)],
    ]
    for halves in (by_node(WHOLE, 1), by_leg(WHOLE, (1, 2)), by_leg(WHOLE, (0, 3))):
        for plan in plans:
            assert sum(allowed(half, plan) for half in halves) == 1


def test_the_largest_product_of_losses_wins() -> None:
    choices = [by_node(WHOLE, k) for k in (1, 2, 3)]
    losses = {1: (0.0, 9.0), 2: (1.0, 2.0), 3: (0.5, 3.0)}

    def loss(half: Branch) -> float:
        node = next(k for k, h in zip(losses, choices, strict=True) if half is h[0] or half is h[1])
        return losses[node][0 if half.required else 1]

    assert most_telling(choices, loss) is choices[1]
    assert most_telling(choices, lambda _: None) is choices[0]
    assert most_telling([], loss) == []
