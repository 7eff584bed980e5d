"""Where a vehicle is on a track, and how much of it is behind it.

A leg is left for the next one shortly before the vehicle is abeam of its waypoint; of the last
leg the vehicle closes in on the end itself once it is abeam of it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.vehicle.dynamics import State

__all__ = ["Headway", "Place", "Waypoints", "made_good"]

Floats = NDArray[np.float64]

_PROGRESS = 1.0  # metres that count as progress


class Waypoints(NamedTuple):
    """A track as kernels need it.

    Parameters
    ----------
    track
        Waypoints in metres, shape (k, 2).
    left
        Metres from each waypoint to the end, shape (k,).
    switch
        Metres before a waypoint at which the next leg begins.
    """

    track: Floats
    left: Floats
    switch: float

    @classmethod
    def of(cls, track: Floats, switch: float) -> Waypoints:
        """A track, and how far it is from each of its waypoints to its end."""
        pieces = np.hypot(*np.diff(track, axis=0).T)
        return cls(track, np.append(np.cumsum(pieces[::-1])[::-1], 0.0), float(switch))


class Headway(NamedTuple):
    """What of a track is behind the vehicle.

    Parameters
    ----------
    leg
        The leg that it sails, counted from 0.
    homing
        Whether it closes in on the last waypoint.
    best, progressed
        Metres left when it last progressed, and when that was, in seconds.
    """

    leg: int
    homing: bool
    best: float
    progressed: float


class Place(NamedTuple):
    """Where a vehicle is on a leg.

    Parameters
    ----------
    bearing
        Of the leg, in radians anticlockwise from east.
    error
        Metres to port of it.
    left
        Metres to its end.
    """

    bearing: float
    error: float
    left: float


@kernel
def made_good(
    waypoints: Waypoints, state: State, way: Headway, t: float, arrivals: Floats
) -> tuple[Headway, Place]:
    """What is behind the vehicle now, and where it is; fill in arrivals at waypoints."""
    leg = _next_leg(waypoints, state, way.leg, t, arrivals)
    place, homing, best = _place(waypoints, leg, state), way.homing, way.best
    if place.left <= 0.0 and not homing:
        homing, best = True, math.inf
    if homing:
        place = _homeward(waypoints, state)
    left = place.left + waypoints.left[leg + 1]
    if left < best - _PROGRESS:
        return Headway(leg, homing, left, t), place
    return Headway(leg, homing, best, way.progressed), place


@kernel
def _next_leg(waypoints: Waypoints, state: State, leg: int, t: float, arrivals: Floats) -> int:
    """The leg to sail, once the waypoints that have been reached are left behind."""
    while leg < len(waypoints.track) - 2 and _place(waypoints, leg, state).left <= waypoints.switch:
        leg += 1
        arrivals[leg] = t
    return leg


@kernel
def _place(waypoints: Waypoints, leg: int, state: State) -> Place:
    """Abeam of what point of a leg, and how far to port of it."""
    x0, y0 = waypoints.track[leg]
    x1, y1 = waypoints.track[leg + 1]
    length = waypoints.left[leg] - waypoints.left[leg + 1]
    if length == 0.0:
        return Place(state.heading, 0.0, 0.0)
    east, north = (x1 - x0) / length, (y1 - y0) / length
    return Place(
        math.atan2(north, east),
        (state.y - y0) * east - (state.x - x0) * north,
        (x1 - state.x) * east + (y1 - state.y) * north,
    )


@kernel
def _homeward(waypoints: Waypoints, state: State) -> Place:
    """Straight to the last waypoint."""
    x, y = waypoints.track[-1]
    east, north = x - state.x, y - state.y
    return Place(math.atan2(north, east), 0.0, math.hypot(east, north))
