import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.model_axes import find_axes
from fiveroute.ocean.model_levels import Level, choose_level


def level(depths: NDArray[np.float64], depth: float, **attributes: str) -> Level:
    data = xr.Dataset(
        {
            "u": (("depth", "lat", "lon"), np.zeros((len(depths), 2, 2))),
            "depth": ("depth", depths, attributes),
        }
    )
    return choose_level(data, "u", find_axes(data, "u"), depth)


DEPTHS = np.array([0.5, 2.0, 10.0, 30.0])


@pytest.mark.parametrize(
    ("depth", "expected"),
    [
        (0.0, (0, 0, 0.0)),
        (0.5, (0, 0, 0.0)),
        (1.25, (0, 1, 0.5)),
        (10.0, (2, 2, 0.0)),
        (15.0, (2, 3, 0.25)),
        (30.0, (3, 3, 0.0)),
    ],
)
def test_lies_between_two_levels(depth: float, expected: tuple[int, int, float]) -> None:
    found = level(DEPTHS, depth)
    assert (found.upper, found.lower, found.share) == expected
    assert found.depths == (0.5, 30.0)


def test_turns_heights_and_reversed_levels_round() -> None:
    assert level(-DEPTHS, 15.0, positive="up").share == 0.25
    assert level(-DEPTHS, 15.0).depths == (0.5, 30.0)
    found = level(DEPTHS[::-1], 15.0)
    assert (found.upper, found.lower, found.share) == (1, 0, 0.25)


@pytest.mark.parametrize(
    ("depths", "depth", "message"),
    [
        (DEPTHS, 31.0, r"u: depth 31 m asked, but the file has 0.5 \.\. 30 m"),
        (np.array([50.0]), 0.0, r"depth 0 m asked, but the file has 50 \.\. 50 m"),
        (DEPTHS, -1.0, "at least 0 metres"),
        (DEPTHS, np.nan, "at least 0 metres"),
        (np.array([0.5, np.nan]), 0.0, "levels without a depth"),
    ],
)
def test_refuses_depths_without_data(
    depths: NDArray[np.float64], depth: float, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        level(depths, depth)


def test_refuses_other_units() -> None:
    with pytest.raises(InputError, match="'fathoms': is no unit of depth"):
        level(DEPTHS, 0.0, units="fathoms")


@pytest.mark.parametrize(("s", "top"), [([-0.9, -0.5, -0.1], 2), ([-0.1, -0.5, -0.9], 0)])
def test_takes_the_surface_layer_of_a_terrain_following_grid(s: list[float], top: int) -> None:
    attributes = {"standard_name": "ocean_sigma_coordinate"}
    assert level(np.array(s), 0.0, **attributes).upper == top
    with pytest.raises(InputError, match=r"u: 5 m asked, .* follow the terrain"):
        level(np.array(s), 5.0, **attributes)


def test_takes_the_last_layer_of_roms_without_its_coordinate() -> None:
    data = xr.Dataset({"u": (("s_rho", "eta_rho", "xi_rho"), np.zeros((3, 2, 2)))})
    assert choose_level(data, "u", find_axes(data, "u"), 0.0).upper == -1


def test_without_levels_only_the_surface_can_be_asked() -> None:
    data = xr.Dataset({"u": (("lat", "lon"), np.zeros((2, 2)))})
    assert choose_level(data, "u", find_axes(data, "u"), 0.0).depths is None
    with pytest.raises(InputError, match="3 m asked, but the variable has no levels"):
        choose_level(data, "u", find_axes(data, "u"), 3.0)


def test_numbers_of_levels_are_no_depths() -> None:
    data = xr.Dataset({"u": (("lev", "lat", "lon"), np.zeros((3, 2, 2))), "lev": [1.0, 2.0, 3.0]})
    with pytest.raises(InputError, match="lev: '': is no unit of depth"):
        choose_level(data, "u", find_axes(data, "u"), 0.0)
