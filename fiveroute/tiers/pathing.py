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
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path as File

import numpy as np
from numpy.typing import NDArray

from fiveroute.check_paths import sailing_time
from fiveroute.instance import Instance
from fiveroute.kernels import source_digest
from fiveroute.limits import Clock, Limits, Progress, ProgressCallback
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.currents import Current
from fiveroute.ocean.stated import stated_current
from fiveroute.paths.evolved_path import THOROUGH, evolve_path
from fiveroute.paths.leg_cache import keep_table, kept_table, table_key
from fiveroute.paths.leg_table import Leg, LegTable
from fiveroute.paths.legs import track_clearance
from fiveroute.paths.path import Path, track_path
from fiveroute.paths.reference_path import grid_path, grid_paths
from fiveroute.paths.stated_waters import GRID_ERROR, waters_of
from fiveroute.paths.straight_legs import are_straight
from fiveroute.paths.thinning import thinned
from fiveroute.paths.voyage import Voyage
from fiveroute.paths.waters import Waters

__all__ = ["PlannedPath", "at_sea", "plan_legs", "plan_path"]

Floats = NDArray[np.float64]

_REPORT_EVERY = 20
"""Legs between two reports of progress."""

_COARSE = 4
"""Reach of the stencil that finds the ways round obstacles, in cells."""

_CELLS = 60
"""Cells of its grid along the region."""

_HASTE = 1e-3
"""Share by which a leg time on the grid is increased, where time is up, to be on the safe side."""

_OFF_TRACK = 0.5
"""Metres that a track may be moved to save waypoints."""

_INSTANT = 1e-9
"""Seconds that a reference counts at least."""


@dataclass(frozen=True, slots=True, eq=False)
class PlannedPath:
    """A path and what it is held to.

    Parameters
    ----------
    path
        The path of differential evolution, or the straight line.
    reference
        Duration of the reference path in seconds; infinite where it finds none.
    reference_track
        Its waypoints in metres, shape (k, 2).
    """

    path: Path
    reference: float
    reference_track: Floats

    @property
    def gap(self) -> float | None:
        """(duration - reference) / reference; below 0 where the reference is beaten."""
        if not (math.isfinite(self.reference) and self.path.is_found):
            return None
        return (self.path.duration - self.reference) / max(self.reference, _INSTANT)


