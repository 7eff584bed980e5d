"""Tracks with fewer waypoints, by the algorithm of Douglas and Peucker (1973).

The waypoint that lies farthest off the chord of a stretch is kept, and the stretch divided there,
until none lies farther off than is allowed, and no chord leads where it must not.
DOI 10.3138/FM57-6770-U75U-7727.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["thinned"]

Floats = NDArray[np.float64]


def thinned(
    track: Floats, off: float, is_clear: Callable[[Floats, Floats], bool] | None = None
) -> Floats:
    """Waypoints of a track that keep it within so many metres of where it was, shape (m, 2).

    Parameters
    ----------
    track
        Waypoints in metres, shape (k, 2).
    off
        Metres by which a waypoint that is left out may lie off the track.
    is_clear
        Whether a chord, shape (2, 2), may take the place of a stretch of the track, shape (any, 2);
        None lets all.
    """
    kept = np.zeros(len(track), dtype=np.bool_)
    kept[[0, -1]] = True
    stretches = [(0, len(track) - 1)]
    while stretches:
        first, last = stretches.pop()
        if last - first < 2:
            continue
        distances = _distances(track[first + 1 : last], track[first], track[last])
        farthest = int(np.argmax(distances))
        chord, stretch = track[[first, last]], track[first : last + 1]
        if distances[farthest] > off or not (is_clear is None or is_clear(chord, stretch)):
            middle = first + 1 + farthest
            kept[middle] = True
            stretches += [(first, middle), (middle, last)]
    return track[kept]


def _distances(points: Floats, begin: Floats, end: Floats) -> Floats:
    """Distances of points from the straight piece between two others, in metres."""
    step = end - begin
    square = float(step @ step)
    share = np.clip((points - begin) @ step / square, 0.0, 1.0) if square > 0.0 else 0.0
    nearest = begin + np.multiply.outer(share, step) if square > 0.0 else begin
    distances: Floats = np.hypot(*(points - nearest).T)
    return distances
