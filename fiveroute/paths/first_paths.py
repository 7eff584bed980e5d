"""Paths that a search begins with: the straight line, arcs, detours round what it meets.

Where the straight line runs into a barrier, the sideways distance to open water is measured on
both sides; a detour takes one side at every barrier met. With three barriers in the way
there are eight.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance
from fiveroute.paths.path_cost import PathProblem
from fiveroute.paths.polish import polish
from fiveroute.paths.spline import fit_control

__all__ = ["arcs", "detours", "first_controls", "joined", "sideways"]

Floats = NDArray[np.float64]

_PLACES = 257  # points of the straight line that are looked at
_SLIGHT, _WIDE = 0.07, 0.3  # height of arcs as a share of the line
_MOST_MET = 4  # barriers in the way whose sides are all tried in combination
_SLACK = 1.15  # detours run so much farther out than they must


def first_controls(
    problem: PathProblem, guesses: Sequence[Floats], weight: float, steps: int
) -> list[Floats]:
    """Control points of first paths: the straight line, and others a few steps down from there."""
    start, goal, spans = problem.straight[0], problem.straight[-1], len(problem.straight) - 3
    ways = detours(problem.barriers, start, goal, 2.0 * problem.buffer)
    tracks = (*guesses, *ways, *arcs(start, goal))
    controls = [fit_control(joined(track, start, goal), spans) for track in tracks]
    for control in controls:
        polish(problem, control, weight, steps)
    return [problem.straight, *controls]


def joined(track: Floats, start: Floats, goal: Floats) -> Floats:
    """A track with exactly the right ends."""
    return np.concatenate([start[None, :], track[1:-1], goal[None, :]])


def arcs(start: Floats, goal: Floats) -> Iterator[Floats]:
    """The straight line, half waves and full waves to both sides, as tracks."""
    share = np.linspace(0.0, 1.0, _PLACES)
    line, across = _line(start, goal, share)
    yield line
    for height, halves in itertools.product((_SLIGHT, -_SLIGHT, _WIDE, -_WIDE), (1, 2)):
        yield line + (height / halves * np.sin(halves * math.pi * share))[:, None] * across


def detours(barriers: Barriers, start: Floats, goal: Floats, buffer: float) -> Iterator[Floats]:
    """Tracks that take either side of the barriers that the straight line meets."""
    line, across = _line(start, goal, np.linspace(0.0, 1.0, _PLACES))
    left = sideways(barriers, line, across, buffer)
    right = sideways(barriers, line, -across, buffer)
    edge = np.diff(np.concatenate([[0], (left > 0.0).astype(np.int64), [0]]))
    met = [slice(a, b) for a, b in zip(*(np.flatnonzero(edge == k) for k in (1, -1)), strict=True)]
    if not met:
        return
    places = np.arange(_PLACES)
    for sides in itertools.product((True, False), repeat=min(len(met), _MOST_MET)):
        height = np.zeros(_PLACES)
        for part, to_left in zip(met, itertools.cycle(sides), strict=False):
            height[part] = left[part].max() if to_left else -right[part].max()
        stay = (height != 0.0) | (places % (_PLACES - 1) == 0)  # joined by straight legs
        height = np.interp(places, places[stay], _SLACK * height[stay])
        yield line + height[:, None] * across


def _line(start: Floats, goal: Floats, share: Floats) -> tuple[Floats, Floats]:
    """The straight line at shares of its length, and the vector as long to its left."""
    chord = goal - start
    return start + share[:, None] * chord, np.array([-chord[1], chord[0]])


@kernel
def sideways(barriers: Barriers, line: Floats, across: Floats, buffer: float) -> Floats:
    """Share of a vector to go from each point to open water, fresh; 0 for points that are in it.

    It looks no farther than twice the vector, and then tells twice.
    """
    length, found = math.hypot(across[0], across[1]), np.zeros(len(line))
    for k in range(len(line)):
        share = 0.0
        while share < 2.0:
            x, y = line[k, 0] + share * across[0], line[k, 1] + share * across[1]
            spare = clearance(barriers, x, y) - buffer
            if spare > 0.0:
                break
            share += max(-spare / length, 0.005)
        found[k] = min(share, 2.0)
    return found
