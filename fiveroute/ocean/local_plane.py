"""A flat map about a point: where longitudes and latitudes meet the planner's metres.

The azimuthal equidistant projection of the WGS84 ellipsoid keeps distances and directions from
its origin; at r kilometres from it, lengths across err by (r / 6371)^2 / 6, 0.03 % at 250 km.
Away from the origin, east on Earth is not along the map's x axis: `LocalPlane.turn` is the
angle between them (about the difference in longitude times the sine of the latitude), by which
velocities given to the east and north turn when they are drawn on the map.

References
----------
J. P. Snyder, "Map projections: a working manual", USGS Professional Paper 1395 (1987),
doi 10.3133/pp1395.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError

if TYPE_CHECKING:
    import pyproj

__all__ = ["LocalPlane"]

Floats = NDArray[np.float64]

_NORTHWARD = 1e-4  # degrees of latitude over which the direction of north is taken


@dataclass(frozen=True, slots=True)
class LocalPlane:
    """An azimuthal equidistant map, x east and y north of its origin in metres.

    Parameters
    ----------
    lon, lat
        Origin in degrees.
    """

    lon: float
    lat: float

    def __post_init__(self) -> None:
        if not (-90.0 <= self.lat <= 90.0 and math.isfinite(self.lon)):
            raise InputError(
                "must be a longitude and a latitude in degrees, latitude from -90 to 90",
                field="origin",
                value=(self.lon, self.lat),
            )

    @property
    def proj(self) -> str:
        """The map as a PROJ string."""
        return f"+proj=aeqd +lat_0={self.lat:.15g} +lon_0={self.lon:.15g} +datum=WGS84 +units=m"

    def project(self, lon: Floats, lat: Floats) -> tuple[Floats, Floats]:
        """Positions x, y in metres of longitudes and latitudes in degrees."""
        x, y = self._projection()(lon, lat)
        return np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)

    def unproject(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Longitudes and latitudes in degrees of positions in metres."""
        lon, lat = self._projection()(x, y, inverse=True)
        return np.asarray(lon, dtype=np.float64), np.asarray(lat, dtype=np.float64)

    def turn(self, lon: Floats, lat: Floats) -> Floats:
        """Angle in radians, anticlockwise, from the x axis to the east on Earth."""
        x0, y0 = self.project(lon, lat - _NORTHWARD)
        x1, y1 = self.project(lon, lat + _NORTHWARD)
        return np.asarray(np.arctan2(x0 - x1, y1 - y0), dtype=np.float64)

    def _projection(self) -> pyproj.Proj:
        import pyproj

        return pyproj.Proj(self.proj)
