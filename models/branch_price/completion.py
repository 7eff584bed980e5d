"""What a partial route can still collect, at most: walks with a short memory on a time grid.

Divide time into steps of h seconds. With leg times rounded down to whole steps, let

    W(k, j, s) = most value of a walk from the origin to j that takes at most k steps
                 and remembers at j the set s of j's nearest nodes.

A walk remembers a node while it stays among nodes that have it nearby, and does not come back
to what it remembers: ng-routes with small neighbourhoods. W follows by dynamic programming over k
(N. Christofides, A. Mingozzi and P. Toth, "Exact algorithms for the vehicle routing problem",
Mathematical Programming 20 (1981), doi 10.1007/BF01589353, with the memory of R. Baldacci, A.
Mingozzi and R. Roberti 2011, doi 10.1287/opre.1110.0975). Walks from the destination over the
reversed legs bound how a route from the start can be completed, and the other way round; a route
that has visited the near nodes m goes on with a walk that remembers none of them,

    C(k, j, m) = max of W(k, j, s) over all s without a node of m.

A walk may go round and round over legs of no whole step. So nodes joined by such legs form
a cluster, and who enters it is granted all that a route can collect there, once: more than any
route through distinct nodes collects, though not more than any walk does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["Completion", "complete", "completion_bound", "nearest_nodes", "over_legs"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_ROUNDING = 1e-9  # share of a step by which remaining time is rounded up; legs by far less
_MOST_WORK = 120_000_000  # steps of the dynamic programme, some tenths of a second


@dataclass(frozen=True, slots=True, eq=False)
class Completion:
    """Values C of the best walks; minus infinity where there is none.

    Parameters
    ----------
    value
        C(k, j, m), shape (K + 1, size, 2 ** q).
    nearest
        The q nodes that bit 0, 1, ... of m stand for, shape (size, q); -1 beyond the last.
    step
        h in seconds.
    """

    value: Floats
    nearest: Ints
    step: float

    def of_routes(self, limits: Floats, end: int) -> Floats:
        """Most value of a walk to the other end, for every limit."""
        steps = np.minimum((limits / self.step + _ROUNDING).astype(np.int64), len(self.value) - 1)
        bounds: Floats = self.value[steps, end, 0]
        return bounds


def complete(
    leg: Floats, gain: Floats, origin: int, horizon: float, steps: int, memory: int
) -> Completion:
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
    memory
        q; less where there are so many vertices that it would take long.
    """
    while memory and steps * leg.size << memory > _MOST_WORK:
        memory -= 1
    step = (horizon or 1.0) / steps
    whole = np.full(leg.shape, steps + 1, dtype=np.int64)
    finite = leg <= horizon * (1.0 + _ROUNDING)
    whole[finite] = np.floor(leg[finite] / step + _ROUNDING / 1e3).astype(np.int64)
    nearest = nearest_nodes(leg, memory)
    value = np.full((steps + 1, len(leg), 1 << memory), -np.inf)
    _walk(whole, gain, origin, _clusters(whole), _carry(nearest), value)
    return Completion(value, nearest, step)


def nearest_nodes(leg: Floats, memory: int) -> Ints:
    """The nodes nearest to every node in either direction, shape (size, memory)."""
    there = np.minimum(leg, leg.T)
    there[[0, -1]] = there[:, [0, -1]] = np.inf
    np.fill_diagonal(there, np.inf)
    nearest = np.full((len(leg), memory), -1, dtype=np.int64)
    order = np.argsort(there, axis=1, kind="stable")[:, :memory]
    near = np.isfinite(np.take_along_axis(there, order, axis=1))
    nearest[:, : order.shape[1]] = np.where(near, order, -1)
    return nearest


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
def _carry(nearest: Ints) -> Ints:
    """What a walk remembers at j that comes from i with s; -1 if it may not go there.

    Shape (size, size, 2 ** q), for j, i, s.
    """
    size, memory = nearest.shape
    carry = np.zeros((size, size, 1 << memory), np.int64)
    for j in range(size):
        for i in range(size):
            kept = np.zeros(memory, np.int64)
            barred, passed = 0, 0
            for b in range(memory):
                if nearest[i, b] == j:
                    barred = 1 << b
                if nearest[j, b] == i:
                    passed = 1 << b
                for a in range(memory):
                    if nearest[i, b] >= 0 and nearest[j, a] == nearest[i, b]:
                        kept[b] = 1 << a
            for s in range(1 << memory):
                if s & barred:
                    carry[j, i, s] = -1
                    continue
                carry[j, i, s] = passed
                for b in range(memory):
                    if s >> b & 1:
                        carry[j, i, s] |= kept[b]
    return carry


