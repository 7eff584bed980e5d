"""Leg times between all stops of a mission, and the paths behind them.

Both are needed: the times make the matrix t_ij of equation (1), which is asymmetric in a current,
for every model and heuristic; the paths are what an AUV follows. They are kept flat, all tracks
in one array, so that a table of thousands of legs is two files' worth of numbers and no objects.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Leg", "LegTable"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

Leg = tuple[int, int]
"""Tail and head: two vertices."""


@dataclass(frozen=True, slots=True, eq=False)
class LegTable:
    """Times and tracks of legs. Build it with `LegTable.of`.

    Parameters
    ----------
    times
        Leg times t_ij in seconds, shape (n + 2, n + 2); infinite for a leg that cannot be sailed,
        and for one that was not planned; zero on the diagonal.
    first
        Where the track of each leg begins in `tracks`, and its end, shape (legs + 1,).
    legs
        The legs that have a track, tails and heads, shape (legs, 2).
    tracks
        Waypoints of all tracks in metres, shape (any, 2).
    """

    times: Floats
    first: Integers
    legs: Integers
    tracks: Floats

    @classmethod
    def of(cls, size: int, paths: Mapping[Leg, tuple[float, Floats]]) -> LegTable:
        """From duration and track of every leg that can be sailed, between `size` stops."""
        times = np.full((size, size), np.inf)
        np.fill_diagonal(times, 0.0)
        for leg, (duration, _) in paths.items():
            times[leg] = duration
        tracks = [track for _, track in paths.values()]
        return cls(
            times,
            np.cumsum([0, *map(len, tracks)], dtype=np.int64),
            np.array(list(paths), dtype=np.int64).reshape(-1, 2),
            np.concatenate([np.zeros((0, 2)), *tracks]),
        )

    def track(self, tail: int, head: int) -> Floats:
        """Waypoints from one stop to another in metres, shape (k, 2).

        Raises
        ------
        KeyError
            If the leg has no track.
        """
        places = np.flatnonzero((self.legs == (tail, head)).all(axis=1))
        if not len(places):
            raise KeyError((tail, head))
        return self.tracks[self.first[places[0]] : self.first[places[0] + 1]]

    def take(self, stops: Sequence[int]) -> LegTable:
        """The legs between some of the stops, in their order."""
        place = {stop: k for k, stop in enumerate(stops)}
        paths = {
            (place[i], place[j]): (float(self.times[i, j]), track)
            for (i, j), track in self.planned_tracks()
            if i in place and j in place
        }
        return LegTable.of(len(stops), paths)

    def unreachable(self) -> tuple[int, ...]:
        """Nodes that cannot be reached from the start, or from which nobody gets home."""
        nodes = np.arange(1, len(self.times) - 1)
        lost = np.isinf(self.times[0, nodes]) | np.isinf(self.times[nodes, -1])
        return tuple(nodes[lost].tolist())

    def planned(self) -> Iterable[Leg]:
        """The legs that have a track."""
        return ((int(tail), int(head)) for tail, head in self.legs)

    def planned_tracks(self) -> Iterable[tuple[Leg, Floats]]:
        """The legs that have a track, and its waypoints in metres, shape (k, 2)."""
        pieces = itertools.pairwise(self.first.tolist())
        return zip(self.planned(), (self.tracks[first:end] for first, end in pieces), strict=True)
