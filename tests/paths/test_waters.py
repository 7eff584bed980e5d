import math

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import CurrentGrid
from fiveroute.paths.waters import Waters

STILL = CurrentGrid(np.zeros((1, 4, 4, 2)), 0.0, 0.0, 1000.0, 0.0, 1.0)


def test_an_auv_must_move_and_turn() -> None:
    assert Waters(STILL, no_barriers(), 1.0).turning_radius == 0.0
    for speed in (0.0, -1.0, math.nan):
        with pytest.raises(InputError, match=r"speed: .*: an AUV must move"):
            Waters(STILL, no_barriers(), speed)
    for radius in (-1.0, math.nan):
        with pytest.raises(InputError, match=r"turning_radius: .*must not be negative"):
            Waters(STILL, no_barriers(), 1.0, radius)
