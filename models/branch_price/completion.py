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

__all__ = ["Completion", "carried", "complete", "completion_bound", "nearest_nodes", "over_legs"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bytes = NDArray[np.int8]
Booleans = NDArray[np.bool_]

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

    def mirrored(self) -> Completion:
        """The walks from the other end, where both directions are alike."""
        value = self.value.copy()
        value[:, [0, -1]] = value[:, [-1, 0]]
        return Completion(value, self.nearest, self.step)

    def of_routes(self, limits: Floats, end: int) -> Floats:
        """Most value of a walk to the other end, for every limit."""
        steps = np.minimum((limits / self.step + _ROUNDING).astype(np.int64), len(self.value) - 1)
        bounds: Floats = self.value[steps, end, 0]
        return bounds


def complete(
    leg: Floats,
    gain: Floats,
    origin: int,
    horizon: float,
    steps: int,
    memory: int,
    toll: float = 0.0,
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
    toll
        What a second costs.
    """
    while memory and steps * leg.size << memory > _MOST_WORK:
        memory -= 1
    step = (horizon or 1.0) / steps
    whole = np.full(leg.shape, steps + 1, dtype=np.int64)
    finite = leg <= horizon * (1.0 + _ROUNDING)
    whole[finite] = np.floor(leg[finite] / step + _ROUNDING / 1e3).astype(np.int64)
    nearest = nearest_nodes(leg, memory)
    cost = toll * np.where(finite, leg, 0.0)
    value = np.full((steps + 1, len(leg), 1 << memory), -np.inf)
    _walk(whole, cost, gain, origin, _clusters(whole), carried(nearest), value)
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
def carried(nearest: Ints) -> Bytes:
    """What a walk remembers at j that comes from i with s; -1 if it may not go there.

    Shape (size, 2 ** q, size), for i, s, j.
    """
    size, memory = nearest.shape
    carry = np.zeros((size, 1 << memory, size), np.int8)
    kept = np.zeros(memory, np.int64)
    for i in range(size):
        for j in range(size):
            kept[:] = 0
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
                known = passed
                for b in range(memory):
                    if s >> b & 1:
                        known |= kept[b]
                carry[i, s, j] = -1 if s & barred else known
    return carry


@kernel
def _walk(
    whole: Ints,
    cost: Floats,
    gain: Floats,
    origin: int,
    cluster: Ints,
    carry: Bytes,
    value: Floats,
) -> None:
    """Fill `value`; `whole[i, j]` is the leg from i to j in steps, `cost[i, j]` its toll.

    Walks that have become better with one step more are continued, the others were before.
    """
    size = len(gain)
    worth, clustered = _cluster_worth(cluster, gain)
    heads, count = _heads(whole, origin, len(value))
    door, entry = np.full(size, -np.inf), np.full(size, -np.inf)
    for k in range(len(value)):
        value[k, origin, 0] = 0.0
        if k == 0:
            _continue(
                whole, cost[origin], gain, heads[origin, : count[origin]], carry, origin, k, value
            )
        for j in range(1, size - 1):
            if clustered[j]:
                door[j] = max(door[j], value[k, j].max() - max(gain[j], 0.0))
                entry[cluster[j]] = max(entry[cluster[j]], door[j])
        for j in range(1, size - 1):
            if clustered[j]:
                value[k, j] = -np.inf
                value[k, j, 0] = entry[cluster[j]] + worth[cluster[j]]
            if _settle(value, k, j):
                _continue(whole, cost[j], gain, heads[j, : count[j]], carry, j, k, value)
        _settle(value, k, size - 1 - origin)
    for k in range(len(value)):
        for j in range(size):
            _forget(value[k, j])


@kernel
def _cluster_worth(cluster: Ints, gain: Floats) -> tuple[Floats, Booleans]:
    """What the nodes of every cluster gain together, and which nodes are in one."""
    size = len(gain)
    worth, clustered = np.zeros(size), np.zeros(size, np.bool_)
    for i in range(1, size - 1):
        worth[cluster[i]] += max(gain[i], 0.0)
        if cluster[i] != i:
            clustered[i] = clustered[cluster[i]] = True
    return worth, clustered


@kernel
def _heads(whole: Ints, origin: int, steps: int) -> tuple[Ints, Ints]:
    """Where walks go from every vertex, the nearest first, and how many vertices that are."""
    size = len(whole)
    target = size - 1 - origin
    heads, count = np.empty((size, size), np.int64), np.zeros(size, np.int64)
    for i in range(size):
        if i == target:
            continue
        for j in np.argsort(whole[i], kind="mergesort"):
            usable = whole[i, j] < steps and i != j and j != origin
            if usable and (whole[i, j] > 0 or i == origin or j == target):
                heads[i, count[i]] = j
                count[i] += 1
    return heads, count


@kernel
def _settle(value: Floats, k: int, j: int) -> bool:
    """Keep of the walks to j within k steps those that no other replaces; whether one is new.

    A walk replaces another if it is worth as much and remembers no more.
    """
    new = False
    if k > 0:
        for s in range(value.shape[2]):
            if value[k, j, s] > value[k - 1, j, s]:
                new = True
            else:
                value[k, j, s] = value[k - 1, j, s]
    else:
        new = value[k, j].max() > -np.inf
    if new:
        best = np.empty(value.shape[2])
        for s in range(value.shape[2]):
            best[s] = -np.inf
            bit = 1
            while bit <= s:
                if s & bit:
                    best[s] = max(best[s], best[s ^ bit])
                bit *= 2
            if value[k, j, s] > best[s]:
                best[s] = value[k, j, s]
            else:
                value[k, j, s] = -np.inf
    return new


@kernel
def _continue(
    whole: Ints,
    cost: Floats,
    gain: Floats,
    heads: Ints,
    carry: Bytes,
    i: int,
    k: int,
    value: Floats,
) -> None:
    """Continue the walks to i that k steps make better."""
    for s in range(value.shape[2]):
        known = value[k, i, s]
        if known == -np.inf or (k > 0 and known <= value[k - 1, i, s]):
            continue
        for j in heads:
            then = k + whole[i, j]
            if then >= len(value):
                break
            kept = carry[i, s, j]
            if kept >= 0:
                value[then, j, kept] = max(value[then, j, kept], known + gain[j] - cost[j])


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
def over_legs(
    leg: Floats, behind: Floats, ahead: Floats, step: float, limit: float, toll: float
) -> Floats:
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
    toll
        What a second costs.
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
            most[i, j] -= toll * leg[i, j]
    return most
