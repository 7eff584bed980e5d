import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from fiveroute.vehicle_files.simplify import simplified

METRES = st.integers(-1000, 1000).map(float)


@settings(deadline=None, max_examples=100)
@given(
    st.lists(st.tuples(METRES, METRES), min_size=2, max_size=30),
    st.floats(0.0, 50.0),
)
def test_what_is_left_out_lies_within_the_tolerance(
    places: list[tuple[float, float]], tolerance: float
) -> None:
    track = np.array(places)
    thin = simplified(track, tolerance)
    assert thin[[0, -1]].tolist() == track[[0, -1]].tolist()
    assert set(map(tuple, thin.tolist())) <= set(map(tuple, track.tolist()))
    line = LineString(thin)
    assert max(line.distance(Point(place)) for place in places) <= tolerance + 1e-9


def test_points_of_a_straight_line_are_left_out() -> None:
    track = np.linspace((0.0, 0.0), (300.0, 400.0), 50)
    assert len(simplified(track, 1e-9)) == 2


def test_a_bend_is_kept() -> None:
    track = np.array([(0.0, 0.0), (50.0, 0.0), (100.0, 2.0), (150.0, 0.0), (200.0, 0.0)])
    assert simplified(track, 1.0).tolist() == track[[0, 2, 4]].tolist()
    assert simplified(track, 3.0).tolist() == track[[0, 4]].tolist()


def test_a_way_there_and_back_keeps_its_end() -> None:
    track = np.array([(0.0, 0.0), (100.0, 0.0), (0.0, 0.0)])
    assert simplified(track, 1.0).tolist() == track.tolist()
