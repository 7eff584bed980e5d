"""Distances to a mask's land, against the exact ones to its square cells."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import Barriers, clearance, no_barriers
from fiveroute.ocean.land_mask import LandDistance, land_distance

Mask = NDArray[np.bool_]

WEST, SOUTH, STEP = -300.0, 1000.0, 40.0


def random_mask(seed: int) -> Mask:
    rng = np.random.default_rng(seed)
    mask = rng.random(rng.integers(1, 8, 2)) < rng.uniform(0.1, 0.9)
    mask.flat[0] = False
    return np.asarray(mask)


def squares(mask: Mask) -> shapely.geometry.base.BaseGeometry:
    """The union of the marked cells."""
    half = STEP / 2.0
    return shapely.union_all(
        [
            shapely.box(x - half, y - half, x + half, y + half)
            for i, j in np.argwhere(mask)
            for x, y in [(WEST + STEP * j, SOUTH + STEP * i)]
        ]
    )


def as_barriers(land: LandDistance) -> Barriers:
    return no_barriers()._replace(
        land=land.distance, land_west=land.west, land_south=land.south, land_step=land.step
    )


@given(seed=st.integers(0, 2**32))
@settings(deadline=None, max_examples=60)
def test_distances_are_exact_on_their_grid(seed: int) -> None:
    mask = random_mask(seed)
    land = land_distance(mask, WEST, SOUTH, STEP)
    if not mask.any():
        assert land.distance.size == 0
        return
    ashore, afloat = squares(mask), squares(~mask)
    rows, columns = mask.shape
    assert land.distance.shape == (2 * rows + 1, 2 * columns + 1)
    for i, j in np.ndindex(land.distance.shape):
        point = shapely.Point(land.west + j * land.step, land.south + i * land.step)
        expected = shapely.distance(ashore, point) - shapely.distance(afloat, point)
        assert land.distance[i, j] == pytest.approx(expected, abs=1e-9)


@given(seed=st.integers(0, 2**32))
@settings(deadline=None, max_examples=60)
def test_the_coast_is_where_it_is_everywhere(seed: int) -> None:
    """Interpolated between the grid's points, the sign is that of the cell, and little is lost."""
    mask = random_mask(seed)
    mask.flat[-1] |= mask.size > 1
    if not mask.any():
        return
    known, ashore = as_barriers(land_distance(mask, WEST, SOUTH, STEP)), squares(mask)
    rows, columns = mask.shape
    for across, up in np.random.default_rng(seed).random((50, 2)) * (columns, rows):
        x, y = WEST + STEP * (across - 0.5), SOUTH + STEP * (up - 0.5)
        found = clearance(known, x, y)
        if mask[int(up), int(across)]:
            assert found <= 1e-9
        else:
            assert found >= -1e-9
            exact = shapely.distance(ashore, shapely.Point(x, y))
            assert abs(found - exact) <= STEP / 4.0


def test_a_straight_coast_lies_halfway_between_its_cells() -> None:
    mask = np.zeros((6, 9), dtype=np.bool_)
    mask[:, 5:] = True
    known = as_barriers(land_distance(mask, WEST, SOUTH, STEP))
    coast = WEST + 4.5 * STEP
    for x, y in np.random.default_rng(1).uniform((WEST, SOUTH), (WEST + 300.0, 1200.0), (100, 2)):
        assert clearance(known, x, y) == pytest.approx(coast - x, abs=1e-9)


def test_an_island_is_round_from_afar() -> None:
    """A disc of cells: the distance of the disc, up to the size of a cell's corner."""
    i, j = np.indices((81, 81))
    mask = np.hypot(i - 40, j - 40) * STEP <= 500.0
    known = as_barriers(land_distance(mask, -1600.0, -1600.0, STEP))
    for x, y in np.random.default_rng(2).uniform(-1500.0, 1500.0, (200, 2)):
        assert clearance(known, x, y) == pytest.approx(math.hypot(x, y) - 500.0, abs=STEP)


def test_a_mask_without_land_is_no_barrier() -> None:
    land = land_distance(np.zeros((3, 4), dtype=np.bool_), WEST, SOUTH, STEP)
    assert as_barriers(land).is_open


@pytest.mark.parametrize(
    ("mask", "step", "words"),
    [
        (np.ones((3, 4), dtype=np.bool_), 40.0, "is_land: there is no water at all"),
        (np.zeros((0, 4), dtype=np.bool_), 40.0, "is_land: .*must be a two-dimensional"),
        (np.zeros(4, dtype=np.bool_), 40.0, "is_land: .*must be a two-dimensional"),
        (np.zeros((3, 4)), 40.0, "is_land: .*must be a two-dimensional array of truth"),
        (np.zeros((3, 4), dtype=np.bool_), 0.0, "step: 0.0: cells need a positive side"),
        (np.zeros((3, 4), dtype=np.bool_), math.nan, "step: nan: cells need a positive side"),
    ],
)
def test_what_is_no_mask_is_refused(mask: Mask, step: float, words: str) -> None:
    with pytest.raises(InputError, match=words):
        land_distance(mask, WEST, SOUTH, step)
