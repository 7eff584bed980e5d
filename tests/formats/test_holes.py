"""Polygons with holes: their parts cover them, no less and no more, and leave no seam."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.formats.holes import anticlockwise, without_holes
from fiveroute.instance import Ocean, Polygon
from fiveroute.ocean.barriers import leg_clearance
from fiveroute.ocean.obstacles import barriers_of
from fiveroute.ocean.simple_polygon import first_conflict

SQUARE = ((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0))
LAKE = ((3.0, 3.0), (3.0, 5.0), (6.0, 5.0), (6.0, 3.0))


def star(rng: np.random.Generator, middle: Any, reach: float) -> Any:
    """A rugged polygon around a point, its corners in millimetres."""
    angles = np.sort(rng.uniform(0.0, 2.0 * np.pi, rng.integers(5, 40)))
    radii = reach * rng.uniform(0.3, 1.0, len(angles))
    ring = middle + np.column_stack((radii * np.cos(angles), radii * np.sin(angles)))
    return shapely.make_valid(shapely.Polygon(ring.round(3)))


def corners(ring: Any) -> list[tuple[float, float]]:
    return [(x, y) for x, y in ring.coords][:-1]


def lands(seed: int) -> list[Any]:
    """Polygons with holes that do not touch."""
    rng = np.random.default_rng(seed)
    lakes = [star(rng, rng.uniform(-60.0, 60.0, 2), rng.uniform(3, 40)) for _ in range(9)]
    land = shapely.difference(star(rng, (0.0, 0.0), 120.0), shapely.union_all(lakes))
    land = shapely.set_precision(land, 1e-3)
    return [part for part in getattr(land, "geoms", [land]) if part.geom_type == "Polygon"]


@settings(deadline=None, max_examples=80)
@given(seed=st.integers(0, 2**32))
def test_the_parts_are_the_polygon(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for land in lands(seed):
        outer, *holes = map(corners, (land.exterior, *land.interiors))
        parts = [shapely.Polygon(part) for part in without_holes(outer, holes, "land")]
        union = shapely.union_all(parts)
        assert not any(part.interiors for part in parts)
        assert union.area == pytest.approx(land.area, rel=1e-12)
        assert union.symmetric_difference(land).area < 1e-9 * land.area
        points: Any = shapely.points(rng.uniform(-120.0, 120.0, (200, 2)))
        points = points[shapely.distance(land.boundary, points) > 1e-9]
        covered = [shapely.covers(part, points) for part in parts]
        assert (np.any(covered, axis=0) == shapely.covers(land, points)).all()
        # the parts overlap in strips, so that what is inside is properly inside of one of them
        inside = [shapely.contains_properly(part, points) for part in parts]
        assert (np.any(inside, axis=0) == shapely.contains_properly(land, points)).all()


@settings(deadline=None, max_examples=100)
@given(seed=st.integers(0, 2**32))
def test_rings_that_cross_are_refused_or_their_parts_meet_themselves(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stars = [star(rng, rng.uniform(-90.0, 90.0, 2), rng.uniform(9, 60)) for _ in range(2)]
    land = star(rng, (0.0, 0.0), 120.0)
    if any(shape.geom_type != "Polygon" or shape.interiors for shape in (land, *stars)):
        return
    outer, *holes = (corners(shape.exterior) for shape in (land, *stars))
    try:
        parts = without_holes(outer, holes, "land")
    except InputError:
        assert not shapely.Polygon(outer, holes).is_valid
        return
    if all(first_conflict(np.array(part)) is None for part in parts):
        whole = shapely.Polygon(outer, holes)
        assert whole.is_valid
        assert shapely.union_all(list(map(shapely.Polygon, parts))).area == pytest.approx(
            whole.area
        )


def test_no_leg_slips_through_a_seam() -> None:
    """A seam is a strip in which both parts lie, so that nothing is on the rim of both."""
    parts = without_holes(SQUARE, [LAKE], "land")
    assert len(parts) == 2
    barriers = barriers_of(Ocean(land=tuple(map(Polygon, parts))))
    xs = sorted({x for part in parts for x, _ in part} - {x for x, _ in (*SQUARE, *LAKE)})
    assert len(xs) == 2
    for x in (*xs, sum(xs) / 2.0, 4.5, np.nextafter(xs[0], 9.0)):
        assert leg_clearance(barriers, x, -1.0, x, 4.0) < 0.0
        assert leg_clearance(barriers, x, 2.0, x, 2.5) < 0.0
        assert leg_clearance(barriers, x, 3.5, x, 4.5) > 0.0  # in the lake


def test_one_line_serves_holes_side_by_side() -> None:
    """Lakes above one another are met by one line, an island in a lake by none."""
    above = tuple((x + 1.0, y + 3.0) for x, y in LAKE)
    assert len(without_holes(SQUARE, [LAKE, above], "land")) == 2
    assert without_holes(SQUARE[::-1], [], "land") == [SQUARE[::-1]]


@pytest.mark.parametrize(
    "hole",
    [
        tuple((x + 20.0, y) for x, y in LAKE),
        tuple((3.0 * x - 9.0, 9.0 * y) for x, y in LAKE),
        SQUARE,
        ((2.0, 2.0), (2.0, 3.0), (2.0, 4.0)),
    ],
)
def test_holes_out_of_place_are_refused(hole: tuple[tuple[float, float], ...]) -> None:
    with pytest.raises(InputError, match=r"features\[0\]: its holes must lie in the zone"):
        without_holes(SQUARE, [LAKE, hole] if hole != SQUARE else [hole], "features[0]")


def test_rings_are_turned() -> None:
    assert anticlockwise(SQUARE) == SQUARE
    assert anticlockwise(SQUARE[::-1]) == (SQUARE[3], *SQUARE[:3])
