"""Equal AUVs in order."""

import numpy as np

from fiveroute.models.symmetry import equal_pairs, in_order
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

# AUVs 0, 2 and 3 are equal.
PROBLEM = TeamOrienteering(np.zeros((6, 6)), [0] * 6, [0] * 6, [5.0, 3.0, 5.0, 5.0])


def test_pairs_are_neighbours_of_one_class() -> None:
    assert equal_pairs(PROBLEM) == [(0, 2), (2, 3)]


def test_equal_auvs_are_renamed_by_smallest_node_and_empty_routes_come_last() -> None:
    plan = Plan(((), (1,), (4, 3), (2,)))
    assert in_order(PROBLEM, plan) == Plan(((2,), (1,), (4, 3), ()))
