"""A forward-looking sonar: what a vehicle knows of obstacles is what its beams have met.

The beams fan out over the field of view. Each ends at the first circle or edge of a polygon that it
meets within the range, or where it meets the land of a mask, to which it is followed by steps as
long as the distance at hand (sphere tracing, Hart 1996, doi 10.1007/s003710050084). The echoes
are remembered as points on the map, not two of them within a few metres of each other, the
oldest forgotten first. A safety margin around obstacles and the edge of the data are lines on a
map only, and not heard.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance, no_barriers
from fiveroute.vehicle.dynamics import State

__all__ = ["Beams", "Sonar", "land_of", "listen"]

Floats = NDArray[np.float64]

_TOUCH = 0.25  # metres from land that count as land
_APART = 3.0  # metres between two echoes that are remembered, as between two beams at 60 m


class Beams(NamedTuple):
    """A sonar as kernels need it; see `Sonar`."""

    reach: float
    first: float
    between: float
    number: int
    period: float


@dataclass(frozen=True, slots=True)
class Sonar:
    """A forward-looking sonar.

    Parameters
    ----------
    reach
        Its range in metres; 60 m, as the profiling sonar of HoloOcean's torpedo AUV.
    field_of_view
        Angle between its outermost beams in radians; 120 degrees, as there.
    beams
        Number of beams; 41 are three degrees apart.
    period
        Seconds from ping to ping; sound goes 60 m and back in 0.08 s, a vehicle moves two
        metres or so in the two seconds that are chosen to keep missions fast to simulate.
    """

    reach: float = 60.0
    field_of_view: float = math.radians(120.0)
    beams: int = 41
    period: float = 2.0

    def __post_init__(self) -> None:
        for name in ("reach", "period"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise InputError(
                    "must be positive and finite", field=name, value=getattr(self, name)
                )
        if not 0.0 < self.field_of_view <= 2.0 * math.pi:
            raise InputError(
                "must be positive, and a full circle at most, in radians",
                field="field_of_view",
                value=self.field_of_view,
            )
        if self.beams < 2:
            raise InputError("takes two beams at least", field="beams", value=self.beams)

    @property
    def fan(self) -> Beams:
        """The beams in numbers."""
        return Beams(
            float(self.reach),
            -0.5 * self.field_of_view,
            self.field_of_view / (self.beams - 1),
            self.beams,
            float(self.period),
        )


def land_of(barriers: Barriers) -> Barriers:
    """The land of a mask alone, without its margin."""
    return no_barriers()._replace(
        land=barriers.land,
        land_west=barriers.land_west,
        land_south=barriers.land_south,
        land_step=barriers.land_step,
    )


@kernel
def listen(
    beams: Beams, barriers: Barriers, land: Barriers, state: State, echoes: Floats, heard: int
) -> int:
    """Ping once; fill in new echoes, shape (k, 2), and return how many were heard so far.

    The barriers are taken without their land, which is `land`.
    """
    fan = np.empty((beams.number, 3))  # direction, and distance to the first barrier
    for beam in range(beams.number):
        angle = state.heading + beams.first + beam * beams.between
        fan[beam] = math.cos(angle), math.sin(angle), beams.reach
    _hear_circles(barriers, state.x, state.y, beams.reach, fan)
    _hear_polygons(barriers, state.x, state.y, beams.reach, fan)
    for ahead, left, distance in fan:
        if land.land.size:
            distance = _to_land(land, state.x, state.y, ahead, left, distance)
        if distance < beams.reach:
            heard = _remember(echoes, heard, state.x + distance * ahead, state.y + distance * left)
    return heard


@kernel
def _hear_circles(barriers: Barriers, x: float, y: float, reach: float, fan: Floats) -> None:
    """Shorten the beams that meet a circle."""
    for k in range(len(barriers.circles)):
        radius = barriers.circles[k, 2]
        east, north = barriers.circles[k, 0] - x, barriers.circles[k, 1] - y
        if east * east + north * north >= (reach + radius) ** 2:
            continue
        for beam in range(len(fan)):
            ahead, left, farthest = fan[beam]
            along, across = east * ahead + north * left, north * ahead - east * left
            squared = radius * radius - across * across
            if squared >= 0.0 and 0.0 <= along - math.sqrt(squared) < farthest:
                fan[beam, 2] = along - math.sqrt(squared)


@kernel
def _hear_polygons(barriers: Barriers, x: float, y: float, reach: float, fan: Floats) -> None:
    """Shorten the beams that meet an edge of a polygon."""
    for k in range(len(barriers.first) - 1):
        first, last = barriers.first[k], barriers.first[k + 1]
        xa, ya = barriers.corners[last - 1, 0] - x, barriers.corners[last - 1, 1] - y
        for corner in range(first, last):
            xb, yb = barriers.corners[corner, 0] - x, barriers.corners[corner, 1] - y
            if max(min(xa, xb), min(ya, yb), -max(xa, xb), -max(ya, yb)) < reach:
                _hear_edge(xa, ya, xb, yb, fan)
            xa, ya = xb, yb


@kernel
def _hear_edge(xa: float, ya: float, xb: float, yb: float, fan: Floats) -> None:
    for beam in range(len(fan)):
        ahead, left, farthest = fan[beam]
        across_a, across_b = ya * ahead - xa * left, yb * ahead - xb * left
        if (across_a > 0.0) != (across_b > 0.0):
            along_a, along_b = xa * ahead + ya * left, xb * ahead + yb * left
            distance = along_a + (along_b - along_a) * across_a / (across_a - across_b)
            if 0.0 <= distance < farthest:
                fan[beam, 2] = distance


@kernel
def _to_land(
    land: Barriers, x: float, y: float, ahead: float, left: float, farthest: float
) -> float:
    """Distance along a beam to the land of a mask, if that is nearer."""
    distance = 0.0
    while distance < farthest:
        free = clearance(land, x + distance * ahead, y + distance * left)
        if free < _TOUCH:
            return distance
        distance += free
    return farthest


@kernel
def _remember(echoes: Floats, heard: int, x: float, y: float) -> int:
    for k in range(min(heard, len(echoes))):
        if (echoes[k, 0] - x) ** 2 + (echoes[k, 1] - y) ** 2 < _APART**2:
            return heard
    echoes[heard % len(echoes), 0], echoes[heard % len(echoes), 1] = x, y
    return heard + 1
