"""A route as kernels have it: its stops in an array, from where it begins to the destination.

The array has room for more stops than there are; how many count is told beside it. Stops come and
go in place.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["Ints", "Stops", "insert_stop", "remove_stops"]

Ints = NDArray[np.int64]

Stops = Ints
"""Vertices in the order of a route, room to spare behind them."""


@kernel
def insert_stop(stops: Stops, length: int, at: int, node: int) -> int:
    """Insert a node before the stop at a position, in place; returns the new length."""
    for k in range(length, at, -1):
        stops[k] = stops[k - 1]
    stops[at] = node
    return length + 1


@kernel
def remove_stops(stops: Stops, length: int, at: int, count: int) -> int:
    """Remove `count` stops from a position on, in place; returns the new length."""
    for k in range(at, length - count):
        stops[k] = stops[k + count]
    return length - count
