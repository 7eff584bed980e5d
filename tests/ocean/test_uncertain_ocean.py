"""Truths drawn from a forecast: their statistics, and what a seed means."""

import math
from typing import Any

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.ocean.currents import LambVortices
from fiveroute.ocean.random_vortices import EFFECTIVE, PRINTED, draw_vortices
from fiveroute.ocean.uncertain_ocean import VortexUncertainty, draw_truth

SQUARE = (0.0, 0.0, 10_000.0, 10_000.0)
ALL = VortexUncertainty(displacement=300.0, strength=0.4, missing=0.25, unforeseen=6.0)


def forecast(count: int = 20) -> LambVortices:
    return draw_vortices(EFFECTIVE, count, SQUARE, np.random.default_rng(0))


def truth(uncertainty: VortexUncertainty, seed: int, count: int = 20) -> LambVortices:
    return draw_truth(forecast(count), uncertainty, SQUARE, np.random.default_rng(seed))


def parts(field: LambVortices) -> list[list[float]]:
    return [part.tolist() for part in (field.x, field.y, field.circulation, field.radius)]


def test_a_sure_forecast_comes_true() -> None:
    assert parts(truth(VortexUncertainty(), 1)) == parts(forecast())


def test_a_seed_is_a_truth() -> None:
    assert parts(truth(ALL, 2)) == parts(truth(ALL, 2))
    assert parts(truth(ALL, 2)) != parts(truth(ALL, 3))


def test_the_forecast_stays_as_it_is() -> None:
    known = forecast()
    draw_truth(known, ALL, SQUARE, np.random.default_rng(4))
    assert parts(known) == parts(forecast())


def test_displacements_are_normal() -> None:
    """Standard deviation and the share within one of it, within four standard errors."""
    count = 20_000
    moved, known = truth(VortexUncertainty(displacement=300.0), 5, count), forecast(count)
    for shift in (moved.x - known.x, moved.y - known.y):
        assert abs(shift.mean()) < 4.0 * 300.0 / count**0.5
        assert abs(shift.std() - 300.0) < 4.0 * 300.0 / (2 * count) ** 0.5
        assert np.mean(np.abs(shift) < 300.0) == pytest.approx(0.6827, abs=4.0 * 0.466 / count**0.5)
    assert abs(np.corrcoef(moved.x - known.x, moved.y - known.y)[0, 1]) < 4.0 / count**0.5
    assert parts(moved)[2:] == parts(known)[2:]


def test_strengths_are_right_in_the_mean() -> None:
    count, s = 20_000, 0.4
    changed, known = truth(VortexUncertainty(strength=s), 6, count), forecast(count)
    factor = changed.circulation / known.circulation
    assert factor.min() > 0.0
    assert abs(factor.mean() - 1.0) < 4.0 * math.sqrt(math.expm1(s**2) / count)
    assert abs(np.log(factor).std() - s) < 4.0 * s / (2 * count) ** 0.5
    assert 0.4 < np.mean(factor > 1.0) < 0.45  # seldom stronger, but then by more


def test_vortices_are_missing_and_unforeseen_in_the_mean() -> None:
    """Over 1,000 truths, within four standard errors: 25 % of 20 missing, 6 new ones."""
    known, runs, kept, new = set(forecast().radius), 1000, [], []
    for seed in range(runs):
        found = truth(ALL, seed)
        kept.append(sum(radius in known for radius in found.radius))
        new.append(len(found.x) - kept[-1])
    assert abs(np.mean(kept) - 15.0) < 4.0 * math.sqrt(20 * 0.25 * 0.75 / runs)
    assert abs(np.mean(new) - 6.0) < 4.0 * math.sqrt(6.0 / runs)
    assert np.var(new) == pytest.approx(6.0, rel=0.2)  # a Poisson number


def test_an_ocean_that_nobody_forecast() -> None:
    """All missing, twenty new ones: as strong in the mean as the field that was forecast."""
    unknown = VortexUncertainty(missing=1.0, unforeseen=20.0)
    found = [truth(unknown, seed) for seed in range(200)]
    assert np.mean([len(field.x) for field in found]) == pytest.approx(20.0, abs=1.3)
    circulation = np.concatenate([field.circulation for field in found])
    assert circulation.std() == pytest.approx(1000.0, rel=0.06)
    assert not set(forecast().radius) & {radius for field in found for radius in field.radius}


def test_unforeseen_vortices_are_of_their_kind_and_in_the_region() -> None:
    weak = VortexUncertainty(unforeseen=500.0, unforeseen_kind=PRINTED)
    region = (-100.0, 50.0, 0.0, 60.0)
    field = draw_truth(LambVortices(*np.zeros((4, 0))), weak, region, np.random.default_rng(7))
    assert field.circulation.std() == pytest.approx(50.0, rel=0.15)
    assert -100.0 <= field.x.min() <= field.x.max() <= 0.0
    assert 50.0 <= field.y.min() <= field.y.max() <= 60.0


def test_more_uncertainty_goes_farther_the_same_way() -> None:
    known = forecast()
    near, far = (truth(VortexUncertainty(displacement=d), 8) for d in (100.0, 200.0))
    np.testing.assert_allclose(far.x - known.x, 2.0 * (near.x - known.x), atol=1e-9)
    rare, often = (truth(VortexUncertainty(missing=p), 8) for p in (0.2, 0.6))
    assert set(often.radius) < set(rare.radius) < set(known.radius)


@pytest.mark.parametrize("field", ["displacement", "strength", "missing", "unforeseen"])
@pytest.mark.parametrize("value", [-0.1, math.nan, math.inf])
def test_uncertainties_are_finite_and_not_negative(field: str, value: float) -> None:
    wrong: dict[str, Any] = {field: value}
    with pytest.raises(InputError, match=f"^{field}: .*must be finite and from 0"):
        VortexUncertainty(**wrong)


def test_a_probability_ends_at_one() -> None:
    with pytest.raises(InputError, match=r"^missing: 1.1: must be finite and from 0 to 1$"):
        VortexUncertainty(missing=1.1)
