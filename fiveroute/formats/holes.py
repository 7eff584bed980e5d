"""Polygons with holes, cut into polygons without: an island with a lake, an atoll, a ring.

An instance knows no holes, and need not. A line from south to north through the middle of a hole
takes it apart; the fewest lines that meet every hole between its western and its eastern end are
found by going from west to east and drawing one only where the next hole would be missed. What
lies between two lines is a union of polygons without holes.

Each line is a strip: the part to its west reaches to the strip's eastern edge, and the part to its
east to its western edge. The parts so overlap, and no path can slip through a seam between them.
A strip lies where no corner does, so that parts differ within it by their ends alone, and the
union of all parts is the polygon, exactly but for the rounding of their corners on the strips.
"""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Iterator, Sequence

from fiveroute.errors import InputError

__all__ = ["anticlockwise", "without_holes"]

Spot = tuple[float, float]
Ring = Sequence[Spot]


def without_holes(outer: Ring, holes: Sequence[Ring], where: str) -> list[tuple[Spot, ...]]:
    """Polygons whose union is a polygon with holes.

    Parameters
    ----------
    outer
        Its corners in metres, in either sense of rotation; the first is not repeated.
    holes
        Corners of its holes.
    where
        What to call it in an error.

    Returns
    -------
    list
        Corners of the parts, anticlockwise; the corners of `outer` as they are if nothing is cut.

    Raises
    ------
    InputError
        If the holes do not lie in the polygon, apart from one another.
    """
    if not holes:
        return [tuple(outer)]
    rest: list[Ring] = [anticlockwise(outer), *(anticlockwise(hole)[::-1] for hole in holes)]
    parts: list[Ring] = []
    try:
        for west, east in _strips(rest):
            parts += _side(rest, east, west=True)
            rest = _side(rest, west, west=False)
    except _CrossingError:
        raise _out_of_place(where) from None
    parts += rest
    if any(_twice_area(part) <= 0.0 for part in parts):
        raise _out_of_place(where)
    return [tuple(part) for part in parts]


def anticlockwise(corners: Ring) -> tuple[Spot, ...]:
    """The same ring from the same corner, in the sense of rotation of RFC 7946."""
    return (corners[0], *corners[:0:-1]) if _twice_area(corners) < 0.0 else tuple(corners)


class _CrossingError(Exception):
    """Rings that cross one another have no inside."""


def _out_of_place(where: str) -> InputError:
    return InputError(
        "its holes must lie in the zone, apart from it and from one another; draw them again",
        field=where,
    )


def _twice_area(ring: Ring) -> float:
    """Twice the area, negative for a ring that goes clockwise."""
    x0, y0 = ring[0]
    return math.fsum(
        (xa - x0) * (yb - y0) - (ya - y0) * (xb - x0)
        for (xa, ya), (xb, yb) in itertools.pairwise(ring)
    )


def _strips(rings: Sequence[Ring]) -> Iterator[Spot]:
    """Western and eastern edges of strips without a corner; each ring but the first meets one."""
    xs = sorted({x for ring in rings for x, _ in ring})
    ahead = [(max(x for x, _ in ring), min(x for x, _ in ring)) for ring in rings[1:]]
    while ahead:
        east = min(ahead)[0]
        met = [w for _, w in ahead if w < east]
        if not met:
            raise _CrossingError  # a hole without an inside
        inside = xs[bisect.bisect_left(xs, max(met)) : bisect.bisect_right(xs, east)]
        gap, begin = max((b - a, a) for a, b in itertools.pairwise(inside))
        yield begin + gap / 3.0, begin + gap / 1.5
        ahead = [(e, w) for e, w in ahead if w >= east]


def _side(rings: Sequence[Ring], x: float, *, west: bool) -> list[Ring]:
    """The part of a union of rings to the west or the east of a line."""
    whole: list[Ring] = []
    chains: list[Ring] = []
    for ring in rings:
        here = [(corner[0] < x) == west for corner in ring]
        if all(here):
            whole.append(ring)
        elif any(here):
            chains += _chains(ring, here, x)
    return [*whole, *_joined(chains)]


def _chains(ring: Ring, here: Sequence[bool], x: float) -> Iterator[Ring]:
    """The corners of a ring on one side of a line, from where it enters to where it leaves."""
    first = here.index(False)
    chain: list[Spot] = []
    for i in (*range(first + 1, len(ring)), *range(first + 1)):
        if here[i] != here[i - 1]:
            chain.append(_on_line(x, ring[i - 1], ring[i]))
        if here[i]:
            chain.append(ring[i])
        elif here[i - 1]:
            yield chain
            chain = []


def _on_line(x: float, a: Spot, b: Spot) -> Spot:
    """Where an edge meets a line."""
    return x, a[1] + (b[1] - a[1]) * ((x - a[0]) / (b[0] - a[0]))


def _joined(chains: Sequence[Ring]) -> Iterator[Ring]:
    """Rings from chains: along a line, inside and outside take turns."""
    marks = [(chain[0][1], True, k) for k, chain in enumerate(chains)]
    marks = sorted(marks + [(chain[-1][1], False, k) for k, chain in enumerate(chains)])
    after: dict[int, int] = {}
    for (_, enters, k), (_, also_enters, j) in zip(marks[::2], marks[1::2], strict=True):
        if enters == also_enters:
            raise _CrossingError
        after |= {j: k} if enters else {k: j}
    while after:
        last, following = after.popitem()
        ring = [*chains[last]]
        while following != last:
            ring += chains[following]
            following = after.pop(following)
        yield ring
