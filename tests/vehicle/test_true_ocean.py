"""True oceans: as rough as is stated, on every scale, and the forecast where nothing is unknown."""

import numpy as np
import pytest

from fiveroute.instance import Uncertainty
from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import CurrentGrid, Region, grid_current, velocity
from fiveroute.ocean.currents import LambVortices
from fiveroute.vehicle.true_ocean import Forecast

STOPS = np.array([[0.0, 0.0], [10_000.0, 2000.0], [4000.0, 9000.0]])
CALM = Uncertainty()


def forecast(size: float = 1.0, speed: float = 1.0, drift: float = 0.17) -> Forecast:
    return Forecast.of(None, None, size * STOPS, speed, Uncertainty(drift=drift))


def rms(grid: CurrentGrid) -> float:
    return float(np.sqrt((grid.uv**2).sum(axis=-1).mean()))


def test_where_nothing_is_unknown_the_forecast_is_the_truth() -> None:
    swirl = LambVortices(*np.array([[5000.0], [4000.0], [900.0], [800.0]]))
    grid = grid_current(swirl, Region.around(STOPS, 2000.0))
    rock = no_barriers()._replace(circles=np.array([[5000.0, 5000.0, 200.0]]), margin=50.0)
    truth = Forecast.of(grid, rock, STOPS, 1.0, CALM).truth(np.random.default_rng(1), 10.0)
    for x, y in ((5200.0, 4100.0), (100.0, 8000.0)):
        assert velocity(truth.grid, x, y, 0.0) == pytest.approx(velocity(grid, x, y, 0.0), abs=1e-3)
    assert (truth.barriers.circles == rock.circles).all()
    assert truth.barriers.margin == 0.0  # a line on the map


def test_the_field_has_the_scale_of_the_mission_and_the_vehicle() -> None:
    one = forecast().truth(np.random.default_rng(2), 10.0).grid
    other = forecast(0.1, 2.0, 0.34).truth(np.random.default_rng(2), 10.0).grid
    assert other.uv == pytest.approx(4.0 * one.uv, abs=1e-9)
    assert other.step == pytest.approx(0.1 * one.step)


def test_it_is_as_strong_as_the_papers_field() -> None:
    fields = [forecast().truth(np.random.default_rng(k), 10.0).grid for k in range(30)]
    assert np.mean([rms(field) for field in fields]) == pytest.approx(0.21, abs=0.04)


def test_a_straight_track_meets_as_many_discs_as_are_stated() -> None:
    rough = Uncertainty(manoeuvres_per_km=0.5)
    sea = Forecast.of(None, None, STOPS, 1.0, rough)
    met = kilometres = 0.0
    for seed in range(20):
        circles = sea.truth(np.random.default_rng(seed), 10.0).barriers.circles
        for y in range(500, 9000, 500):
            across = np.abs(circles[:, 1] - y) < circles[:, 2] + 10.0
            met += (across & (circles[:, 0] > 0.0) & (circles[:, 0] < 10_000.0)).sum()
            kilometres += 10.0
    assert 0.3 < met / kilometres < 0.5  # some are left out, so that passages stay open


def test_the_same_numbers_draw_the_same_ocean() -> None:
    one, two = (forecast().truth(np.random.default_rng(7), 10.0) for _ in range(2))
    assert (one.grid.uv == two.grid.uv).all()
    assert (one.barriers.circles == two.barriers.circles).all()
