import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.models.shorten import shortened
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

LINE = TeamOrienteering(
    travel=[[abs(i - j) for j in range(6)] for i in range(6)],
    service=[0, 1, 1, 1, 1, 0],
    profit=[0, 1, 1, 1, 1, 0],
    budgets=[50, 50],
)


@pytest.mark.parametrize("route", [(4, 2, 1), (2, 1, 4), (1, 4, 2)])
def test_nodes_on_a_line_are_put_in_order(route: tuple[int, ...]) -> None:
    assert shortened(LINE, Plan((route, (3,)))).routes == ((1, 2, 4), (3,))


def test_empty_routes_stay_empty() -> None:
    assert shortened(LINE, Plan.empty(2)) == Plan.empty(2)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32 - 1))
def test_same_nodes_never_longer(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 9))
    ends_zero = np.append(np.insert(rng.random(n), 0, 0.0), 0.0)
    problem = TeamOrienteering(rng.random((n + 2, n + 2)), ends_zero, ends_zero, [1e9, 1e9])
    order = rng.permutation(n) + 1
    plan = Plan.of([order[: n // 2], order[n // 2 :]])
    better = shortened(problem, plan)
    assert [set(route) for route in better.routes] == [set(route) for route in plan.routes]
    pairs = zip(better.durations(problem), plan.durations(problem), strict=True)
    assert all(new <= old for new, old in pairs)
