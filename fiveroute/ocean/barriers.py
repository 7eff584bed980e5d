"""Where an AUV must not be: round obstacles, polygons, land from a mask, the edge of the data.

All are told to kernels as one signed distance, the clearance: metres to the nearest barrier,
negative inside. Circles and polygons are exact (a polygon's inside is found by crossing numbers,
and of a coast of many corners only the parts are looked at that are near); a land mask becomes a
grid of distances that is interpolated. A safety margin is taken off the
clearance, so that a path of clearance zero or more keeps it.

The signed distance of a union is the least of its parts' outside of all of them, and inside
at most that; its size grows no faster than the distance travelled, so that a clearance of
c metres frees all points within c.
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.current_grid import Region

__all__ = ["Barriers", "boxed", "clearance", "distance_to_leg", "leg_clearance", "no_barriers"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_CONTACT = 1e-6  # metres to a polygon that count as contact, whatever the rounding
_RUN = 32  # edges of a polygon that share a box


class Barriers(NamedTuple):
    """Barriers as kernels need them.

    Parameters
    ----------
    circles
        Centre and radius in metres, shape (c, 3).
    corners
        Corners of all polygons, one polygon after the other, in metres, shape (k, 2).
    first
        Where each polygon's corners begin, and k at the end, shape (p + 1,).
    boxes
        West, south, east and north of every run of `_RUN` edges, polygon by polygon, shape (b, 4),
        see `boxed`; shape (0, 4) has all edges looked at.
    land
        Signed distance to the land of a mask in metres at the points of a regular grid, rows to
        the north and columns to the east; shape (0, 0) where there is none.
    land_west, land_south, land_step
        Position of that grid's first column and row, and its spacing, in metres.
    west, south, east, north
        The rectangle that paths must not leave; infinite where they may.
    margin
        Safety margin in metres.
    """

    circles: Floats
    corners: Floats
    first: Integers
    boxes: Floats
    land: Floats
    land_west: float
    land_south: float
    land_step: float
    west: float
    south: float
    east: float
    north: float
    margin: float

    @property
    def is_open(self) -> bool:
        """Whether there is no barrier at all but the rectangle."""
        return not (len(self.circles) or len(self.corners) or self.land.size)


def no_barriers(region: Region | None = None) -> Barriers:
    """Open water, within a rectangle if one is given."""
    return Barriers(
        np.zeros((0, 3)),
        np.zeros((0, 2)),
        np.zeros(1, dtype=np.int64),
        np.zeros((0, 4)),
        np.zeros((0, 0)),
        0.0,
        0.0,
        1.0,
        *(region or (-math.inf, -math.inf, math.inf, math.inf)),
        0.0,
    )


def boxed(barriers: Barriers) -> Barriers:
    """The same barriers with boxes around the runs of their polygons' edges."""
    boxes = []
    for first, last in itertools.pairwise(barriers.first.tolist()):
        ring = barriers.corners[first:last]
        ring = np.concatenate([ring[-1:], ring])
        for begin in range(0, last - first, _RUN):
            run = ring[begin : begin + _RUN + 1]
            boxes.append((*run.min(axis=0), *run.max(axis=0)))
    return barriers._replace(boxes=np.array(boxes, dtype=np.float64).reshape(-1, 4))


@kernel
def clearance(barriers: Barriers, x: float, y: float) -> float:
    """Signed distance to the nearest barrier, less the margin, in metres."""
    return leg_clearance(barriers, x, y, x, y)


@kernel
def leg_clearance(barriers: Barriers, x0: float, y0: float, x1: float, y1: float) -> float:
    """Least clearance along a straight leg in metres, exact where it is positive.

    A leg that touches a polygon or goes through it has a negative clearance, whatever the margin.
    Against the land of a mask it is taken at points a quarter of the mask's spacing apart.
    """
    least = min(
        min(x0, x1) - barriers.west,
        barriers.east - max(x0, x1),
        min(y0, y1) - barriers.south,
        barriers.north - max(y0, y1),
    )
    for k in range(len(barriers.circles)):
        x, y, radius = barriers.circles[k]
        least = min(least, distance_to_leg(x, y, x0, y0, x1, y1) - radius - barriers.margin)
    box = 0
    for k in range(len(barriers.first) - 1):
        spare = _polygon_clearance(barriers, k, box, x0, y0, x1, y1)
        least = min(least, spare - barriers.margin)
        box += _runs(barriers.first[k + 1] - barriers.first[k])
    if barriers.land.size:
        least = min(least, _land_clearance(barriers, x0, y0, x1, y1) - barriers.margin)
    return least


@kernel
def _polygon_clearance(
    barriers: Barriers, k: int, box: int, x0: float, y0: float, x1: float, y1: float
) -> float:
    """Distance of a leg to a polygon; negative, if only just, where it touches or is inside.

    Of the runs of edges, whose boxes begin at `box`, those alone are looked at that may be nearer
    than the nearest so far; the run with the nearest box comes first.
    """
    first, last = barriers.first[k], barriers.first[k + 1]
    corners, boxes = barriers.corners, barriers.boxes
    runs = _runs(last - first)
    least, inside, nearest = math.inf, False, -1
    if runs > 1 and len(boxes):
        for run in range(runs):
            away = _distance_to_box(boxes, box + run, x0, y0, x1, y1)
            if away < least:
                least, nearest = away, run
        least = _distance_to_run(corners, first, last, nearest, x0, y0, x1, y1)
    for run in range(runs):
        away = _distance_to_box(boxes, box + run, x0, y0, x1, y1)
        if run != nearest and away <= least + _CONTACT:
            least = min(least, _distance_to_run(corners, first, last, run, x0, y0, x1, y1))
        if _crosses_run(corners, boxes, first, last, run, box + run, x0, y0):
            inside = not inside
    return -max(least, _CONTACT) if inside or least < _CONTACT else least


