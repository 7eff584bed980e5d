"""What a vehicle did on a voyage, and the clearance that it kept by its own track."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance, leg_clearance

__all__ = ["Outcome", "SailedTrack", "least_clearance"]

Floats = NDArray[np.float64]


class Outcome(IntEnum):
    """How a voyage ended."""

    ARRIVED = 0
    """At the last waypoint."""
    SWEPT = 1
    """Given up: the current was too strong."""
    BLOCKED = 2
    """Given up, or stopped short of obstacles: no way past them was found."""
    COLLIDED = 3
    """Into a barrier."""
    LATE = 4
    """Out of time."""


@dataclass(frozen=True, slots=True, eq=False)
class SailedTrack:
    """What a vehicle did.

    Parameters
    ----------
    outcome
        How it ended.
    times
        In seconds, shape (k,), equally spaced.
    positions
        In metres, shape (k, 2).
    headings
        In radians anticlockwise from east, not wrapped, shape (k,).
    cross_track
        Distance in metres to port of the leg that was sailed, shape (k,).
    manoeuvre
        Number of the avoidance manoeuvre under way, counted from 1, or 0, shape (k,).
    arrivals
        When each waypoint was reached, in seconds; infinite if it was not.
    least_clearance
        Of the straight pieces between the positions, in metres.
    """

    outcome: Outcome
    times: Floats
    positions: Floats
    headings: Floats
    cross_track: Floats
    manoeuvre: NDArray[np.int64]
    arrivals: Floats
    least_clearance: float

    @property
    def duration(self) -> float:
        """Seconds from the first position to the last."""
        return float(self.times[-1] - self.times[0])

    @property
    def manoeuvres(self) -> int:
        """Number of avoidance manoeuvres."""
        return int(self.manoeuvre.max())

    @property
    def manoeuvring(self) -> float:
        """Seconds spent in avoidance manoeuvres."""
        return float(np.diff(self.times)[self.manoeuvre[:-1] > 0].sum())


@kernel
def least_clearance(barriers: Barriers, positions: Floats) -> float:
    """Least clearance in metres of the straight pieces between positions, shape (k, 2).

    A piece is left out only where the clearance that was last computed, less the way since, shows
    that it cannot be the least.
    """
    x, y = positions[0]
    known = least = clearance(barriers, x, y)
    for k in range(1, len(positions)):
        x0, y0, x, y = x, y, positions[k, 0], positions[k, 1]
        known -= math.hypot(x - x0, y - y0)
        if known <= least:
            least = min(least, leg_clearance(barriers, x0, y0, x, y))
            known = clearance(barriers, x, y)
    return least
