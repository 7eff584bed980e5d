"""Rounded problems: whatever keeps within the rounded budget keeps within the true one."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.check import check
from fiveroute.peers.scaled import scaled_profit, scaled_times
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def problem(rng: np.random.Generator, nodes: int = 6, scale: float = 1.0) -> TeamOrienteering:
    """Asymmetric times, service times, and another budget for every AUV."""
    size = nodes + 2
    inner = np.r_[0.0, np.ones(nodes), 0.0]
    return TeamOrienteering(
        scale * rng.random((size, size)),
        scale * 0.1 * rng.random(size) * inner,
        rng.random(size) * inner,
        scale * (2.0 + rng.random(3)),
    )


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10_000), st.sampled_from([1e-3, 1.0, 1e5]), st.integers(10, 10**7))
def test_what_is_in_time_for_the_peer_is_in_time_for_us(
    seed: int, scale: float, units: int
) -> None:
    rng = np.random.default_rng(seed)
    exact = problem(rng, scale=scale)
    times = scaled_times(exact, units)
    stops = np.r_[0, rng.permutation(np.arange(1, 7))[: rng.integers(0, 7)], 7]
    duration = times.through[stops[:-1], stops[1:]].sum()
    # A budget that the rounded route just fits, in the place of the one that it has.
    budgets = np.full(3, exact.duration(stops[1:-1].tolist()))
    budgets[1:] = exact.budgets[1:]
    tight = exact.with_budgets(budgets)
    fits = scaled_times(tight, units)
    through = fits.through[stops[:-1], stops[1:]].sum()
    if through <= fits.budgets[0]:
        assert not check(tight, Plan.of([stops[1:-1].tolist(), [], []]))
    if duration <= times.budgets[1]:
        assert exact.duration(stops[1:-1].tolist()) <= exact.allowed[1]


def test_whole_numbers_stay_exact() -> None:
    travel = np.array([[0, 3, 7], [4, 0, 5], [7, 5, 0]])
    whole = TeamOrienteering(travel, np.zeros(3), [0.0, 2.0, 0.0], [8.0, 9.0])
    times = scaled_times(whole, 1000)
    assert (times.travel == 111 * travel).all()
    assert times.budgets.tolist() == [888, 999]  # the route of 3 + 5 fits the first to the unit


def test_legs_that_no_route_needs_stay_in_range() -> None:
    far = TeamOrienteering([[0, 1e30], [1.0, 0]], np.zeros(2), np.zeros(2), [1.0])
    assert scaled_times(far, 1000).travel.max() == 2000


def test_profits_of_whole_numbers_keep_their_proportions() -> None:
    three = TeamOrienteering(np.ones((5, 5)), np.zeros(5), [0, 7, 14, 30, 0], [9.0])
    assert scaled_profit(three, 100).tolist() == [0, 21, 42, 90, 0]
    assert scaled_profit(three, 15).tolist() == [0, 4, 7, 15, 0]
