"""Legs within reach: never one less than some route within the budget needs."""

from itertools import permutations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from fiveroute.models.legs import legs_of
from fiveroute.models.reach import usable_legs
from fiveroute.problem import TeamOrienteering


@settings(max_examples=60, deadline=None)
@given(
    travel=arrays(np.float64, (5, 5), elements=st.integers(0, 9).map(float)),
    service=arrays(np.float64, 3, elements=st.integers(0, 3).map(float)),
    budget=st.integers(0, 20).map(float),
)
def test_every_leg_of_every_route_within_budget_is_usable(
    travel: np.ndarray, service: np.ndarray, budget: float
) -> None:
    problem = TeamOrienteering(travel, np.pad(service, 1), np.zeros(5), [budget, budget / 2.0])
    usable = usable_legs(problem)
    for size in range(4):
        for route in permutations((1, 2, 3), size):
            for m, allowed in enumerate(problem.allowed):
                if problem.duration(route) <= allowed:
                    assert all(usable[m][leg] for leg in legs_of(route, 4))


def test_legs_beyond_the_budget_are_not() -> None:
    """On a line, a budget of 2 s reaches the node at 1 s, not the one at 5 s."""
    x = np.array([0.0, 1.0, 5.0, 2.0])
    usable = usable_legs(TeamOrienteering(np.abs(x[:, None] - x), [0] * 4, [0] * 4, [2.0]))[0]
    assert set(zip(*np.nonzero(usable), strict=True)) == {(0, 1), (0, 3), (1, 3)}


def test_no_leg_enters_the_start_or_leaves_the_destination() -> None:
    usable = usable_legs(TeamOrienteering(np.zeros((4, 4)), [0] * 4, [0] * 4, [1.0]))[0]
    assert not usable[:, 0].any()
    assert not usable[-1].any()
    assert not usable.diagonal().any()


def test_nobody_gets_across() -> None:
    assert not usable_legs(TeamOrienteering([[0, 2], [2, 0]], [0] * 2, [0] * 2, [1.0])).any()
