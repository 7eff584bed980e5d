"""Currents to sail in."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.ocean.current_grid import CurrentGrid

Water = Callable[[float, float], CurrentGrid]


def uniform_water(u: float, v: float) -> CurrentGrid:
    """A uniform current, east and north, in metres per second."""
    uv: NDArray[np.float64] = np.broadcast_to([u, v], (1, 4, 4, 2)).astype(np.float64)
    return CurrentGrid(uv, -1e5, -1e5, 1e5, 0.0, 1.0)


@pytest.fixture
def water() -> Water:
    return uniform_water
