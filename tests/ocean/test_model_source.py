from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from fiveroute.errors import InputError
from fiveroute.ocean.model_source import Source, read_source


def source(data: xr.Dataset) -> Source:
    return read_source(data, origin=None, depth=0.0, u=None, v=None, reach=1e5)


def test_a_coast_closes_the_faces_of_a_c_grid(sea: SimpleNamespace) -> None:
    wet = np.ones((14, 17), dtype=bool)
    wet[5:8, 6:10] = False
    whole, cut = source(sea.roms()).cells, source(sea.roms(wet)).cells
    inner = wet[1:-1, 1:-1]
    np.testing.assert_array_equal(cut.land, ~inner)
    beside = np.zeros_like(wet)
    beside[4:9, 6:10] = beside[5:8, 5:11] = True
    far = inner & ~beside[1:-1, 1:-1]
    np.testing.assert_array_equal(cut.w[0][far], whole.w[0][far])
    # in the cell west of the land only half of the velocity along its row is left
    turn = np.exp(-1j * sea.stereographic(*np.meshgrid(*sea.axes(14, 17)))[2][6, 5])
    one, other = (part.w[0, 5, 4] * turn for part in (cut, whole))
    assert one.imag == pytest.approx(other.imag, abs=2e-3)
    assert one.real == pytest.approx(other.real / 2.0, abs=1e-2)


def test_fills_tell_the_coast_where_there_are_no_masks(sea: SimpleNamespace) -> None:
    wet = np.ones((14, 17), dtype=bool)
    wet[5:8, 6:10] = False
    data = sea.roms(wet)
    bare = source(data.drop_vars(["mask_u", "mask_v", "mask_rho"]))
    masked = source(data)
    np.testing.assert_array_equal(bare.cells.w, masked.cells.w)
    assert "by missing values" in bare.notes["land"]
    assert "by mask_rho" in masked.notes["land"]


def test_rotation_and_map_keep_the_speed(sea: SimpleNamespace) -> None:
    data = sea.norkyst()
    speed = 0.001 * np.hypot(data["u"].values[:, 0].astype(float), data["v"].values[:, 0])
    np.testing.assert_allclose(np.abs(source(data).cells.w), speed, rtol=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda data: data.isel(eta_v=slice(0, 5)), "not on the faces of cells"),
        (lambda data: data.drop_vars("lon_rho"), "not on the faces of cells"),
        (lambda data: data.assign(mask_rho=data["mask_rho"] * 0.0), "no water within reach"),
    ],
)
def test_refuses_faces_without_cells(
    change: Callable[[xr.Dataset], xr.Dataset], message: str, sea: SimpleNamespace
) -> None:
    with pytest.raises(InputError, match=message):
        source(change(sea.roms()))
