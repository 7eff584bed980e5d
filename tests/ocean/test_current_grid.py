"""A current on a grid: cubic convolution's theory, and an error that is what it says."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from fiveroute.ocean.current_grid import (
    CurrentGrid,
    Region,
    grid_current,
    interpolation_error,
    refined,
    velocity,
)
from fiveroute.ocean.currents import (
    Current,
    DoubleGyre,
    LambVortices,
    Shear,
    Superposition,
    UniformCurrent,
)

Floats = NDArray[np.float64]

REGION = Region(-1000.0, 500.0, 3000.0, 3700.0)
GYRE = DoubleGyre(speed=0.4, size=2000.0, epsilon=0.25, omega=2.0 * math.pi / 12_000.0)


def vortices(seed: int = 1) -> LambVortices:
    rng = np.random.default_rng(seed)
    x, y, circulation, radius = rng.random((4, 6))
    return LambVortices(
        4000.0 * x - 1000.0, 500.0 + 3200.0 * y, 2000.0 * circulation - 1000.0, 300.0 + 500 * radius
    )


def ask(grid: CurrentGrid, x: Floats, y: Floats, t: float = 0.0) -> Floats:
    return np.array([velocity(grid, *place, t) for place in zip(x, y, strict=True)]).T


def inside(seed: int, count: int = 2000, region: Region = REGION) -> tuple[Floats, Floats]:
    x, y = np.random.default_rng(seed).random((2, count))
    return (
        region.west + (region.east - region.west) * x,
        region.south + (region.north - region.south) * y,
    )


def worst(grid: CurrentGrid, current: Current, t: float = 0.0, seed: int = 2) -> float:
    """Largest error at random points."""
    x, y = inside(seed)
    return float(np.hypot(*(ask(grid, x, y, t) - current(x, y, t))).max())


@dataclass(frozen=True)
class Cubic:
    """A polynomial of the third degree in x and y, of which cubic convolution misses the cubes."""

    is_steady: bool = True
    length_scale: float = 400.0

    def __call__(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> tuple[Floats, Floats]:
        a, b = np.asarray(x) / 1000.0 + 0.0 * np.asarray(y), np.asarray(y) / 1000.0
        return a**2 - 0.5 * a * b + b**2, a**3 + 0.0 * b


def test_region_lies_around_its_points() -> None:
    region = Region.around(np.array([[1.0, 2.0], [5.0, -3.0], [2.0, 9.0]]), 10.0)
    assert region == (-9.0, -13.0, 15.0, 19.0)


def test_a_grid_covers_its_region_and_a_cell_more() -> None:
    grid = grid_current(vortices(), REGION, step=130.0)
    assert grid.region.west == REGION.west - 130.0
    assert grid.region.south == REGION.south - 130.0
    assert 0.0 <= grid.region.east - REGION.east - 130.0 < 130.0
    assert 0.0 <= grid.region.north - REGION.north - 130.0 < 130.0


def test_interpolation_passes_through_the_grid() -> None:
    current, grid = vortices(), grid_current(vortices(), REGION, step=160.0)
    rows, columns = grid.uv.shape[1:3]
    i, j = np.indices((rows, columns)).reshape(2, -1)
    x, y = np.add(grid.west, 160.0 * j), np.add(grid.south, 160.0 * i)
    np.testing.assert_allclose(ask(grid, x, y), current(x, y), atol=1e-13)
    assert grid.fastest == pytest.approx(np.hypot(*current(x, y)).max())


def test_linear_and_quadratic_currents_are_exact() -> None:
    x, y = inside(3)
    for current in (UniformCurrent(0.3, -0.2), Shear(1e-4, 800.0)):
        grid = grid_current(current, REGION)
        np.testing.assert_allclose(ask(grid, x, y), current(x, y), atol=1e-14)
        assert interpolation_error(grid, current) < 1e-14
    grid = grid_current(Cubic(), REGION, step=250.0)
    np.testing.assert_allclose(ask(grid, x, y)[0], Cubic()(x, y)[0], atol=1e-12)


def test_a_cube_errs_by_its_theory() -> None:
    """By h^3 s (s - 1) (2 s - 1) at the share s of a cell: not at all halfway."""
    h = 250.0
    grid = grid_current(Cubic(), REGION, step=h)
    s = np.linspace(0.0, 1.0, 41)
    x = grid.west + h * (3.0 + s)
    error = ask(grid, x, np.full(41, 1000.0))[1] - Cubic()(x, 0.0)[1]
    theory = (h / 1000.0) ** 3 * s * (s - 1.0) * (2.0 * s - 1.0)
    np.testing.assert_allclose(error, theory, atol=1e-13)
    assert interpolation_error(grid, Cubic()) == pytest.approx(h**3 / 1e9 / 108**0.5)


def test_interpolation_is_of_third_order() -> None:
    current = vortices()
    errors = [worst(grid_current(current, REGION, step=h), current) for h in (80.0, 40.0, 20.0)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders > 2.7).all()
    assert (orders < 3.5).all()


@pytest.mark.parametrize("step", [320.0, 160.0, 80.0, 40.0, 20.0, 10.0])
@pytest.mark.parametrize("seed", [1, 2])
def test_the_stated_error_is_the_real_one(step: float, seed: int) -> None:
    current = vortices(seed)
    grid = grid_current(current, REGION, step=step)
    stated, real = interpolation_error(grid, current), worst(grid, current)
    assert real <= 1.25 * stated
    assert stated <= 2.0 * real


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_a_grid_keeps_its_tolerance(tolerance: float) -> None:
    for current in (vortices(), Superposition((UniformCurrent(0.2, 0.1), vortices(5)))):
        grid = grid_current(current, REGION, tolerance=tolerance)
        assert worst(grid, current) <= 1.25 * tolerance


def test_the_time_is_interpolated_linearly() -> None:
    grid = grid_current(GYRE, REGION, duration=12_000.0, step=100.0)
    assert not grid.is_steady
    x, y = inside(4, 50)
    k = 17
    before, after = (ask(grid, x, y, grid.every * n) for n in (k, k + 1))
    between = ask(grid, x, y, grid.every * (k + 0.25))
    np.testing.assert_allclose(between, 0.75 * before + 0.25 * after, atol=1e-14)
    np.testing.assert_allclose(before, GYRE(x, y, grid.every * k), atol=1e-3)


@pytest.mark.parametrize("tolerance", [3e-3, 3e-4])
def test_a_changing_current_keeps_the_tolerance_too(tolerance: float) -> None:
    grid = grid_current(GYRE, REGION, duration=12_000.0, tolerance=tolerance)
    assert interpolation_error(grid, GYRE) <= 2.0 * tolerance  # one in space and one in time
    for share in (0.03, 0.5, 0.77):
        assert worst(grid, GYRE, share * 12_000.0) <= 2.5 * tolerance


@pytest.mark.parametrize("swings", [3, 6, 12])
def test_a_current_cannot_swing_unseen_between_the_times(swings: int) -> None:
    """Though it be the same at all times of a coarser grid, and halfway between them."""
    gyre = replace(GYRE, omega=2.0 * math.pi * swings / 12_000.0)
    grid = grid_current(gyre, REGION, duration=12_000.0, tolerance=0.02)
    for share in np.random.default_rng(6).random(5):
        assert worst(grid, gyre, share * 12_000.0) <= 0.025


def test_a_grid_of_many_times_has_fewer_points() -> None:
    """Within the memory of the finest steady grid, whatever the tolerance."""
    grid = grid_current(GYRE, REGION, duration=1e6, tolerance=1e-9)
    assert grid.uv.nbytes <= 16 * 1600**2


def test_a_time_beyond_the_grid_is_its_first_or_last() -> None:
    grid = grid_current(GYRE, REGION, duration=5000.0, step=200.0)
    x, y = inside(5, 50)
    np.testing.assert_array_equal(ask(grid, x, y, -100.0), ask(grid, x, y, 0.0))
    np.testing.assert_allclose(ask(grid, x, y, 9000.0), ask(grid, x, y, 5000.0), atol=1e-14)


def test_a_steady_current_has_one_time() -> None:
    assert grid_current(vortices(), REGION, duration=9000.0, step=300.0).is_steady
    assert grid_current(GYRE, REGION, step=300.0).is_steady  # nobody asks for a duration


def test_a_position_beyond_the_grid_is_at_its_edge() -> None:
    grid = grid_current(vortices(), REGION, step=200.0)
    west, south, east, north = grid.region
    for far, near in (
        ((west - 500.0, 900.0), (west, 900.0)),
        ((east + 1e9, north + 1.0), (east, north)),
        ((700.0, south - 1e-3), (700.0, south)),
    ):
        assert velocity(grid, *far, 0.0) == pytest.approx(velocity(grid, *near, 0.0), abs=1e-14)


def test_interpolation_is_smooth() -> None:
    """Continuous derivatives: one-sided slopes agree across a grid line."""
    grid, h = grid_current(vortices(), REGION, step=200.0), 1e-4
    x = np.array([grid.west + 200.0 * 5])
    y = np.array([1234.0])
    here, left, right = (ask(grid, x + shift, y) for shift in (0.0, -h, h))
    np.testing.assert_allclose((here - left) / h, (right - here) / h, atol=1e-8)


def test_a_refined_grid_is_the_same_current() -> None:
    coarse = grid_current(GYRE, REGION, duration=6000.0, step=200.0)
    fine = refined(coarse, 60.0)
    assert fine.step == 50.0
    assert fine.region == pytest.approx(coarse.region)
    for x, y, t in ((0.0, 1000.0, 0.0), (1330.0, 2710.0, 1700.0), (2999.0, 501.0, 6000.0)):
        assert velocity(fine, x, y, t) == pytest.approx(velocity(coarse, x, y, t), abs=1e-4)
    assert refined(fine, 60.0) is fine
