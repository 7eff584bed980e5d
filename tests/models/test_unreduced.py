"""A programme whose optimum the reductions of HiGHS lose."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from fiveroute.models import circuit, enumeration
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status


def lost() -> TeamOrienteering:
    """Nine nodes and three AUVs with budgets of their own."""
    rng = np.random.default_rng(4328)
    rng.integers(9, 22), rng.integers(1, 5), rng.random()
    budgets = rng.uniform(6.0, 11.0, 3)
    rng = np.random.default_rng(4328)
    xy = np.vstack([[3.0, 5.0], rng.uniform(0.0, 10.0, (9, 2)), [7.0, 5.0]])
    travel = cdist(xy, xy) * rng.uniform(0.8, 1.2, (11, 11))
    profit = np.pad(1.0 - rng.random(9), 1)
    return TeamOrienteering(travel, 0.1 * (profit > 0.0), profit, budgets)


def test_enumeration_keeps_the_optimum() -> None:
    problem = lost()
    result, other = enumeration.solve(problem), circuit.solve(problem)
    assert result.status is other.status is Status.OPTIMAL
    assert result.objective == pytest.approx(1.5812323)
    assert other.objective == pytest.approx(1.5812323)
