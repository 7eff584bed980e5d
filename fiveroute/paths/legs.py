"""Straight legs in a current: how fast an AUV makes good along one, and how long it takes.

The AUV moves at a constant speed V through water that itself moves at c = (u, v). To keep to
a track in the direction of the unit vector e it heads into the current by the crab angle, so that
the sideways components cancel; what is left along the track is the ground speed, equation (11),

    g = c.e + sqrt(V^2 - (c x e)^2),

if |c x e| < V and g > 0. Otherwise the leg cannot be sailed in this direction. The time along a
path is the integral of ds / g, equation (22), here by Gauss and Legendre's rule with three points
on every piece as long as a cell of the current's grid, or as what the AUV sails through the water
between two times of it. Within a piece it meets the current at the times that its ground speed at
the end of the last piece suggests.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, leg_clearance
from fiveroute.ocean.current_grid import CurrentGrid, velocity

__all__ = ["ground_speed", "leg_time", "track_clearance", "track_time"]

Floats = NDArray[np.float64]

_STANDSTILL = 1e-3  # ground speed in metres per second that counts as none
_NODE = 0.5 * math.sqrt(0.6)  # of the three-point rule, from the middle of a piece


@kernel
def ground_speed(u: float, v: float, east: float, north: float, speed: float) -> float:
    """Ground speed g along the unit vector (east, north), (11); 0 where it cannot be sailed."""
    along, across = u * east + v * north, v * east - u * north
    if abs(across) >= speed:
        return 0.0
    made_good = along + math.sqrt(speed * speed - across * across)
    return made_good if made_good > _STANDSTILL else 0.0


@kernel
def leg_time(
    grid: CurrentGrid, x0: float, y0: float, x1: float, y1: float, t: float, speed: float
) -> float:
    """Time in seconds for a straight leg begun at time t; infinite where it cannot be sailed."""
    length = math.hypot(x1 - x0, y1 - y0)
    if length == 0.0:
        return 0.0
    east, north = (x1 - x0) / length, (y1 - y0) / length
    made_good, longest = speed, grid.step
    if grid.uv.shape[0] > 1:
        u, v = velocity(grid, x0, y0, t)
        made_good = ground_speed(u, v, east, north, speed)
        if made_good == 0.0:
            return math.inf
        longest = min(longest, speed * grid.every)
    pieces = max(math.ceil(length / longest - 1e-9), 1)
    piece, elapsed = length / pieces, 0.0
    for k in range(pieces):
        begun, pace = t + elapsed, piece / made_good
        for node, weight in ((0.5 - _NODE, 5.0), (0.5, 8.0), (0.5 + _NODE, 5.0)):
            s = (k + node) * piece
            u, v = velocity(grid, x0 + s * east, y0 + s * north, begun + node * pace)
            made_good = ground_speed(u, v, east, north, speed)
            if made_good == 0.0:
                return math.inf
            elapsed += weight / 18.0 * piece / made_good
    return elapsed


@kernel
def track_time(grid: CurrentGrid, track: Floats, t: float, speed: float) -> float:
    """Time in seconds along straight legs between points, shape (k, 2), begun at time t."""
    elapsed = 0.0
    for k in range(len(track) - 1):
        x0, y0, x1, y1 = track[k, 0], track[k, 1], track[k + 1, 0], track[k + 1, 1]
        elapsed += leg_time(grid, x0, y0, x1, y1, t + elapsed, speed)
    return elapsed


@kernel
def track_clearance(barriers: Barriers, track: Floats) -> float:
    """Least clearance along straight legs between points, shape (k, 2), in metres."""
    least = math.inf
    for k in range(len(track) - 1):
        x0, y0, x1, y1 = track[k, 0], track[k, 1], track[k + 1, 0], track[k + 1, 1]
        least = min(least, leg_clearance(barriers, x0, y0, x1, y1))
    return least
