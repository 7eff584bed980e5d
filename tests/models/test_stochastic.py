"""The sampled problem against all routes, and its mean against the deterministic problem."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.limits import Limits
from fiveroute.models import brute_force
from fiveroute.models.stochastic import MOST_NODES, solve_sampled
from fiveroute.problem import TIME_TOLERANCE, TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Route
from fiveroute.sampling import RouteStatistic, route_times

Case = tuple[np.ndarray, np.ndarray, np.ndarray, float]


def drawn(rng: np.random.Generator, n: int, count: int, *, ties: bool) -> Case:
    """Legs, services, data, budget: asymmetric, and with ties also full of zeros."""
    legs = rng.random((count, n + 2, n + 2)) * 100.0
    service = np.array([0.0, *rng.random(n) * 10.0, 0.0])
    profit = np.array([0.0, *rng.random(n), 0.0])
    budget = float(rng.random() * 250.0)
    if ties:
        return np.floor(legs / 20.0), np.floor(service / 5.0), np.ceil(profit * 2.0), budget / 20.0
    return legs, service, profit, budget


def all_routes(n: int) -> list[Route]:
    sizes = (itertools.permutations(range(1, n + 1), size) for size in range(n + 1))
    return list(itertools.chain.from_iterable(sizes))


def best_of_all(case: Case, statistic: RouteStatistic) -> tuple[float, float] | None:
    """Most data, and of that the least statistic; None if no route is in time."""
    legs, service, profit, budget = case
    found = []
    for route in all_routes(legs.shape[1] - 2):
        value = statistic.of(route_times(legs, service, route))
        if value <= budget + TIME_TOLERANCE * max(1.0, budget):
            found.append((-round(float(profit[list(route)].sum()), 9), value))
    if not found:
        return None
    data, value = min(found)
    return -data, value


@settings(deadline=None, max_examples=60)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(0, 5),
    st.integers(1, 20),
    st.booleans(),
    st.sampled_from([0.5, 0.6, 0.9, 1.0]),
)
def test_no_route_is_better(seed: int, n: int, count: int, ties: bool, quantile: float) -> None:
    statistic = RouteStatistic(quantile)
    case = drawn(np.random.default_rng(seed), n, count, ties=ties)
    result = solve_sampled(*case, statistic)
    truth = best_of_all(case, statistic)
    if truth is None:
        assert result.status is Status.INFEASIBLE
        assert result.route is None
        return
    assert result.status is Status.OPTIMAL
    assert result.route is not None
    assert result.profit == pytest.approx(truth[0])
    assert result.value == pytest.approx(truth[1])
    assert result.profit == pytest.approx(case[2][list(result.route)].sum())
    assert result.value == statistic.of(route_times(case[0], case[1], result.route))
    assert result.bound == result.profit


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 2**32 - 1), st.integers(0, 6), st.booleans())
def test_the_mean_is_the_deterministic_problem(seed: int, n: int, ties: bool) -> None:
    legs, service, profit, budget = drawn(np.random.default_rng(seed), n, 12, ties=ties)
    result = solve_sampled(legs, service, profit, budget)
    truth = brute_force.solve(TeamOrienteering(legs.mean(axis=0), service, profit, [budget]))
    assert result.status is truth.status
    if truth.objective is not None and result.route is not None:
        assert result.profit == pytest.approx(truth.objective)
        assert result.value == pytest.approx(route_times(legs, service, result.route).mean())


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 2**32 - 1), st.integers(0, 6))
def test_equal_samples_are_no_uncertainty(seed: int, n: int) -> None:
    """Any quantile of one matrix taken ten times, against the mean, by another method."""
    legs, service, profit, budget = drawn(np.random.default_rng(seed), n, 1, ties=False)
    certain = solve_sampled(legs, service, profit, budget)
    repeated = solve_sampled(legs.repeat(10, axis=0), service, profit, budget, RouteStatistic(0.9))
    assert repeated.status is certain.status
    assert repeated.profit == pytest.approx(certain.profit)


def test_a_stricter_quantile_never_collects_more() -> None:
    case = drawn(np.random.default_rng(6), 7, 40, ties=False)
    legs, service, profit, _ = case
    collected = [
        solve_sampled(legs, service, profit, 260.0, RouteStatistic(quantile)).profit or 0.0
        for quantile in (0.5, 0.7, 0.9, 1.0)
    ]
    assert collected == sorted(collected, reverse=True)
    assert collected[0] > collected[-1]


def test_the_lucky_detour() -> None:
    """Both nodes are in time in two samples of three, but only apart are they in the same two.

    Legs of 1 s everywhere, but 9 s to node 1 in the first sample and to node 2 in the second.
    """
    legs = np.ones((3, 4, 4))
    legs[0, :, 1] = legs[1, :, 2] = 9.0
    data = [0.0, 2.0, 1.0, 0.0]
    two_of_three = solve_sampled(legs, np.zeros(4), data, 3.0, RouteStatistic(2 / 3))
    assert (two_of_three.route, two_of_three.value) == ((1,), 2.0)
    one_of_two = solve_sampled(legs[1:], np.zeros(4), data, 3.0, RouteStatistic(0.5))
    assert one_of_two.profit == 3.0


def test_stopped_at_once() -> None:
    case = drawn(np.random.default_rng(1), 6, 20, ties=False)
    legs, service, profit, _ = case
    result = solve_sampled(legs, service, profit, 300.0, RouteStatistic(0.9), Limits(time=0.0))
    assert result.status is Status.FEASIBLE
    best = solve_sampled(legs, service, profit, 300.0, RouteStatistic(0.9))
    assert best.profit is not None
    assert result.bound >= best.profit


def test_no_time_for_anything() -> None:
    legs = np.ones((5, 4, 4))
    for statistic in (RouteStatistic(), RouteStatistic(0.8)):
        result = solve_sampled(legs, np.zeros(4), [0.0, 1.0, 1.0, 0.0], 0.5, statistic)
        assert result.status is Status.INFEASIBLE


@pytest.mark.parametrize(
    "legs", [np.ones((4, 4)), np.full((2, 4, 4), -1.0), np.full((2, 4, 4), np.nan)]
)
def test_samples_are_leg_times(legs: np.ndarray) -> None:
    with pytest.raises(InputError, match="samples"):
        solve_sampled(legs, np.zeros(4), np.zeros(4), 1.0)


def test_a_quantile_is_for_few_nodes() -> None:
    size = MOST_NODES + 3
    legs, nothing = np.ones((2, size, size)), np.zeros(size)
    with pytest.raises(InputError, match="at most"):
        solve_sampled(legs, nothing, nothing, 1.0, RouteStatistic(0.9))
