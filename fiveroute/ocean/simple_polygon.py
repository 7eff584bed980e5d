"""Whether the edges of a polygon keep apart: only then is it clear what lies inside it.

Edges are compared by the signs of the areas that their ends span. Most pairs are never looked
at: sorted by their western ends, an edge can only meet those that begin before it ends.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["first_conflict"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_PAIRS = 1_000_000
"""Pairs of edges that are compared at a time."""


def first_conflict(corners: Floats) -> tuple[float, float] | None:
    """A corner of an edge that meets another; None where all edges keep apart.

    Neighbouring edges share a corner, and may share no more.

    Parameters
    ----------
    corners
        Corners in order, shape (n, 2); one that is repeated counts once.
    """
    first = _at(corners, 0)
    corners = corners[(corners != np.roll(corners, -1, axis=0)).any(axis=1)]
    if len(corners) < 3:
        return first
    ends = np.roll(corners, -1, axis=0)
    order = np.argsort(np.minimum(corners[:, 0], ends[:, 0]), kind="stable")
    west = np.minimum(corners[:, 0], ends[:, 0])[order]
    east = np.maximum(corners[:, 0], ends[:, 0])[order]
    later = np.searchsorted(west, east, side="right") - np.arange(len(order)) - 1
    begin = 0
    while begin < len(order):  # so many edges at a time that memory stays bounded
        behind = np.cumsum(later[begin + 1 :])
        upto = begin + 1 + int(np.searchsorted(behind, _PAIRS, side="right"))
        counts = later[begin:upto]
        here = np.repeat(np.arange(begin, upto), counts)
        offset = np.arange(len(here)) - np.repeat(np.cumsum(counts) - counts, counts)
        one, other = order[here], order[here + 1 + offset]
        meeting = np.flatnonzero(_meet(corners, ends, one, other))
        if len(meeting):
            return _at(corners, int(min(one[meeting[0]], other[meeting[0]])))
        begin = upto
    return None


def _meet(corners: Floats, ends: Floats, one: Ints, other: Ints) -> Bools:
    """Whether pairs of edges have a point in common, apart from the corner of neighbours."""
    a, b, c, d = corners[one], ends[one], corners[other], ends[other]
    c_side, d_side = _side(a, b, c), _side(a, b, d)
    a_side, b_side = _side(c, d, a), _side(c, d, b)
    crossing = (c_side * d_side < 0) & (a_side * b_side < 0)
    touching = (
        (c_side == 0) & _between(a, b, c)
        | (d_side == 0) & _between(a, b, d)
        | (a_side == 0) & _between(c, d, a)
        | (b_side == 0) & _between(c, d, b)
    )
    n = len(corners)
    follows, precedes = (one + 1) % n == other, (other + 1) % n == one
    # Neighbours touch at their corner; they overlap where one turns straight back on the other.
    back = follows & (d_side == 0) & (_inner(a - b, d - b) > 0)
    back |= precedes & (c_side == 0) & (_inner(c - a, b - a) > 0)
    meeting: Bools = np.where(follows | precedes, back, crossing | touching)
    return meeting


def _side(a: Floats, b: Floats, p: Floats) -> Floats:
    """Sign of the area of triangles (a, b, p): 1 to the left of a to b, 0 on the line."""
    u, v = b - a, p - a
    signs: Floats = np.sign(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    return signs


def _between(a: Floats, b: Floats, p: Floats) -> Bools:
    """Whether points on the lines through a and b lie between them."""
    inside = (np.minimum(a, b) <= p) & (p <= np.maximum(a, b))
    return np.logical_and(inside[:, 0], inside[:, 1])


def _inner(u: Floats, v: Floats) -> Floats:
    product: Floats = u[:, 0] * v[:, 0] + u[:, 1] * v[:, 1]
    return product


def _at(corners: Floats, k: int) -> tuple[float, float]:
    return float(corners[k, 0]), float(corners[k, 1])
