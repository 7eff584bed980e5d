"""Tier 4, equation (12): one leg by hand, and numbers of manoeuvres against their distribution."""

import math

import numpy as np
import pytest

from fiveroute.instance import Uncertainty
from fiveroute.tiers.actuation import actual_leg, expected_legs, leg_law, manoeuvre_count

LAW = leg_law(np.full((3, 3), 1000.0), np.full((3, 3), 2.0), Uncertainty(0.1, 0.5, 60.0, 0.2))


def test_the_terms_of_equation_12_add_up() -> None:
    assert actual_leg(LAW, 0, 1, 0.0, 0) == 1000.0
    assert actual_leg(LAW, 0, 1, 1.5, 2) == pytest.approx(1000.0 + 150.0 + 120.0)
    assert actual_leg(LAW, 0, 1, -20.0, 0) == pytest.approx(200.0)


def test_what_is_expected_of_a_leg() -> None:
    mean, variance = expected_legs(LAW)
    assert mean[0, 1] == pytest.approx(1060.0)
    assert variance[0, 1] == pytest.approx(100.0**2 + 60.0**2)


@pytest.mark.parametrize("mean", [0.0, 0.3, 4.0, 60.0])
def test_numbers_of_manoeuvres_are_poisson(mean: float) -> None:
    grid = (np.arange(20_000) + 0.5) / 20_000
    counts = np.array([manoeuvre_count(mean, u, 0.0) for u in grid])
    assert counts.mean() == pytest.approx(mean, abs=2e-2)
    assert counts.var() == pytest.approx(mean, rel=1e-2, abs=1e-9)
    assert (counts == 0).mean() == pytest.approx(math.exp(-mean), abs=1e-4)


def test_many_manoeuvres_are_normal() -> None:
    assert manoeuvre_count(400.0, 0.5, 1.0) == 420
    assert manoeuvre_count(400.0, 0.5, -30.0) == 0