@kernel
def _walk(
    whole: Ints, gain: Floats, origin: int, cluster: Ints, carry: Ints, value: Floats
) -> None:
    """Fill `value`; `whole[i, j]` is the leg from i to j in steps."""
    size = len(gain)
    target = size - 1 - origin
    clustered = np.zeros(size, np.bool_)
    worth, entry = np.zeros(size), np.empty(size)
    for i in range(1, size - 1):
        worth[cluster[i]] += max(gain[i], 0.0)
        if cluster[i] != i:
            clustered[i] = clustered[cluster[i]] = True
    tails = np.empty((size, size), np.int64)
    count = np.zeros(size, np.int64)
    for j in range(size):
        for i in range(size):
            usable = whole[i, j] < len(value) and i != j and i != target and j != origin
            if usable and (whole[i, j] > 0 or i == origin or j == target):
                tails[j, count[j]] = i
                count[j] += 1
    for k in range(len(value)):
        value[k, origin, 0] = 0.0
        for j in range(1, size - 1):
            _arrive(whole, gain, tails[j, : count[j]], carry, j, k, value)
        entry[:] = -np.inf
        for j in range(1, size - 1):
            if clustered[j]:
                at_door = value[k, j].max() - max(gain[j], 0.0)
                entry[cluster[j]] = max(entry[cluster[j]], at_door)
        for j in range(1, size - 1):
            if clustered[j]:
                value[k, j, 0] = entry[cluster[j]] + worth[cluster[j]]
        _arrive(whole, gain, tails[target, : count[target]], carry, target, k, value)
    for k in range(len(value)):
        for j in range(size):
            _forget(value[k, j])


@kernel
def _arrive(
    whole: Ints, gain: Floats, tails: Ints, carry: Ints, j: int, k: int, value: Floats
) -> None:
    """Best walks to j within k steps, for every memory."""
    for i in tails:
        before = k - whole[i, j]
        if before < 0:
            continue
        for s in range(value.shape[2]):
            known = value[before, i, s]
            if known > -np.inf:
                kept = carry[j, i, s]
                if kept >= 0:
                    value[k, j, kept] = max(value[k, j, kept], known + gain[j])


@kernel
def _forget(values: Floats) -> None:
    """From the best walk for every memory to the best that remembers none of a set, in place."""
    size = len(values)
    bit = 1
    while bit < size:
        for s in range(size):
            if s & bit:
                values[s] = max(values[s], values[s ^ bit])
        bit *= 2
    for s in range(size // 2):
        values[s], values[size - 1 - s] = values[size - 1 - s], values[s]


@kernel
def completion_bound(value: Floats, step: float, left: float, j: int, known: int) -> float:
    """Most value of a walk to j within `left` seconds that remembers nothing of `known`."""
    if left < 0.0:
        return -np.inf
    k = min(int(left / step + 1e-9), len(value) - 1)
    best: float = value[k, j, known]
    return best


@kernel
def over_legs(leg: Floats, behind: Floats, ahead: Floats, step: float, limit: float) -> Floats:
    """Most value of two walks that a leg joins within a limit, shape (size, size).

    Parameters
    ----------
    leg
        Leg times in seconds, shape (size, size).
    behind, ahead
        Values C of the walks from the start and from the destination.
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
                most[i, j] = max(most[i, j], behind[k, i, 0] + ahead[last - k, j, 0])
    return most
