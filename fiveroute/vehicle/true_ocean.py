"""The ocean that a vehicle really meets: what was forecast, and what nobody knew of.

Equation (12) says how rough the sea is by two numbers, and this is what stands behind them. Its
Gaussian term comes from a current that was not forecast: the paper's field of random vortices, to
the scale of the mission. On the square of 10 km the kind `EFFECTIVE` changes the times of legs at
1 m/s by 17 % (`fiveroute.ocean.random_vortices`); lengths grow with the side of the mission,
speeds with the vehicle's and with the drift of (12), so that legs are late by that share on every
scale. Its manoeuvres come from discs, as many as the rate of (12) asks for
(`fiveroute.vehicle.unknown_obstacles`).

A truth is drawn for the whole sea, not for a leg: two vehicles that meet have the same current
around them, and whoever passes an obstacle first, it is there for the others as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.instance import Uncertainty
from fiveroute.ocean.barriers import Barriers, no_barriers
from fiveroute.ocean.current_grid import CurrentGrid, Region, refined
from fiveroute.ocean.random_vortices import EFFECTIVE, VortexKind, draw_vortices
from fiveroute.vehicle.unknown_obstacles import strewn_about

__all__ = ["Forecast", "TrueOcean"]

Floats = NDArray[np.float64]

_SIDE = 10_000.0  # metres of the paper's square, which the vortices are made for
_VORTICES = 20
_DRIFT = 0.17  # of the leg times at 1 m/s by vortices of the kind `EFFECTIVE`
_CELL = 1.0 / 75.0  # of the side: a sixth of a vortex's radius
_ROOM = 0.05  # of the side around the stops where a vehicle may be
_RADII = (10.0, 40.0)  # metres, of unknown obstacles


class TrueOcean(NamedTuple):
    """What there is in one run: the current, and all barriers."""

    grid: CurrentGrid
    barriers: Barriers


@dataclass(frozen=True, slots=True, eq=False)
class Forecast:
    """What is known of the ocean, and how much is not.

    Parameters
    ----------
    grid
        The current that is forecast.
    barriers
        The barriers that are known; a margin around them is a line on the map only.
    stops
        Positions of start, nodes and destination in metres, shape (n + 2, 2).
    speed
        Of the vehicle through the water in metres per second.
    uncertainty
        How rough the sea is; its drift and its rate of manoeuvres count.
    """

    grid: CurrentGrid
    barriers: Barriers
    stops: Floats
    speed: float
    uncertainty: Uncertainty

    @classmethod
    def of(
        cls,
        grid: CurrentGrid | None,
        barriers: Barriers | None,
        stops: Floats,
        speed: float,
        uncertainty: Uncertainty,
    ) -> Forecast:
        """A forecast; None for the current is still water, None for the barriers open water."""
        side = _side(stops)
        if grid is None:
            grid = _still_water(Region.around(stops, _ROOM * side), side)
        barriers = no_barriers() if barriers is None else barriers._replace(margin=0.0)
        return cls(refined(grid, _CELL * side), barriers, stops, speed, uncertainty)

    def truth(self, rng: np.random.Generator, standoff: float) -> TrueOcean:
        """Draw what the ocean is really like.

        Parameters
        ----------
        rng
            Source of the random numbers.
        standoff
            Metres that the vehicle keeps from obstacles.
        """
        west, south, east, north = Region.around(self.stops, _ROOM * _side(self.stops))
        swath_km = 2.0 * (sum(_RADII) / len(_RADII) + standoff) / 1000.0
        barriers = strewn_about(
            self.barriers,
            self.stops,
            np.array([west, south]),
            np.array([east, north]),
            self.uncertainty.manoeuvres_per_km / swath_km,
            _RADII,
            rng,
        )
        return TrueOcean(self._stirred(rng), barriers)

    def _stirred(self, rng: np.random.Generator) -> CurrentGrid:
        """The current with the paper's vortices, to the scale of the mission."""
        grid, size = self.grid, _side(self.stops) / _SIDE
        strength = size * self.speed * self.uncertainty.drift / _DRIFT
        if strength == 0.0:
            return grid
        kind = VortexKind(
            NormalDist(0.0, strength * EFFECTIVE.circulation.stdev),
            NormalDist(size * EFFECTIVE.radius.mean, size * EFFECTIVE.radius.stdev),
        )
        vortices = draw_vortices(kind, _VORTICES, Region.around(self.stops, 0.0), rng)
        rows, columns = grid.uv.shape[1:3]
        x, y = grid.west + grid.step * np.arange(columns), grid.south + grid.step * np.arange(rows)
        return grid._replace(uv=grid.uv + np.stack(vortices(x[None, :], y[:, None]), axis=-1))


def _side(stops: Floats) -> float:
    """Side of a mission in metres: the longer one of the rectangle around all stops."""
    return max(float(np.ptp(stops, axis=0).max()), 1.0)


def _still_water(region: Region, side: float) -> CurrentGrid:
    step = _CELL * side
    columns = int(np.ceil((region.east - region.west) / step)) + 3
    rows = int(np.ceil((region.north - region.south) / step)) + 3
    west, south = region.west - step, region.south - step
    return CurrentGrid(np.zeros((1, rows, columns, 2)), west, south, step, 0.0, 1.0)
