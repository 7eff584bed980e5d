"""Tier 3, path planning: what the ocean makes of every leg.

Between two stops N_i and N_j the AUV follows the path P* that takes the least time,

    P*_ij = argmin  sum over pieces k of |P_k| / v_g,k               (22), (23)
            subject to no obstacle or land on it                      (21)
            and a curvature that the AUV can turn,

with the ground speed v_g of (11). Differential evolution looks for it among B-splines; a
search over a wide stencil of grid points, which knows nothing of splines, is the reference that
it is held to. Where a straight line is provably as good, it is taken.

The leg times t_ij make the matrix of every model and heuristic. A time that varies is taken
when the mission begins: the combinatorial problem knows no clock.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path as File

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.instance import Instance
from fiveroute.limits import Clock, Limits, Progress, ProgressCallback
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.stated import stated_current
from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.legs import Waters

__all__ = ["PlannedPath", "Voyage", "at_sea", "plan_legs", "plan_path", "waters_of"]

Floats = NDArray[np.float64]
Leg = tuple[int, int]

_MARGIN = 0.25
"""How far paths may leave the rectangle around all stops, as a share of its diagonal."""

_LEAST_MARGIN = 500.0
"""The same, at least, in metres."""

_ERROR = 2e-4
"""Error in metres per second that the interpolation of the current may have."""

_REPORT_EVERY = 0.2
"""Seconds between two reports of progress."""


def waters_of(instance: Instance, folder: File | None = None) -> Waters:
    """The ocean of an instance as path planners see it, when the mission begins.

    Parameters
    ----------
    instance
        The instance.
    folder
        Folder that the name of its file of currents is relative to.

    Raises
    ------
    InputError
        If start, destination or a node lies inside an obstacle or on land, or beyond what the
        file of currents covers.
    """
    current, points = stated_current(instance, folder), instance.points
    region = _region(instance)
    land = None
    for part in current.parts:
        if isinstance(part, ModelCurrent):
            region, land = part.clip(region), part.land
    barriers = barriers_of(instance.ocean, region, land=land)
    refuse_points_inside(instance, barriers)
    return Waters(
        grid_current(current, region, tolerance=_ERROR),
        barriers,
        instance.fleet.speed,
        instance.fleet.turning_radius,
    )
