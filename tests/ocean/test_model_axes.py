import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.ocean.model_axes import find_axes, find_coordinate


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
