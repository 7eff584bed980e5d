import numpy as np
import pytest

from fiveroute.ocean.barriers import Barriers, no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import UniformCurrent
from fiveroute.paths.first_paths import arcs, detours, first_controls, joined, sideways
from fiveroute.paths.legs import track_clearance
from fiveroute.paths.path_cost import path_cost, path_problem
from fiveroute.paths.waters import Waters

START, GOAL = np.array([0.0, 0.0]), np.array([3000.0, 4000.0])
ALONG, LEFT = np.array([0.6, 0.8]), np.array([-0.8, 0.6])


def circles(*places: tuple[float, float, float]) -> Barriers:
    """Circles by their distance along the line and to its left, and their radius."""
    centres = [[*(s * ALONG + d * LEFT), radius] for s, d, radius in places]
    return no_barriers()._replace(circles=np.array(centres).reshape(-1, 3))


def test_arcs_begin_with_the_straight_line_and_go_to_both_sides() -> None:
    tracks = list(arcs(START, GOAL))
    assert np.abs(tracks[0] @ LEFT).max() < 1e-9
    assert all(np.allclose(track[[0, -1]], [START, GOAL]) for track in tracks)
    middle = [float(track[len(track) // 2] @ LEFT) for track in tracks]
    assert min(middle) == pytest.approx(-1500.0)
    assert max(middle) == pytest.approx(1500.0)


def test_open_water_needs_no_detour() -> None:
    assert list(detours(circles((2000.0, 900.0, 300.0)), START, GOAL, 1.0)) == []


@pytest.mark.parametrize(("met", "tracks"), [(1, 2), (2, 4), (3, 8)])
def test_every_side_of_every_barrier_in_the_way_is_tried(met: int, tracks: int) -> None:
    places = [(1000.0 + 1500.0 * k, 50.0 * k, 300.0) for k in range(met)]
    ways = list(detours(circles(*places), START, GOAL, 1.0))
    assert len(ways) == tracks
    centres = np.array([s * ALONG + d * LEFT for s, d, _ in places])
    sides = set()
    for track in ways:
        nearest = [track[np.argmin(np.abs((track - c) @ ALONG))] for c in centres]
        sides.add(tuple(bool((p - c) @ LEFT > 0.0) for p, c in zip(nearest, centres, strict=True)))
    assert len(sides) == tracks


def test_detours_of_a_single_circle_are_clear_of_it() -> None:
    barriers = circles((2500.0, 100.0, 400.0))
    for track in detours(barriers, START, GOAL, 1.0):
        assert track_clearance(barriers, np.ascontiguousarray(track)) > 0.0


def test_the_sideways_distance_is_that_to_the_edge() -> None:
    barriers = circles((2500.0, 100.0, 400.0))
    line = np.stack([2500.0 * ALONG, 100.0 * ALONG])
    left = sideways(barriers, line, 5000.0 * LEFT, 1.0)
    assert left[0] * 5000.0 == pytest.approx(501.0, abs=26.0)
    assert left[1] == 0.0


def test_no_way_out_is_told_as_twice_the_vector() -> None:
    barriers = circles((2500.0, 0.0, 50_000.0))
    assert sideways(barriers, np.stack([START]), 5000.0 * LEFT, 1.0) == pytest.approx(2.0)


def test_first_paths_are_the_straight_line_and_descents_from_the_others() -> None:
    barriers = circles((2500.0, 100.0, 400.0))
    region = Region(-1000.0, -1000.0, 4000.0, 5000.0)
    waters = Waters(grid_current(UniformCurrent(0.0, 0.0), region), barriers, 1.0)
    problem = path_problem(waters, START, GOAL)
    guess = np.stack([START, 2500.0 * ALONG - 900.0 * LEFT, GOAL])
    raw, polished = (first_controls(problem, [guess], 0.02, steps) for steps in (0, 10))
    assert np.array_equal(polished[0], problem.straight)
    for before, after in zip(raw, polished, strict=True):
        time, violation = path_cost(problem, after)
        assert time + 0.02 * violation <= sum(np.multiply(path_cost(problem, before), (1.0, 0.02)))
        assert after[[0, -1]].tolist() == [START.tolist(), GOAL.tolist()]


def test_a_track_is_joined_to_the_ends_exactly() -> None:
    track = np.array([[1e-9, 0.0], [5.0, 6.0], [3000.1, 4000.0]])
    assert joined(track, START, GOAL).tolist() == [[0.0, 0.0], [5.0, 6.0], [3000.0, 4000.0]]
