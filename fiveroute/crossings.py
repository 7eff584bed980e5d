"""How much of a track lies within circles and polygons: exact, for the judge of paths.

Along a straight leg p + w d, 0 <= w <= 1, a circle covers the interval between the roots of
|p + w d - c|^2 = r^2. A polygon covers some of the intervals between the crossings of its edges;
which ones, the crossing number of their midpoints tells. What several shapes cover together is the
union of the intervals, so that nothing counts twice.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from fiveroute.instance import Circle, Polygon

__all__ = ["metres_within"]

Floats = NDArray[np.float64]
Interval = tuple[float, float]


def metres_within(track: Floats, shapes: Sequence[Circle | Polygon]) -> float:
    """Length of a track inside the union of some shapes, in metres.

    Parameters
    ----------
    track
        Waypoints in metres, shape (k, 2).
    shapes
        Circles and polygons; their rims do not count.
    """
    total = 0.0
    for begin, end in itertools.pairwise(track):
        covered = [part for shape in shapes for part in _within(begin, end - begin, shape)]
        total += _measure(covered) * math.hypot(*(end - begin))
    return total


def _within(begin: Floats, step: Floats, shape: Circle | Polygon) -> Iterator[Interval]:
    """Shares of a leg inside a shape."""
    if isinstance(shape, Circle):
        return _within_circle(begin, step, shape)
    return _within_polygon(begin, step, np.array(shape.polygon, dtype=np.float64))


def _within_circle(begin: Floats, step: Floats, circle: Circle) -> Iterator[Interval]:
    """Shares of a leg inside a circle."""
    away = begin - (circle.x, circle.y)
    a, b = float(step @ step), float(step @ away)
    rest = b * b - a * (float(away @ away) - circle.radius**2)
    if a > 0.0 and rest > 0.0:
        root = math.sqrt(rest)
        first, last = max((-b - root) / a, 0.0), min((-b + root) / a, 1.0)
        if first < last:
            yield first, last


def _within_polygon(begin: Floats, step: Floats, polygon: Floats) -> Iterator[Interval]:
    """Shares of a leg inside a polygon."""
    low, high = np.minimum(begin, begin + step), np.maximum(begin, begin + step)
    if (polygon.max(axis=0) < low).any() or (polygon.min(axis=0) > high).any():
        return
    edges = np.roll(polygon, -1, axis=0) - polygon
    away = polygon - begin
    cross = step[0] * edges[:, 1] - step[1] * edges[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        along = (away[:, 0] * edges[:, 1] - away[:, 1] * edges[:, 0]) / cross
        across = (away[:, 0] * step[1] - away[:, 1] * step[0]) / cross
    met = (cross != 0.0) & (across >= 0.0) & (across <= 1.0) & (along > 0.0) & (along < 1.0)
    shares = np.concatenate([[0.0], np.sort(along[met]), [1.0]])
    for first, last in itertools.pairwise(shares):
        if last > first and _contains(polygon, edges, begin + 0.5 * (first + last) * step):
            yield float(first), float(last)


def _contains(polygon: Floats, edges: Floats, point: Floats) -> bool:
    """Whether a ray from a point to the east crosses the polygon an odd number of times."""
    above = polygon[:, 1] > point[1]
    spans = above != np.roll(above, -1)
    x = polygon[spans, 0] + (point[1] - polygon[spans, 1]) * edges[spans, 0] / edges[spans, 1]
    return bool(np.count_nonzero(x > point[0]) % 2)


def _measure(intervals: Iterable[Interval]) -> float:
    """Length of a union of intervals."""
    total, reached = 0.0, 0.0
    for first, last in sorted(intervals):
        total += max(last - max(first, reached), 0.0)
        reached = max(reached, last)
    return total
