import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.ocean.model_variables import find_axes, find_coordinate, find_velocity

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


@pytest.mark.parametrize("dims", [("t", "k", "y", "x"), ("x", "y", "k", "t"), ("k", "x", "t", "y")])
def test_tells_axes_apart_in_any_order(dims: tuple[str, ...]) -> None:
    sizes = {"t": 2, "k": 3, "y": 4, "x": 5}
    data = xr.Dataset(
        {
            "u": (dims, np.zeros([sizes[dim] for dim in dims])),
            "when": ("t", [0.0, 1.0], {"units": "days since 2000-01-01"}),
            "down": ("k", [0.0, 1.0, 2.0], {"positive": "down"}),
            "x": ("x", np.arange(5.0), {"axis": "X"}),
            "y": ("y", np.arange(4.0), {"axis": "Y"}),
        }
    )
    axes = find_axes(data, "u")
    assert (axes.time, axes.depth, axes.rows, axes.columns) == ("t", "k", "y", "x")
    assert (axes.time_variable, axes.depth_variable) == ("when", "down")


def test_leaves_a_single_member_of_an_ensemble_out() -> None:
    data = xr.Dataset({"u": (("member", "lat", "lon"), np.zeros((1, 2, 2)))})
    assert find_axes(data, "u").rows == "lat"
    many = xr.Dataset({"u": (("member", "lat", "lon"), np.zeros((3, 2, 2)))})
    with pytest.raises(InputError, match=r"u.member: has a dimension of size 3"):
        find_axes(many, "u")


@pytest.mark.parametrize("dims", [("time", "siglay", "nele"), ("time", "node"), ("cell",)])
def test_refuses_unstructured_grids(dims: tuple[str, ...]) -> None:
    data = xr.Dataset({"u": (dims, np.zeros([2] * len(dims)))})
    with pytest.raises(InputError, match=r"unstructured grid .*; interpolate it to a grid"):
        find_axes(data, "u")


def test_takes_the_coordinate_with_the_better_sign() -> None:
    dims = ("y", "x")
    data = xr.Dataset(
        {
            "lon": (dims, np.zeros((2, 2))),
            "a": (dims, np.zeros((2, 2)), {"units": "degrees_east"}),
            "b": (dims, np.zeros((2, 2)), {"standard_name": "longitude"}),
            "far": (("q",), np.zeros(2), {"standard_name": "longitude"}),
        }
    )
    assert find_coordinate(data, "lon", dims) == "b"
    assert find_coordinate(data.drop_vars("b"), "lon", dims) == "a"
    assert find_coordinate(data.drop_vars(["a", "b"]), "lon", dims) == "lon"
    assert find_coordinate(data, "lat", dims) is None
