"""How hot the fleet search is when."""

from __future__ import annotations

__all__ = ["COLD", "FIRST", "HOT", "REHEATED", "ROUNDS", "stage"]

ROUNDS = 5
"""Number of times that the islands anneal."""

FIRST = 0.4
"""Share of the work that the first round takes; the others share the rest equally."""

HOT, REHEATED, COLD = 1.0, 0.4, 0.1
"""Temperatures at the start of the first round where nothing else is said, at the start of
the other rounds, and at the end of each of them, in mean data of a node."""


def stage(part: float, hot: float = HOT) -> tuple[int, float, bool]:
    """Round, temperature, and whether it is cold, after a share of all the work.

    In a round the temperature falls geometrically, in the first one from `hot`; its second
    half is cold, where the routes are worth remembering.
    """
    if part < FIRST:
        number, within = 0, part / FIRST
    else:
        later = (ROUNDS - 1) * (part - FIRST) / (1.0 - FIRST)
        number = min(int(later), ROUNDS - 2)
        within, hot = min(later - number, 1.0), REHEATED
        number += 1
    return number, hot * (COLD / hot) ** within, within > 0.5
