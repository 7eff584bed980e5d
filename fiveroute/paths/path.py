"""What a path planner hands back: a track, and what is true of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from fiveroute.paths.legs import track_clearance, track_time
from fiveroute.paths.waters import Waters

__all__ = ["Path", "PathStatus", "track_curvature", "track_path"]

Floats = NDArray[np.float64]


class PathStatus(Enum):
    """How a search for a path ended; the value is what to tell a user."""

    FOUND = "found"
    AGAINST_CURRENT = "cannot be reached against the current"
    BLOCKED = "cannot be reached round the obstacles"
    TOO_TIGHT = "cannot be reached with so wide a turning radius"


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A track through the water.

    Parameters
    ----------
    waypoints
        Positions in metres, joined by straight legs, both ends included, shape (k, 2);
        none, shape (0, 2), where no path was found.
    duration
        Seconds along the waypoints; infinite where no path was found.
    min_clearance
        Least clearance along the waypoints in metres.
    max_curvature
        Largest curvature in 1/m.
    status
        Whether there is a path, or what stood in its way.
    """

    waypoints: Floats = field(default_factory=lambda: np.zeros((0, 2)))
    duration: float = math.inf
    min_clearance: float = -math.inf
    max_curvature: float = 0.0
    status: PathStatus = PathStatus.FOUND

    @property
    def is_found(self) -> bool:
        """Whether there is a path at all."""
        return self.status is PathStatus.FOUND


def track_path(waters: Waters, track: Floats, begin: float, curvature: float | None = None) -> Path:
    """The path along a track, or why the track is none.

    Parameters
    ----------
    waters
        Ocean and vehicle.
    track
        Waypoints in metres, shape (k, 2), taken as they are.
    begin
        Time of departure in seconds.
    curvature
        Largest curvature of the curve behind the track in 1/m; None takes the track's own.
    """
    turn = track_curvature(track) if curvature is None else curvature
    clear = track_clearance(waters.barriers, track)
    duration = track_time(waters.grid, track, begin, waters.speed)
    if not clear > 0.0:
        return Path(status=PathStatus.BLOCKED)
    if not math.isfinite(duration):
        return Path(status=PathStatus.AGAINST_CURRENT)
    if turn * waters.turning_radius > 1.0:
        return Path(status=PathStatus.TOO_TIGHT)
    return Path(track, duration, clear, turn)


def track_curvature(track: Floats) -> float:
    """Largest curvature of a track in 1/m: the turn at a waypoint over the legs' mean length."""
    legs = np.diff(track, axis=0)
    length = np.hypot(*legs.T)
    legs, length = legs[length > 0.0], length[length > 0.0]
    if len(legs) < 2:
        return 0.0
    cross = legs[:-1, 0] * legs[1:, 1] - legs[:-1, 1] * legs[1:, 0]
    turn = np.abs(np.arctan2(cross, (legs[:-1] * legs[1:]).sum(axis=1)))
    return float((2.0 * turn / (length[:-1] + length[1:])).max())
