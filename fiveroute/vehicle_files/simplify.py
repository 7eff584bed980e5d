"""Fewer waypoints for the same path.

The path keeps its ends, and wherever a straight line would leave it by more than a tolerance
the point that is farthest from the line is kept too, again and again.

References
----------
D. H. Douglas and T. K. Peucker, "Algorithms for the reduction of the number of points required
to represent a digitized line or its caricature", Cartographica 10 (1973),
doi 10.3138/FM57-6770-U75U-7727.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["simplified"]

Floats = NDArray[np.float64]


def simplified(track: Floats, tolerance: float) -> Floats:
    """The waypoints of a path that keep all others within a distance.

    Parameters
    ----------
    track
        Waypoints in metres, shape (k, 2), k at least 2.
    tolerance
        Most metres between any waypoint left out and the straight line that takes its place.
    """
    kept = np.zeros(len(track), dtype=np.bool_)
    kept[[0, -1]] = True
    spans = [(0, len(track) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        away = _distances(track[first + 1 : last], track[first], track[last])
        farthest = int(away.argmax())
        if away[farthest] > tolerance:
            middle = first + 1 + farthest
            kept[middle] = True
            spans += [(first, middle), (middle, last)]
    return track[kept]


def _distances(points: Floats, begin: Floats, end: Floats) -> Floats:
    """Distances of points from a straight line between two others."""
    line = end - begin
    squared = float(line @ line)
    share = np.zeros(len(points))
    if squared > 0.0:
        share = np.clip((points - begin) @ line / squared, 0.0, 1.0)
    away: Floats = np.hypot(*(points - begin - share[:, None] * line).T)
    return away
