"""The waters of a mission: its current on a grid, its barriers, and where paths may lead."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fiveroute.instance import Circle, Instance
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import Superposition
from fiveroute.ocean.model_current import ModelCurrent
from fiveroute.ocean.obstacles import refuse_points_inside
from fiveroute.ocean.stated import stated_barriers
from fiveroute.paths.waters import Waters

__all__ = ["GRID_ERROR", "waters_of"]

GRID_ERROR = 2e-4
"""Error in metres per second that the interpolation of the current may have."""

_MARGIN = 0.25
"""How far paths may leave the rectangle around all stops, as a share of its diagonal."""

_LEAST_MARGIN = 500.0
"""The same, at least, in metres."""


def waters_of(instance: Instance, current: Superposition, *, duration: float = 0.0) -> Waters:
    """The ocean of an instance as path planners see it.

    Parameters
    ----------
    instance
        The instance.
    current
        Its current, see `fiveroute.ocean.stated`.
    duration
        How long it is needed from the beginning of the mission, in seconds; 0 holds a current
        that varies as it is when the mission begins.

    Raises
    ------
    InputError
        If start, destination or a node lies inside an obstacle or on land, or beyond what the
        file of currents covers.
    """
    region = _region(instance)
    current(*instance.points.T)  # refuses stops beyond the data
    barriers = stated_barriers(instance, current, region)
    refuse_points_inside(instance, barriers)
    parts = (
        replace(part, extends=True) if isinstance(part, ModelCurrent) else part
        for part in current.parts
    )
    current = Superposition(tuple(parts))
    return Waters(
        grid_current(current, region, duration=duration, tolerance=GRID_ERROR),
        barriers,
        instance.fleet.speed,
        instance.fleet.turning_radius,
    )


def _region(instance: Instance) -> Region:
    """Where paths may lead: around all stops and obstacles, with room for detours."""
    corners = [instance.points]
    for shape in instance.ocean.obstacles:
        if isinstance(shape, Circle):
            centre, reach = np.array([shape.x, shape.y]), shape.radius
            corners.append(np.array([centre - reach, centre + reach]))
        else:
            corners.append(np.array(shape.polygon))
    points = np.concatenate(corners)
    diagonal = float(np.hypot(*np.ptp(points, axis=0)))
    return Region.around(points, max(_MARGIN * diagonal, _LEAST_MARGIN))
