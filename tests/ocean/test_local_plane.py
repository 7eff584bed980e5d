import numpy as np
import pyproj
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.ocean.local_plane import LocalPlane

GEOD = pyproj.Geod(ellps="WGS84")

longitudes, latitudes = st.floats(-180.0, 180.0), st.floats(-85.0, 85.0)


@settings(deadline=None, max_examples=30)
@given(longitudes, latitudes, st.floats(0.0, 360.0), st.floats(0.0, 3e5))
def test_keeps_distances_and_directions_from_its_origin(
    lon: float, lat: float, azimuth: float, distance: float
) -> None:
    plane = LocalPlane(lon, lat)
    there = np.array(GEOD.fwd(lon, lat, azimuth, distance)[:2])
    x, y = plane.project(there[0], there[1])
    assert x == pytest.approx(distance * np.sin(np.radians(azimuth)), abs=1e-3)
    assert y == pytest.approx(distance * np.cos(np.radians(azimuth)), abs=1e-3)
    back = plane.unproject(x, y)
    assert GEOD.inv(*back, *there)[2] == pytest.approx(0.0, abs=1e-3)


def test_east_turns_by_the_sine_of_the_latitude() -> None:
    plane = LocalPlane(4.8, 60.8)
    lon, lat = np.array([4.3, 4.8, 5.3]), np.full(3, 60.8)
    expected = -np.radians(lon - 4.8) * np.sin(np.radians(60.8))
    np.testing.assert_allclose(np.abs(plane.turn(lon, lat)), np.abs(expected), rtol=2e-3, atol=1e-9)
    ahead = plane.project(lon + 1e-5, lat)
    here = plane.project(lon, lat)
    direction = np.arctan2(ahead[1] - here[1], ahead[0] - here[0])
    np.testing.assert_allclose(plane.turn(lon, lat), direction, atol=1e-4)


def test_states_itself() -> None:
    assert LocalPlane(4.8, 60.8).proj == "+proj=aeqd +lat_0=60.8 +lon_0=4.8 +datum=WGS84 +units=m"


@pytest.mark.parametrize("origin", [(0.0, 91.0), (0.0, np.nan), (np.inf, 0.0)])
def test_refuses_what_is_no_place(origin: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="origin"):
        LocalPlane(*origin)
