"""Sampled leg times against the closed-form moments of equation (12)."""

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.instance import Uncertainty
from fiveroute.sampling import RouteStatistic, SampledLegs, route_times, sample_legs

TRAVEL = np.array([[0.0, 1000.0, 4000.0], [1200.0, 0.0, 500.0], [3000.0, 700.0, 0.0]])
LENGTHS_KM = TRAVEL / 1000.0


def within_standard_errors(values: np.ndarray, expected: float, error: float) -> bool:
    return bool(abs(values.mean() - expected) <= 3.0 * error / np.sqrt(len(values)))


@pytest.mark.parametrize(
    "uncertainty",
    [
        Uncertainty(drift=0.1),
        Uncertainty(manoeuvres_per_km=0.5, manoeuvre_time=120.0),
        Uncertainty(drift=0.1, manoeuvres_per_km=0.5, manoeuvre_time=60.0),
    ],
    ids=["drift", "manoeuvres", "both"],
)
def test_mean_and_variance_are_the_closed_form(uncertainty: Uncertainty) -> None:
    legs = sample_legs(TRAVEL, LENGTHS_KM, uncertainty, 20_000, np.random.default_rng(1))
    for i, j in ((0, 1), (1, 0), (0, 2)):
        rate = uncertainty.manoeuvres_per_km * LENGTHS_KM[i, j]
        mean = TRAVEL[i, j] + rate * uncertainty.manoeuvre_time
        drift = uncertainty.drift * TRAVEL[i, j]
        variance = drift**2 + rate * uncertainty.manoeuvre_time**2
        drawn = legs[:, i, j]
        assert within_standard_errors(drawn, mean, variance**0.5)
        fourth = 3.0 * variance**2 + rate * uncertainty.manoeuvre_time**4  # cumulants add up
        spread = np.sqrt(fourth - variance**2)
        assert within_standard_errors((drawn - mean) ** 2, variance, spread)


def test_no_leg_is_faster_than_the_floor() -> None:
    legs = sample_legs(
        TRAVEL, LENGTHS_KM, Uncertainty(drift=2.0, floor=0.2), 500, np.random.default_rng(2)
    )
    assert (legs >= 0.2 * TRAVEL).all()
    assert (legs[:, 0, 1] == 200.0).any()


def test_without_uncertainty_every_sample_is_the_plan() -> None:
    legs = sample_legs(TRAVEL, LENGTHS_KM, Uncertainty(), 3, np.random.default_rng(3))
    np.testing.assert_array_equal(legs, np.broadcast_to(TRAVEL, (3, 3, 3)))


def test_the_same_seed_draws_the_same_legs() -> None:
    one, two = (
        sample_legs(TRAVEL, LENGTHS_KM, Uncertainty(drift=0.1), 5, np.random.default_rng(4))
        for _ in range(2)
    )
    np.testing.assert_array_equal(one, two)


def test_route_times_add_up_legs_and_services() -> None:
    legs = np.stack([TRAVEL, 2.0 * TRAVEL])
    service = np.array([0.0, 30.0, 0.0])
    np.testing.assert_allclose(route_times(legs, service, (1,)), [1530.0, 3030.0])
    np.testing.assert_allclose(route_times(legs, service, ()), [4000.0, 8000.0])
    assert SampledLegs(legs, RouteStatistic()).duration(service, (1,)) == pytest.approx(2280.0)


def test_a_quantile_is_the_least_sample_that_enough_samples_keep_to() -> None:
    times = np.array([5.0, 1.0, 4.0, 2.0, 3.0, 10.0, 7.0, 8.0, 9.0, 6.0])
    assert RouteStatistic(0.5).of(times) == 5.0
    assert RouteStatistic(0.7).of(times) == 7.0  # 0.7 * 10 is 7.000000000000001 as a float
    assert RouteStatistic(0.71).of(times) == 8.0
    assert RouteStatistic(1.0).of(times) == 10.0
    assert RouteStatistic().of(times) == 5.5


def test_needed_and_of_are_two_sides_of_one_thing() -> None:
    rng = np.random.default_rng(5)
    for quantile in (0.5, 0.8, 0.95, 1.0):
        statistic = RouteStatistic(quantile)
        times = rng.random(37)
        limit = statistic.of(times)
        assert (times <= limit).sum() >= statistic.needed(37)
        assert (times < limit).sum() < statistic.needed(37)
    assert RouteStatistic().needed(37) == 0


@pytest.mark.parametrize("quantile", [0.0, 0.49, 1.01, float("nan")])
def test_a_quantile_below_one_half_is_refused(quantile: float) -> None:
    with pytest.raises(InputError, match="quantile"):
        RouteStatistic(quantile)
