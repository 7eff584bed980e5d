"""Where every AUV of a run was, and when.

A run tells which legs its AUVs sailed, and when each began. That is enough to have their tracks:
a vehicle's leg is a function of its run, and is sailed again; what sails by (12) moves along
its planned path, the same share of it in every second.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fiveroute.paths.leg_table import LegTable
from fiveroute.sea.luck import Luck
from fiveroute.sea.run_result import RunResult
from fiveroute.sea.sailed_luck import SailedLuck
from fiveroute.sea.world import World

__all__ = ["EVERY", "tracks_of"]

Floats = NDArray[np.float64]

EVERY = 10.0
"""Seconds between two positions of a vehicle's track."""


def tracks_of(world: World, legs: LegTable | None, run: RunResult, seed: int) -> tuple[Floats, ...]:
    """The track of every AUV of a run: seconds, x and y in metres, each of shape (any, 3).

    Parameters
    ----------
    world
        The mission as it was simulated.
    legs
        The planned paths; None for straight lines.
    run
        The run, simulated with a log.
    seed
        Seed of the simulation.
    """
    luck = world.luck(seed, run.run)
    fails = dict.fromkeys(range(len(run.legs)), math.inf)
    fails |= {event.auv: event.t for event in run.events if event.kind == "fail"}
    tracks = []
    for auv, sailed in enumerate(run.legs):
        pieces = [np.zeros((0, 3))]
        for i, j, begin in sailed:
            if isinstance(luck, SailedLuck):
                pieces.append(_sailed(luck, i, j, begin))
            else:
                path = world.points[[i, j]] if legs is None else legs.track(i, j)
                pieces.append(_along(path, begin, luck, i, j))
        tracks.append(_until(np.concatenate(pieces), fails[auv]))
    return tuple(tracks)


def _sailed(luck: SailedLuck, i: int, j: int, begin: float) -> Floats:
    """A leg of the vehicle, with every so many positions and the last one."""
    model = luck.model
    track = model.sail(luck.ocean, i, j, 0.0 if model.is_steady else begin)
    times = begin + track.times - track.times[0]
    whole = np.column_stack([times, track.positions])
    stride = max(round(EVERY / float(times[1] - times[0])), 1) if len(times) > 1 else 1
    return np.concatenate([whole[:-1:stride], whole[-1:]])


def _along(path: Floats, begin: float, luck: Luck, i: int, j: int) -> Floats:
    """A path at constant progress."""
    way = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    share = way / way[-1] if way[-1] > 0.0 else np.linspace(0.0, 1.0, len(path))
    return np.column_stack([begin + share * luck.leg(i, j).time, path])


def _until(track: Floats, end: float) -> Floats:
    """A track as far as a time, where it ends on the way."""
    if not len(track) or track[-1, 0] <= end:
        return track
    last = [end, *(np.interp(end, track[:, 0], track[:, k]) for k in (1, 2))]
    return np.concatenate([track[track[:, 0] < end], [last]])