@kernel
def _runs(edges: int) -> int:
    """Number of runs of edges of a polygon."""
    runs: int = (edges + _RUN - 1) // _RUN
    return runs


@kernel
def _distance_to_box(boxes: Floats, box: int, x0: float, y0: float, x1: float, y1: float) -> float:
    """At most the distance of a leg to what is in a box; 0 where there are no boxes."""
    if len(boxes) == 0:
        return 0.0
    across = max(boxes[box, 0] - max(x0, x1), min(x0, x1) - boxes[box, 2], 0.0)
    up = max(boxes[box, 1] - max(y0, y1), min(y0, y1) - boxes[box, 3], 0.0)
    return math.sqrt(across * across + up * up)


@kernel
def _distance_to_run(
    corners: Floats, first: int, last: int, run: int, x0: float, y0: float, x1: float, y1: float
) -> float:
    """Distance of a leg to the edges of a run."""
    begin = first + run * _RUN
    xa, ya = corners[begin - 1 if run > 0 else last - 1]
    least = math.inf
    for corner in range(begin, min(begin + _RUN, last)):
        xb, yb = corners[corner]
        least = min(least, _distance_of_legs(xa, ya, xb, yb, x0, y0, x1, y1))
        xa, ya = xb, yb
    return least


@kernel
def _crosses_run(
    corners: Floats, boxes: Floats, first: int, last: int, run: int, box: int, x: float, y: float
) -> bool:
    """Whether a ray from a point to the east crosses the edges of a run an odd number of times."""
    if len(boxes) and (x > boxes[box, 2] or y < boxes[box, 1] or y > boxes[box, 3]):
        return False
    begin = first + run * _RUN
    end = min(begin + _RUN, last)
    xa, ya = corners[begin - 1 if run > 0 else last - 1]
    if len(boxes) and x < boxes[box, 0]:  # all crossings lie ahead, so that the ends tell
        ahead: bool = (ya > y) != (corners[end - 1, 1] > y)
        return ahead
    odd = False
    for corner in range(begin, end):
        xb, yb = corners[corner]
        if (ya > y) != (yb > y) and x < xa + (xb - xa) * (y - ya) / (yb - ya):
            odd = not odd
        xa, ya = xb, yb
    return odd


@kernel
def _land_clearance(barriers: Barriers, x0: float, y0: float, x1: float, y1: float) -> float:
    parts = max(math.ceil(4.0 * math.hypot(x1 - x0, y1 - y0) / barriers.land_step), 1)
    least = math.inf
    for part in range(parts + 1):
        share = part / parts
        least = min(least, _land_at(barriers, x0 + share * (x1 - x0), y0 + share * (y1 - y0)))
    return least


@kernel
def _land_at(barriers: Barriers, x: float, y: float) -> float:
    """Distance to land by bilinear interpolation; beyond the grid that at its edge."""
    rows, columns = barriers.land.shape
    across = min(max((x - barriers.land_west) / barriers.land_step, 0.0), columns - 1.0)
    up = min(max((y - barriers.land_south) / barriers.land_step, 0.0), rows - 1.0)
    j, i = min(int(across), columns - 2), min(int(up), rows - 2)
    s, r = across - j, up - i
    south = (1.0 - s) * barriers.land[i, j] + s * barriers.land[i, j + 1]
    north = (1.0 - s) * barriers.land[i + 1, j] + s * barriers.land[i + 1, j + 1]
    distance: float = (1.0 - r) * south + r * north
    return distance


@kernel
def distance_to_leg(x: float, y: float, x0: float, y0: float, x1: float, y1: float) -> float:
    """Distance of a point from a leg, which may be a point itself."""
    east, north = x1 - x0, y1 - y0
    squared = east * east + north * north
    share = 0.0
    if squared > 0.0:
        share = min(max(((x - x0) * east + (y - y0) * north) / squared, 0.0), 1.0)
    return math.hypot(x - x0 - share * east, y - y0 - share * north)


@kernel
def _distance_of_legs(
    xa: float, ya: float, xb: float, yb: float, x0: float, y0: float, x1: float, y1: float
) -> float:
    """Distance of two legs, 0 where they cross."""
    side0 = (xb - xa) * (y0 - ya) - (yb - ya) * (x0 - xa)
    side1 = (xb - xa) * (y1 - ya) - (yb - ya) * (x1 - xa)
    side_a = (x1 - x0) * (ya - y0) - (y1 - y0) * (xa - x0)
    side_b = (x1 - x0) * (yb - y0) - (y1 - y0) * (xb - x0)
    if side0 * side1 < 0.0 and side_a * side_b < 0.0:
        return 0.0
    return min(
        distance_to_leg(x0, y0, xa, ya, xb, yb),
        distance_to_leg(x1, y1, xa, ya, xb, yb),
        distance_to_leg(xa, ya, x0, y0, x1, y1),
        distance_to_leg(xb, yb, x0, y0, x1, y1),
    )
