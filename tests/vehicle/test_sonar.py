"""What beams meet, against distances that are known."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import Barriers, clearance, no_barriers
from fiveroute.vehicle.dynamics import State
from fiveroute.vehicle.sonar import Sonar, land_of, listen

HERE = State(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)
DISC = no_barriers()._replace(circles=np.array([[40.0, 0.0, 10.0]]))
WALL = no_barriers()._replace(
    corners=np.array([[20.0, -90.0], [30.0, -90.0], [30.0, 90.0], [20.0, 90.0]]),
    first=np.array([0, 4]),
)
COAST = no_barriers()._replace(  # land beyond x = 25
    land=np.tile(25.0 - np.arange(-100.0, 101.0, 10.0), (21, 1)),
    land_west=-100.0,
    land_south=-100.0,
    land_step=10.0,
)


def echoes(
    barriers: Barriers, state: State = HERE, sonar: Sonar | None = None
) -> NDArray[np.float64]:
    found = np.empty((500, 2))
    fan = (sonar or Sonar()).fan
    return found[: listen(fan, barriers, land_of(barriers), state, found, 0)]


@pytest.mark.parametrize("barriers", [DISC, WALL, COAST], ids=["disc", "wall", "coast"])
def test_echoes_come_from_the_outline(barriers: Barriers) -> None:
    heard = echoes(barriers)
    assert len(heard) >= 5
    assert all(abs(clearance(barriers, x, y)) < 0.26 for x, y in heard)
    assert (np.hypot(*heard.T) < 60.0).all()


def test_the_first_echo_of_a_beam_hides_what_is_behind() -> None:
    both = WALL._replace(circles=DISC.circles)
    assert np.array_equal(echoes(both), echoes(WALL))


@pytest.mark.parametrize("heading", [math.pi, math.radians(120.0)])
def test_what_is_astern_is_not_heard(heading: float) -> None:
    assert len(echoes(DISC, HERE._replace(heading=heading))) == 0


def test_what_is_out_of_range_is_not_heard() -> None:
    assert len(echoes(DISC, HERE._replace(x=-31.0))) == 0
    assert len(echoes(DISC, HERE._replace(x=-29.0))) > 0


def test_a_margin_is_a_line_on_the_map() -> None:
    assert np.array_equal(echoes(DISC._replace(margin=15.0)), echoes(DISC))


def test_echoes_are_told_apart_and_the_oldest_forgotten() -> None:
    found, fan = np.empty((5, 2)), Sonar(beams=201).fan
    heard = listen(fan, WALL, land_of(WALL), HERE, found, 0)
    assert heard > 5
    gaps = np.hypot(*(found[:, None] - found[None]).transpose(2, 0, 1)) + 9.0 * np.eye(5)
    assert gaps.min() >= 3.0


@pytest.mark.parametrize(
    ("field", "value"), [("reach", 0.0), ("period", -1.0), ("field_of_view", 7.0), ("beams", 1)]
)
def test_a_sonar_of_bad_numbers_is_refused(field: str, value: float) -> None:
    with pytest.raises(InputError, match=field):
        Sonar(**{field: value})  # type: ignore[arg-type]
