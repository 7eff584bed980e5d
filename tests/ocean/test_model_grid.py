import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.model_grid import (
    CellGrid,
    bilinear,
    cells_from_faces,
    direction_of_rows,
    is_left_handed,
    resample,
)

Floats = NDArray[np.float64]
NAN = np.nan


def bent(n: int) -> tuple[Floats, Floats]:
    """An n x n grid of ten kilometres that is turned by 40 degrees and bent."""
    s, r = np.meshgrid(np.linspace(0.0, 1.0, n), np.linspace(0.0, 1.0, n))
    z = 1e4 * (s + 1j * r + 0.1 * (s + 1j * r) ** 2) * np.exp(1j * np.radians(40.0))
    return z.real, z.imag


def swirl(x: Floats, y: Floats) -> NDArray[np.complex128]:
    return np.asarray(np.sin(x / 3e3) * np.cos(y / 2e3) + 1j * np.cos(x / 2e3 + y / 4e3))


def test_interpolates_in_second_order() -> None:
    errors = []
    for n in (17, 33, 65):
        x, y = bent(n)
        grid = resample(CellGrid(x, y, swirl(x, y)[None]))
        j, i = np.argwhere(grid.covered).T
        at = [np.asarray(z) for z in (grid.west + grid.step * i, grid.south + grid.step * j)]
        within = np.hypot(at[0] - x.mean(), at[1] - y.mean()) < 4e3
        w = grid.uv[0, j, i, 0] + 1j * grid.uv[0, j, i, 1]
        errors.append(np.abs(w - swirl(*at))[within].max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.35)


def test_covers_the_cells_to_half_their_size() -> None:
    x, y = np.meshgrid(np.arange(5) * 100.0, np.arange(4) * 100.0)
    grid = resample(CellGrid(x, y, np.ones((1, 4, 5), dtype=complex)))
    across = grid.west + grid.step * np.arange(grid.land.shape[1])
    up = grid.south + grid.step * np.arange(grid.land.shape[0])
    within = ((across >= -50.0) & (across <= 450.0), (up >= -50.0) & (up <= 350.0))
    np.testing.assert_array_equal(grid.covered, within[1][:, None] & within[0])
    assert (grid.uv == [1.0, 0.0]).all()


def test_no_data_reach_to_the_rim() -> None:
    x, y = np.meshgrid(np.arange(5) * 100.0, np.arange(4) * 300.0)
    grid = resample(CellGrid(x, y, np.ones((1, 4, 5), dtype=complex)))
    inner = grid.covered[1:-1, 1:-1]
    assert inner.any()
    assert grid.covered.sum() == inner.sum()


def test_land_lends_the_nearest_water_and_stays_land() -> None:
    x, y = np.meshgrid(np.arange(6) * 100.0, np.arange(6) * 100.0)
    w = np.full((2, 6, 6), 0.3 + 0.1j)
    w[0, 2, 3] = NAN  # dry at one time is dry
    cells = CellGrid(x, y, w)
    assert cells.land.sum() == 1
    grid = resample(cells)
    np.testing.assert_allclose(grid.uv, np.broadcast_to([0.3, 0.1], grid.uv.shape))
    j, i = np.nonzero(grid.land)
    assert (np.abs(grid.west + grid.step * i - 300.0) <= 50.0).all()
    assert (np.abs(grid.south + grid.step * j - 200.0) <= 50.0).all()
    assert len(i) == round((cells.spacing / grid.step + 1) ** 2)  # borders belong to the land


def test_cells_without_a_position_are_not_covered() -> None:
    x, y = np.meshgrid(np.arange(8) * 100.0, np.arange(8) * 100.0)
    x[:3, :3] = y[:3, :3] = NAN
    grid = resample(CellGrid(x, y, np.ones((1, 8, 8), dtype=complex)))
    assert np.isfinite(grid.uv).all()
    j, i = round((100.0 - grid.south) / grid.step), round((100.0 - grid.west) / grid.step)
    assert not grid.covered[j, i]
    assert grid.covered[-j, -i]


def test_refuses_more_than_memory_holds() -> None:
    x, y = np.meshgrid(np.arange(3) * 100.0, np.arange(3) * 1e10)
    with pytest.raises(InputError, match=r"reach: takes .* velocities"):
        resample(CellGrid(x, y, np.ones((1, 3, 3), dtype=complex)))


def test_bilinear_is_exact_for_planes_and_constant_beyond() -> None:
    row, column = np.mgrid[0:4, 0:5].astype(np.float64)
    values = ((2.0 + row - 3.0 * column) * (1.0 + 2.0j))[None]
    j, i = np.array([0.0, 1.25, 3.0, 9.0]), np.array([0.5, 2.75, 4.0, -1.0])
    expected = (2.0 + np.clip(j, 0, 3) - 3.0 * np.clip(i, 0, 4)) * (1.0 + 2.0j)
    np.testing.assert_allclose(bilinear(values, j, i)[0], expected)


def test_takes_the_mean_of_the_faces() -> None:
    u = np.array([[[0.1, 0.3, 0.5], [1.0, 1.0, 1.0]]])
    v = np.array([[[0.2, 0.2], [0.4, 0.6], [0.0, 0.0]]])
    in_u, in_v = cells_from_faces(u, v)
    np.testing.assert_allclose(in_u, [[[0.2, 0.4], [1.0, 1.0]]])
    np.testing.assert_allclose(in_v, [[[0.3, 0.4], [0.2, 0.3]]])


def test_nothing_flows_through_a_coast() -> None:
    # three cells from west to east, the last one land; the data have nothing on its faces
    u = np.array([[[0.4, 0.6, NAN, NAN]]])
    v = np.array([[[0.1, 0.1, NAN], [0.1, 0.1, NAN]]])
    in_u, in_v = cells_from_faces(u, v)
    np.testing.assert_allclose(in_u, [[[0.5, 0.3, NAN]]])
    np.testing.assert_allclose(in_v, [[[0.1, 0.1, NAN]]])


def test_what_is_missing_in_open_water_stays_missing() -> None:
    u, v = np.array([[[0.4, NAN, 0.4]]]), np.full((1, 2, 2), 0.1)
    open_u, open_v = np.zeros((1, 3), dtype=bool), np.zeros((2, 2), dtype=bool)
    assert np.isnan(cells_from_faces(u, v, open_u, open_v)[0]).all()


def test_knows_the_direction_of_its_rows() -> None:
    x, y = bent(9)
    s, r = np.meshgrid(np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 9))
    exact = np.radians(40.0) + np.angle(1.0 + 0.2 * (s + 1j * r))
    np.testing.assert_allclose(direction_of_rows(x, y), exact, atol=1e-12)
    assert not is_left_handed(x, y)
    assert is_left_handed(x[::-1], y[::-1])