def at_sea(
    instance: Instance,
    folder: File | None = None,
    *,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Voyage:
    """Plan all legs of a mission in its ocean.

    Parameters
    ----------
    instance
        The mission.
    folder
        Folder that the name of its file of currents is relative to.
    limits
        When to stop; legs that are not planned by then are straight lines in the current, or
        the first way round what blocks these, which is looked for in any case.
    seed
        Seed of the random numbers.
    progress
        Called as legs are planned.
    """
    if not instance.has_ocean:
        return Voyage.straight(instance)
    current = stated_current(instance, folder)
    waters = waters_of(instance, current)
    key = table_key(waters, instance.points, source_digest(__name__), seed)
    table, is_complete, is_hasty = kept_table(key), True, False
    if table is None:
        clock = (limits or Limits()).start()
        table = plan_legs(
            waters, current, instance.points, limits=clock.rest(), seed=seed, progress=progress
        )
        is_complete, is_hasty = not clock.interrupted, clock.expired
        if not is_hasty:  # no leg was left as it was
            keep_table(key, table)
    lost = table.unreachable()
    kept = [node for node in range(1, len(instance.nodes) + 1) if node not in lost]
    return Voyage(
        instance,
        replace(instance, nodes=tuple(instance.nodes[node - 1] for node in kept)),
        table.take([0, *kept, len(instance.nodes) + 1]),
        tuple(instance.nodes[node - 1].id for node in lost),
        is_complete,
        current if is_hasty else None,
    )


def plan_path(
    waters: Waters,
    start: Floats,
    goal: Floats,
    *,
    begin: float = 0.0,
    seed: int = 0,
    limits: Limits | None = None,
) -> PlannedPath:
    """Plan one path with all care, and its reference.

    Parameters
    ----------
    waters
        The ocean.
    start, goal
        Positions in metres, shape (2,).
    begin
        Time at which the path begins, in seconds.
    seed
        Seed of the random numbers.
    limits
        When to stop.
    """
    clock = (limits or Limits()).start()
    reference = grid_path(waters, start, goal, begin=begin)
    path = evolve_path(
        waters,
        start,
        goal,
        begin=begin,
        guesses=(reference.track,) if len(reference.track) else (),
        options=THOROUGH,
        rng=seed,
        clock=clock,
    )
    return PlannedPath(_clear_of_zones(waters, path), reference.duration, reference.track)


def _clear_of_zones(waters: Waters, path: Path) -> Path:
    """The path with its clearance from obstacles and land; the region's edge is no barrier."""
    if not path.is_found:
        return path
    wide = Region(-math.inf, -math.inf, math.inf, math.inf)._asdict()
    clear = track_clearance(waters.barriers._replace(**wide), path.waypoints)
    return replace(path, min_clearance=clear)


def plan_legs(
    waters: Waters,
    current: Current,
    points: Floats,
    *,
    only: Iterable[Leg] | None = None,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> LegTable:
    """Plan the legs between all stops, on all cores.

    Parameters
    ----------
    waters
        The ocean.
    current
        Its current; the times of the paths are taken in it, not on the planners' grid.
    points
        Positions of start, nodes and destination in metres, shape (n + 2, 2).
    only
        Legs that are needed; None for all but those into the start and out of the destination.
    limits
        When to stop; see `at_sea`.
    seed
        Seed of the random numbers; every leg has its own, so that its path does not depend on
        which others are planned.
    progress
        Called as legs are planned.
    """
    clock = (limits or Limits()).start()
    legs = _all_legs(len(points)) if only is None else sorted(only)
    paths = {leg: track_path(waters, points[list(leg)], 0.0) for leg in legs}
    ends = points[np.array(legs, dtype=np.int64).reshape(-1, 2)]
    straight = are_straight(waters, ends[:, 0], ends[:, 1])
    curved = [leg for leg, proved in zip(legs, straight, strict=True) if not proved]
    # Whether a leg can be sailed at all is no question of time: only an interruption leaves that
    # open.
    patient = replace(clock.limits, time=math.inf).start()
    blocked = [leg for leg in curved if not paths[leg].is_found]
    guesses = _ways_round(waters, points, blocked, patient)

    def improve(leg: Leg) -> None:
        start, goal = points[list(leg)]
        rng, guess = np.random.default_rng((seed, *leg)), guesses.get(leg, ())
        ways = (paths[leg], *(track_path(waters, track, 0.0) for track in guess))
        paths[leg] = min(ways, key=lambda path: path.duration)
        until = clock if paths[leg].is_found else patient
        if not until.expired:
            path = evolve_path(waters, start, goal, guesses=guess, rng=rng, clock=until)
            paths[leg] = min(path, paths[leg], key=lambda path: path.duration)

    def timed(leg: Leg) -> tuple[float, Floats]:
        path = paths[leg]
        track = _thinned(waters, path.waypoints)
        length = float(np.hypot(*np.diff(track, axis=0).T).sum())
        if clock.expired and GRID_ERROR * path.duration < 0.5 * _HASTE * length:
            return (1.0 + _HASTE) * path.duration, track  # errs by GRID_ERROR over ground speed
        return sailing_time(track, current, waters.speed), track

    with ThreadPoolExecutor(os.cpu_count()) as workers:
        for done, _ in enumerate(workers.map(improve, curved), start=1):
            if progress is not None and done % _REPORT_EVERY == 0:
                progress(Progress(clock.seconds, message=f"paths {done} of {len(curved)}"))
        found = [leg for leg in legs if paths[leg].is_found]
        return LegTable.of(len(points), dict(zip(found, workers.map(timed, found), strict=True)))


def _thinned(waters: Waters, track: Floats) -> Floats:
    """A track with as few waypoints as keep it where it is, or as it was if that collides."""
    few = thinned(track, _OFF_TRACK)
    return few if track_clearance(waters.barriers, few) >= 0.0 else track


def _all_legs(size: int) -> list[Leg]:
    """Legs from the start, between the nodes, and to the destination."""
    last = size - 1
    return [(i, j) for i in range(last) for j in range(1, size) if i != j]


def _ways_round(
    waters: Waters, points: Floats, legs: Iterable[Leg], clock: Clock
) -> dict[Leg, tuple[Floats, ...]]:
    """Tracks of the reference for legs whose straight line is blocked, one search a tail."""
    heads: dict[int, list[int]] = {}
    for tail, head in legs:
        heads.setdefault(tail, []).append(head)
    tracks: dict[Leg, tuple[Floats, ...]] = {}
    barriers = waters.barriers
    step = max(barriers.east - barriers.west, barriers.north - barriers.south) / _CELLS
    for tail, goals in heads.items():
        if clock.expired:
            break
        found = grid_paths(
            waters, points[tail], points[goals], step=step, radius=_COARSE, straight=False
        )
        tracks |= {
            (tail, head): (path.track,)
            for head, path in zip(goals, found, strict=True)
            if len(path.track)
        }
    return tracks
