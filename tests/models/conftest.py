"""Problems without any decency, and their optima by brute force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from fiveroute.models import brute_force
from fiveroute.problem import TeamOrienteering


@dataclass(frozen=True, slots=True)
class Truth:
    """A problem with its optimum, None where no plan exists."""

    problem: TeamOrienteering
    optimum: float | None


def _odd_problem(seed: int) -> TeamOrienteering:
    """Up to six nodes: planar, asymmetric, non-metric, integer or full of zeros."""
    rng = np.random.default_rng(seed)
    n, fleet = int(rng.integers(0, 7)), int(rng.integers(1, 5))
    xy = rng.uniform(0.0, 10.0, (n + 2, 2))
    xy[-1] = xy[0] if rng.random() < 0.3 else xy[-1]
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    kind = seed % 6
    if kind == 1:
        travel = rng.uniform(0.0, 10.0, travel.shape)
    elif kind == 2:
        travel = travel * rng.uniform(0.7, 1.3, travel.shape)
    elif kind == 3:
        travel = np.rint(travel)
    elif kind == 4:
        travel = rng.integers(0, 4, travel.shape).astype(np.float64)
    elif kind == 5:
        travel = travel * (rng.random(travel.shape) < 0.6)
    service = np.rint(rng.random(n) * rng.integers(0, 3))
    profit = rng.random(n) if rng.random() < 0.6 else rng.integers(0, 5, n).astype(np.float64)
    budgets = np.full(fleet, rng.uniform(2.0, 30.0))
    if rng.random() < 0.5:
        budgets *= rng.uniform(0.3, 1.2, fleet)
    if kind in (3, 4):
        budgets = np.rint(budgets)
    return TeamOrienteering(travel, np.pad(service, 1), np.pad(profit, 1), budgets)


@pytest.fixture(scope="session")
def odd() -> Callable[[int], Truth]:
    """From a seed to a small odd problem and its optimum."""
    known: dict[int, Truth] = {}

    def lookup(seed: int) -> Truth:
        if seed not in known:
            problem = _odd_problem(seed)
            best = brute_force.solve(problem)
            known[seed] = Truth(problem, None if best.plan is None else best.objective)
        return known[seed]

    return lookup
