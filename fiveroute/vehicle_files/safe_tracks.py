"""The paths that vehicles get: as few waypoints as keep them safe.

Whatever is left out lies within a tolerance of the straight line between its neighbours, and that
line has the clearance of what it replaces, or all that was asked for: a path that rounds a cape
keeps the waypoints at the cape. An AUV that would come home too late is thinned out less. The judge
has the last word: a leg that it finds fault with keeps all of its waypoints.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fiveroute.check_paths import check_paths, sailing_time
from fiveroute.formats.plan_file import PlanFile
from fiveroute.ocean.barriers import Barriers
from fiveroute.ocean.currents import Superposition
from fiveroute.ocean.stated import stated_barriers
from fiveroute.paths.legs import track_clearance
from fiveroute.paths.thinning import thinned
from fiveroute.vehicle_files.safety import require_feasible, require_passable

__all__ = ["safe_tracks"]

Floats = NDArray[np.float64]

_FINER = 4.0
_FINEST = 100.0  # an AUV that is late even at this share of the tolerance keeps all waypoints


def safe_tracks(
    filed: PlanFile, folder: Path, current: Superposition, tolerance: float
) -> list[list[Floats]]:
    """The paths of all legs of every AUV, in metres, shape (k, 2) each.

    Parameters
    ----------
    filed
        The plan; without paths it sails straight from node to node.
    folder
        Folder that the name of the instance's file of currents is relative to.
    current
        The current of its instance.
    tolerance
        Metres by which the straight lines between waypoints may leave a path.

    Raises
    ------
    InputError
        If the plan is infeasible, or its paths cross land or cannot be sailed.
    """
    sailed = filed if filed.paths is not None else replace(filed, paths=_straight(filed))
    tracks = sailed.tracks
    assert tracks is not None
    require_passable(filed, tracks, current)
    require_feasible(sailed, folder)
    barriers = stated_barriers(filed.instance, current)
    thin = [
        _in_time(filed, auv, paths, current, barriers, tolerance)
        for auv, paths in enumerate(tracks)
    ]
    destination = len(filed.instance.nodes) + 1
    for fault in check_paths(filed.instance, filed.plan, thin, current):
        assert fault.auv is not None
        leg = (*filed.plan.routes[fault.auv], destination).index(fault.node)
        thin[fault.auv][leg] = tracks[fault.auv][leg]
    require_passable(filed, thin, current)
    return thin


def _in_time(
    filed: PlanFile,
    auv: int,
    paths: Sequence[Floats],
    current: Superposition,
    barriers: Barriers,
    tolerance: float,
) -> list[Floats]:
    """The legs of an AUV, thinned out as far as it still comes home in time."""

    def is_clear(chord: Floats, stretch: Floats) -> bool:
        clear = track_clearance(barriers, chord)
        return clear >= 0.0 or clear >= track_clearance(barriers, stretch)

    service = float(filed.instance.service_times[list(filed.plan.routes[auv])].sum())
    off, left = tolerance, filed.instance.fleet.endurance_of(auv) - service
    while off >= tolerance / _FINEST and off > 0.0:
        thin = [thinned(path, off, is_clear) for path in paths]
        if sum(sailing_time(path, current, filed.instance.fleet.speed) for path in thin) <= left:
            return thin
        off /= _FINER
    return list(paths)


def _straight(filed: PlanFile) -> tuple[tuple[tuple[tuple[float, float], ...], ...], ...]:
    """The straight legs of a plan without paths."""
    places = [(x, y) for x, y in filed.instance.points.tolist()]
    return tuple(
        tuple(
            (places[tail], places[head])
            for tail, head in itertools.pairwise((0, *route, len(places) - 1))
        )
        for route in filed.plan.routes
    )
