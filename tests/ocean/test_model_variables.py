import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.ocean.model_variables import find_velocity

EAST = ("eastward_sea_water_velocity", "northward_sea_water_velocity")
ALONG = ("x_sea_water_velocity", "y_sea_water_velocity")


def file(*pairs: tuple[str, str, tuple[str, str] | None]) -> xr.Dataset:
    """Pairs of components on one grid, with their standard names."""
    held = {}
    for u, v, standard in pairs:
        for name, of in zip((u, v), standard or ("", ""), strict=True):
            held[name] = (("lat", "lon"), np.zeros((3, 4)), {"standard_name": of} if of else {})
    return xr.Dataset(held)


@pytest.mark.parametrize(
    ("data", "expected", "along"),
    [
        (file(("a", "b", EAST)), ("a", "b"), False),
        (file(("u", "v", None), ("a", "b", EAST)), ("a", "b"), False),
        (file(("u", "v", ALONG), ("ue", "vn", EAST)), ("ue", "vn"), False),
        (file(("u", "v", ALONG)), ("u", "v"), True),
        (file(("utotal", "vtotal", EAST), ("uo", "vo", EAST)), ("uo", "vo"), False),
        (file(("utide", "vtide", EAST), ("uo", "vo", EAST)), ("uo", "vo"), False),
        (file(("water_u", "water_v", None)), ("water_u", "water_v"), False),
        (
            file(("u", "v", None), ("u_eastward", "v_northward", None)),
            ("u_eastward", "v_northward"),
            False,
        ),
        (file(("U", "V", None)), ("U", "V"), True),
        (file(("u_sur", "v_sur", None)), ("u_sur", "v_sur"), True),
        (
            file(
                ("u_sur", "v_sur", ("sea_water_surface_x_velocity", "sea_water_surface_y_velocity"))
            ),
            ("u_sur", "v_sur"),
            True,
        ),
        (file(("vozocrtx", "vomecrty", EAST)), ("vozocrtx", "vomecrty"), False),
    ],
)
def test_finds_velocities(data: xr.Dataset, expected: tuple[str, str], along: bool) -> None:
    found = find_velocity(data)
    assert (found.u, found.v, found.is_along_grid) == (*expected, along)


def test_says_when_there_are_none() -> None:
    with pytest.raises(InputError, match="no velocities of sea water among salt"):
        find_velocity(xr.Dataset({"salt": ("x", [1.0])}))
    with pytest.raises(InputError, match="no variables"):
        find_velocity(xr.Dataset())


def test_refuses_components_along_different_axes() -> None:
    data = file(("a", "n", EAST), ("u", "v", ALONG))
    with pytest.raises(InputError, match="do not stand along the same axes"):
        find_velocity(data, u="a", v="v")
