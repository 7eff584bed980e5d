"""What a partial route can still collect, at most: walks without two-cycles on a time grid.

Divide time into steps of h seconds. With leg times rounded down to whole steps, let

    W(k, j) = most value of a walk from the origin to j that takes at most k steps
              and never turns straight back, i -> j -> i.

It takes O(K n^2) by dynamic programming over k (N. Christofides, A. Mingozzi and P. Toth,
"Exact algorithms for the vehicle routing problem", Mathematical Programming 20 (1981),
doi 10.1007/BF01589353). Walks from the destination over the reversed legs bound how a route from
the start can be completed, and the other way round.

A walk may go round and round over legs of no whole step. So nodes joined by such legs form
a cluster, and who enters it is granted all that a route can collect there, once: more than any
route through distinct nodes collects, though not more than any walk does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["Completion", "complete", "completion_bound", "over_legs"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_ROUNDING = 1e-9  # share of a step by which remaining time is rounded up


@dataclass(frozen=True, slots=True, eq=False)
class Completion:
    """Values W of the best walks; minus infinity where there is none.

    Parameters
    ----------
    best
        W(k, j), shape (K + 1, size).
    before
        Node before j on that walk, shape (K + 1, size); -1 where it may be any.
    other
        The most value with another node before j, shape (K + 1, size).
    step
        h in seconds.
    """

    best: Floats
    before: Ints
    other: Floats
    step: float


def complete(leg: Floats, gain: Floats, origin: int, horizon: float, steps: int) -> Completion:
    """Compute all walks from an origin.

    Parameters
    ----------
    leg
        Leg times in seconds, shape (size, size); infinite where there is no leg. The start
        is vertex 0, the destination the last.
    gain
        Value of a visit, shape (size,); 0 at both ends.
    origin
        One of the two ends.
    horizon
        Longest time in seconds.
    steps
        K.
    """
    step = (horizon or 1.0) / steps
    whole = np.full(leg.shape, steps + 1, dtype=np.int64)
    finite = leg <= horizon * (1.0 + _ROUNDING)
    whole[finite] = np.floor(leg[finite] / step * (1.0 - _ROUNDING)).astype(np.int64)
    shape = (steps + 1, len(leg))
    best, other = np.full(shape, -np.inf), np.full(shape, -np.inf)
    before = np.full(shape, -1, dtype=np.int64)
    cluster = _clusters(whole)
    _walk(np.ascontiguousarray(whole.T), gain, origin, cluster, best, before, other)
    return Completion(best, before, other, step)


def _clusters(whole: Ints) -> Ints:
    """Smallest vertex that zero-step legs join to every inner vertex, in either direction."""
    size = len(whole)
    linked = (whole == 0) | (whole.T == 0)
    linked[[0, -1]] = linked[:, [0, -1]] = False
    cluster = np.arange(size)
    while True:
        least = np.where(linked, cluster, size).min(axis=1)
        if (least >= cluster).all():
            return cluster
        cluster = np.minimum(cluster, least)


@kernel
def _walk(
    whole: Ints,
    gain: Floats,
    origin: int,
    cluster: Ints,
    best: Floats,
    before: Ints,
    other: Floats,
) -> None:
    """Fill `best`, `before` and `other`; `whole[j, i]` is the leg from i to j in steps."""
    size = len(gain)
    target = size - 1 - origin
    clustered = np.zeros(size, np.bool_)
    for i in range(1, size - 1):
        if cluster[i] != i:
            clustered[i] = clustered[cluster[i]] = True
    worth = np.zeros(size)
    for i in range(1, size - 1):
        worth[cluster[i]] += max(gain[i], 0.0)
    entry = np.empty(size)
    for k in range(len(best)):
        best[k, origin] = 0.0
        for j in range(1, size - 1):
            _arrive(whole, gain, origin, j, k, best, before, other)
        entry[:] = -np.inf
        for j in range(1, size - 1):
            if clustered[j]:
                at_door = best[k, j] - max(gain[j], 0.0)
                entry[cluster[j]] = max(entry[cluster[j]], at_door)
        for j in range(1, size - 1):
            if clustered[j]:
                best[k, j] = other[k, j] = entry[cluster[j]] + worth[cluster[j]]
                before[k, j] = -1
        _arrive(whole, gain, origin, target, k, best, before, other)


@kernel
def _arrive(
    whole: Ints,
    gain: Floats,
    origin: int,
    j: int,
    k: int,
    best: Floats,
    before: Ints,
    other: Floats,
) -> None:
    """Best and second-best walks to j within k steps; zero-step legs count at the ends only."""
    size = len(gain)
    first, second, tail = -np.inf, -np.inf, -1
    at_end = j == size - 1 - origin
    for i in range(size):
        steps = whole[j, i]
        if steps > k or i == j or i == size - 1 - origin:
            continue
        if steps == 0 and i != origin and not at_end:
            continue
        value = other[k - steps, i] if before[k - steps, i] == j else best[k - steps, i]
        value += gain[j]
        if i == tail:
            first = max(first, value)
        elif value > first:
            second, first, tail = first, value, i
        elif value > second:
            second = value
    best[k, j], other[k, j], before[k, j] = first, second, tail


@kernel
def completion_bound(
    best: Floats, before: Ints, other: Floats, step: float, left: float, i: int, j: int
) -> float:
    """Most value of a walk to j within `left` seconds that does not come over i."""
    if left < 0.0:
        return -np.inf
    k = min(int(left / step + 1e-9), len(best) - 1)
    return other[k, j] if before[k, j] == i else best[k, j]


@kernel
def over_legs(leg: Floats, behind: Floats, ahead: Floats, step: float, limit: float) -> Floats:
    """Most value of two walks that a leg joins within a limit, shape (size, size).

    Parameters
    ----------
    leg
        Leg times in seconds, shape (size, size).
    behind, ahead
        Values W of the walks from the start and from the destination, shape (K + 1, size).
    step
        h in seconds.
    limit
        Longest time in seconds.
    """
    size = len(leg)
    most = np.full((size, size), -np.inf)
    for i in range(size - 1):
        for j in range(1, size):
            left = limit - leg[i, j]
            if left < 0.0:
                continue
            last = min(int(left / step + 1e-9), len(behind) - 1)
            for k in range(last + 1):
                most[i, j] = max(most[i, j], behind[k, i] + ahead[last - k, j])
    return most
