"""The judge of paths: whether each leg of a plan leads where it says, in the time it says.

It shares no numerics with the planners. The current is taken from its formula or its file, not
from a planner's grid; the time along a path, equation (22), comes from Simpson's rule on short
pieces; what lies within obstacles and land is measured exactly, shape by shape.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.check import Violation
from fiveroute.crossings import metres_within
from fiveroute.instance import Circle, Instance, Polygon
from fiveroute.ocean.currents import Superposition
from fiveroute.routes import Plan

if TYPE_CHECKING:
    from fiveroute.ocean.currents import Current

__all__ = ["check_paths", "sailing_time", "times_of_paths"]

Floats = NDArray[np.float64]

_PIECE = 25.0
"""Longest piece in metres on which Simpson's rule is applied."""

_AT_POINT = 1.0
"""Metres by which a path may miss its ends."""

_TOUCH = 1e-6
"""Share of a path inside an obstacle that is put down to rounding."""

Tracks = Sequence[Sequence[Floats]]
"""For every AUV the waypoints of its legs in metres, shape (k, 2) each."""


def check_paths(
    instance: Instance,
    plan: Plan,
    tracks: Tracks,
    current: Current,
    times: Floats | None = None,
) -> list[Violation]:
    """Judge the paths of a plan in the ocean of its instance; whether in time is another matter.

    Parameters
    ----------
    instance
        The instance.
    plan
        A plan that knows no other nodes than the instance.
    tracks
        Paths of the legs from the start, between the nodes, and to the destination.
    current
        The current of the instance.
    times
        What `times_of_paths` says of them, if it is known already.

    Returns
    -------
    list of Violation
        ``path`` for legs that are missing or too many, or that miss their ends by so many metres;
        ``collision`` for so many metres inside obstacles or land; ``impassable`` where
        the current is too strong to sail a leg.
    """
    points = instance.points
    forbidden = (*instance.ocean.obstacles, *instance.ocean.land)
    if times is None:
        times = times_of_paths(instance, plan, tracks, current)
    violations = []
    for auv, (legs, paths) in enumerate(_by_auv(instance, plan, tracks)):
        if len(legs) != len(paths):
            violations.append(Violation("path", auv, None, float(len(paths) - len(legs))))
            continue
        for (tail, head), track in zip(legs, paths, strict=True):
            faults = _faults(track, points[[tail, head]], forbidden)
            ashore = _metres_ashore(track, current)
            if ashore > 0.0:
                faults.append(("collision", ashore))
            if math.isinf(times[tail, head]):
                faults.append(("impassable", _length(track)))
            violations += [Violation(kind, auv, head, amount) for kind, amount in faults]
    return violations


def times_of_paths(instance: Instance, plan: Plan, tracks: Tracks, current: Current) -> Floats:
    """Leg times of the paths of a plan in seconds, shape (n + 2, n + 2); infinite for others.

    Several AUVs may sail the direct leg, each on a path of its own: the slowest counts.
    """
    times = np.full((len(instance.nodes) + 2,) * 2, -np.inf)
    np.fill_diagonal(times, 0.0)
    for legs, paths in _by_auv(instance, plan, tracks):
        for leg, track in zip(legs, paths, strict=False):
            times[leg] = max(times[leg], sailing_time(track, current, instance.fleet.speed))
    return np.where(np.isneginf(times), np.inf, times)


def _by_auv(
    instance: Instance, plan: Plan, tracks: Tracks
) -> Iterator[tuple[list[tuple[int, int]], Sequence[Floats]]]:
    """Legs and paths of every AUV."""
    for route, paths in zip(plan.routes, tracks, strict=True):
        stops = [0, *route, len(instance.nodes) + 1]
        yield list(itertools.pairwise(stops)), paths


def sailing_time(track: Floats, current: Current, speed: float) -> float:
    """Time in seconds along straight legs, (11) and (22); infinite where they cannot be sailed.

    Parameters
    ----------
    track
        Waypoints in metres, shape (k, 2).
    current
        The current; its velocity at the time 0 is taken.
    speed
        Speed through the water in metres per second.
    """
    steps = np.diff(track, axis=0)
    lengths = np.hypot(*steps.T)
    steps, begins, lengths = steps[lengths > 0.0], track[:-1][lengths > 0.0], lengths[lengths > 0.0]
    if not len(lengths):
        return 0.0
    pieces = np.ceil(lengths / _PIECE).astype(np.int64)
    leg = np.repeat(np.arange(len(lengths)), pieces)
    place = np.arange(len(leg)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    piece, heading = lengths[leg] / pieces[leg], steps[leg] / lengths[leg, None]
    slowness = np.zeros(len(leg))
    for share, weight in ((0.0, 1.0), (0.5, 4.0), (1.0, 1.0)):  # Simpson's rule
        x, y = (begins[leg] + ((place + share) * piece)[:, None] * heading).T
        u, v = current(x, y, 0.0)
        across = v * heading[:, 0] - u * heading[:, 1]
        along = u * heading[:, 0] + v * heading[:, 1]
        made_good = along + np.sqrt(np.maximum(speed**2 - across**2, 0.0))
        if (np.abs(across) >= speed).any() or (made_good <= 0.0).any():
            return math.inf
        slowness += weight / 6.0 / made_good
    return float(slowness @ piece)


def _faults(
    track: Floats, ends: Floats, forbidden: Sequence[Circle | Polygon]
) -> list[tuple[str, float]]:
    """What is wrong with a leg between two points, wherever it takes place."""
    faults = []
    missed = float(np.hypot(*(track[[0, -1]] - ends).T).max())
    if missed > _AT_POINT:
        faults.append(("path", missed))
    inside = metres_within(track, forbidden)
    if inside > _TOUCH * max(_length(track), 1.0):
        faults.append(("collision", inside))
    return faults


def _metres_ashore(track: Floats, current: Current) -> float:
    """How far a track leads over cells of a file that are land or have no data, in metres.

    A quarter of a cell, by which a corner may be cut, counts as nothing.
    """
    from fiveroute.ocean.model_current import ModelCurrent

    parts = current.parts if isinstance(current, Superposition) else (current,)
    most = 0.0
    for part in parts:
        if isinstance(part, ModelCurrent):
            metres = _metres_within(track, part.closed, part.west, part.south, part.step)
            most = max(most, metres if metres > part.step / 4.0 else 0.0)
    return most


def _metres_within(
    track: Floats, cells: NDArray[np.bool_], west: float, south: float, step: float
) -> float:
    """Length of a track within square cells about the points of a regular grid, in metres."""
    legs = np.diff(track, axis=0)
    lengths = np.hypot(*legs.T)
    pieces = np.maximum(np.ceil(lengths / (step / 16.0)).astype(np.int64), 1)
    leg = np.repeat(np.arange(len(legs)), pieces)
    share = (np.arange(len(leg)) - np.repeat(np.cumsum(pieces) - pieces, pieces) + 0.5) / pieces[
        leg
    ]
    x, y = (track[:-1][leg] + share[:, None] * legs[leg]).T
    column = np.clip(np.rint((x - west) / step).astype(np.int64), 0, cells.shape[1] - 1)
    row = np.clip(np.rint((y - south) / step).astype(np.int64), 0, cells.shape[0] - 1)
    return float((lengths / pieces)[leg][cells[row, column]].sum())


def _length(track: Floats) -> float:
    return float(np.hypot(*np.diff(track, axis=0).T).sum())
