"""The clearance of a track, against that of all its pieces; what a voyage tells of itself."""

import numpy as np
import pytest

from fiveroute.ocean.barriers import Barriers, leg_clearance, no_barriers
from fiveroute.vehicle.sailed_track import Outcome, SailedTrack, least_clearance


def test_the_least_clearance_is_that_of_all_pieces() -> None:
    rng = np.random.default_rng(5)
    circles = np.column_stack([rng.uniform(-50.0, 50.0, (9, 2)), rng.uniform(1.0, 9.0, 9)])
    waters: Barriers = no_barriers()._replace(circles=circles)
    for _ in range(20):
        walk = np.cumsum(rng.normal(0.0, 3.0, (300, 2)), axis=0)
        pieces = [leg_clearance(waters, *walk[k], *walk[k + 1]) for k in range(299)]
        least = least_clearance(waters, walk)
        assert least == pytest.approx(min(pieces), abs=1e-9) or max(least, min(pieces)) < 0.0


def test_it_counts_manoeuvres_and_their_time() -> None:
    manoeuvre = np.array([0, 1, 1, 0, 0, 2, 0])
    times, zeros = np.linspace(10.0, 13.0, 7), np.zeros(7)
    sailed = SailedTrack(
        Outcome.ARRIVED, times, np.zeros((7, 2)), zeros, zeros, manoeuvre, zeros, 1.0
    )
    assert sailed.duration == 3.0
    assert (sailed.manoeuvres, sailed.manoeuvring) == (2, 1.5)
