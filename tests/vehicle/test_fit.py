"""The fit of (12): it finds what legs were drawn with, and what the vehicle really does."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.instance import Uncertainty
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.paths.legs import track_time
from fiveroute.vehicle.dynamics import Vehicle
from fiveroute.vehicle.fit import SailedLegs, drift_of_walks, fit_uncertainty, sail_legs
from fiveroute.vehicle.unknown_obstacles import strewn_discs

Numbers = NDArray[np.int64]
Water = Callable[[float, float], CurrentGrid]


def drawn_legs(uncertainty: Uncertainty, count: int, rng: np.random.Generator) -> SailedLegs:
    planned = rng.uniform(300.0, 3000.0, count)
    kilometres = planned / 1000.0
    manoeuvres = rng.poisson(uncertainty.manoeuvres_per_km * kilometres)
    unhindered = planned * (1.0 + uncertainty.drift * rng.standard_normal(count))
    sailed = unhindered + uncertainty.manoeuvre_time * manoeuvres
    return SailedLegs(planned, kilometres, unhindered, sailed, manoeuvres)


def test_it_finds_the_parameters_of_the_abstraction() -> None:
    truth = Uncertainty(drift=0.1, manoeuvres_per_km=0.8, manoeuvre_time=45.0)
    fit = fit_uncertainty(drawn_legs(truth, 4000, np.random.default_rng(1)))
    assert fit.drift.value == pytest.approx(truth.drift, abs=4.0 * fit.drift.error)
    assert fit.manoeuvres_per_km.value == pytest.approx(
        truth.manoeuvres_per_km, abs=4.0 * fit.manoeuvres_per_km.error
    )
    assert fit.manoeuvre_time.value == pytest.approx(45.0)
    assert abs(fit.delay.value) < 4.0 * fit.delay.error
    assert (fit.legs, fit.failed) == (4000, 0)


def test_the_standard_errors_are_those_of_the_estimates() -> None:
    truth = Uncertainty(drift=0.2, manoeuvres_per_km=0.5, manoeuvre_time=30.0)
    rng = np.random.default_rng(2)
    fits = [fit_uncertainty(drawn_legs(truth, 100, rng)) for _ in range(400)]
    for name in ("drift", "manoeuvres_per_km", "delay"):
        estimates = [getattr(fit, name) for fit in fits]
        spread = np.std([estimate.value for estimate in estimates])
        assert np.mean([estimate.error for estimate in estimates]) == pytest.approx(
            spread, rel=0.15
        )


def test_legs_that_failed_are_counted_and_left_out() -> None:
    legs = drawn_legs(Uncertainty(drift=0.1), 50, np.random.default_rng(3))
    legs.unhindered[4] = math.inf
    legs.sailed[[4, 7]] = math.inf
    fit = fit_uncertainty(legs)
    assert (fit.legs, fit.failed) == (48, 2)
    assert fit.uncertainty.drift == fit.drift.value


def test_a_fit_takes_legs() -> None:
    legs = drawn_legs(Uncertainty(), 1, np.random.default_rng(4))
    with pytest.raises(InputError, match="two legs"):
        fit_uncertainty(legs)


def walks(count: int, strides: int, apart: float, together: float) -> tuple[SailedLegs, Numbers]:
    """Walks whose legs' paces scatter, each by itself and all legs of a walk together."""
    rng = np.random.default_rng(7)
    pace = 1.0 + apart * rng.standard_normal((count, strides))
    pace += together * rng.standard_normal((count, 1))
    planned = rng.uniform(300.0, 900.0, (count, strides))
    took, none = (planned / pace).ravel(), np.zeros(count * strides)
    legs = SailedLegs(planned.ravel(), none, took, took.copy(), none.astype(np.int64))
    return legs, np.repeat(np.arange(count), strides)


def test_independent_legs_have_the_drift_they_are_drawn_with() -> None:
    legs, walk = walks(4000, 4, 0.005, 0.0)
    drift = drift_of_walks(legs, walk, 0.0)
    assert drift.value == pytest.approx(0.005, rel=0.05)
    assert drift.error == pytest.approx(0.005 / math.sqrt(8000.0), rel=0.1)


def test_legs_that_are_late_together_scatter_more() -> None:
    """Of n legs of equal length with paces in common, the sum scatters sqrt(n) times as much."""
    legs, walk = walks(20_000, 4, 0.0, 0.01)
    legs.unhindered[:] *= 600.0 / legs.planned
    legs.planned[:] = 600.0
    assert drift_of_walks(legs, walk, 0.0).value == pytest.approx(0.02, rel=0.05)


def test_the_pace_is_told_whatever_failed() -> None:
    legs, _ = walks(5000, 4, 0.15, 0.0)
    legs.lengths_km[:] = legs.planned / 1000.0
    fit = fit_uncertainty(legs)
    assert fit.pace.value == pytest.approx(1.0, abs=4.0 * fit.pace.error)
    assert fit.scatter.value == pytest.approx(0.15, abs=4.0 * fit.scatter.error)
    legs.unhindered[::10] = math.inf
    assert fit_uncertainty(legs).pace.value == pytest.approx(0.9, abs=0.01)


def test_a_leg_that_failed_is_no_part_of_its_walk() -> None:
    legs, walk = walks(50, 4, 0.1, 0.1)
    done = np.arange(len(walk)) % 7 > 0
    times, none = legs.unhindered[done], legs.manoeuvres[done]
    without = SailedLegs(legs.planned[done], legs.lengths_km[done], times, times, none)
    legs.unhindered[~done] = math.inf
    assert drift_of_walks(legs, walk, 0.0) == drift_of_walks(without, walk[done], 0.0)


def test_the_vehicle_manoeuvres_as_often_as_obstacles_lie_in_its_way(water: Water) -> None:
    rng = np.random.default_rng(5)
    tracks = [np.array([[0.0, 0.0], [2000.0, 0.0]])] * 60
    grid = water(0.1, 0.3)
    planned = [track_time(grid, track, 0.0, 1.0) for track in tracks]
    rocks = [strewn_discs(track, 4.0, (10.0, 30.0), rng) for track in tracks]
    legs = sail_legs(tracks, planned, [grid] * 60, rocks, Vehicle(1.0))
    fit = fit_uncertainty(legs)
    assert fit.failed == 0
    assert legs.lengths_km == pytest.approx(2.0)
    assert fit.drift.value < 0.01  # the plan knew the current
    expected = 4.0 * 2.0 * (0.02 + 0.01) * 0.9  # per kilometre, less what is clear at the ends
    assert fit.manoeuvres_per_km.value == pytest.approx(
        expected, abs=4.0 * fit.manoeuvres_per_km.error
    )
    assert 5.0 < fit.manoeuvre_time.value < 60.0


def test_a_current_that_the_plan_did_not_know_is_drift(water: Water) -> None:
    rng = np.random.default_rng(6)
    tracks = [np.array([[0.0, 0.0], [1500.0, 0.0]])] * 40
    planned = [1500.0] * 40  # as in still water
    grids = [water(current, 0.0) for current in rng.normal(0.0, 0.1, 40)]
    rocks = [strewn_discs(track, 0.0, (1.0, 1.0), rng) for track in tracks]
    fit = fit_uncertainty(sail_legs(tracks, planned, grids, rocks, Vehicle(1.0)))
    assert fit.drift.value == pytest.approx(0.1, abs=0.035)
    assert fit.manoeuvres_per_km.value == 0.0
    assert fit.uncertainty.manoeuvre_time == 0.0
