"""Inner loops of the segmentation: the best cut points for one fixed measure.

A giant route of n nodes is cut into M segments of at least one node each. The full time
of the segment from its a-th to its b-th node, start and destination legs included, is

    T(a, b) = enter[a] + leave[b],    a <= b,

because everything between two nodes is a difference of prefix sums. With w = n - M + 1,
segment k (from 0) begins at node k + i and ends at node k + j with 0 <= i <= j < w, and
the next one begins at k + 1 + j: a cut is a sequence of offsets that never decreases,
ends_0 <= ... <= ends_(M-1) = w - 1. All kernels return that sequence. Nothing is assumed
about the leg times; T need not grow with the segment.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["cut_at_target", "cut_below", "cut_least_squares", "segment_times"]

Times = NDArray[np.float64]
Offsets = NDArray[np.int64]


@kernel
def segment_times(enter: Times, leave: Times, ends: Offsets) -> Times:
    """Times T of the segments of a cut, shape (M,)."""
    times = np.empty(len(ends))
    begin = 0
    for k in range(len(ends)):
        times[k] = enter[k + begin] + leave[k + ends[k]]
        begin = ends[k]
    return times


@kernel
def _trace(parent: Offsets) -> Offsets:
    """Follow the best predecessors back from the end of the last segment."""
    segments, width = parent.shape
    ends = np.empty(segments, np.int64)
    ends[segments - 1] = width - 1
    for k in range(segments - 1, 0, -1):
        ends[k - 1] = parent[k, ends[k]]
    return ends


@kernel
def _insert(tree: Offsets, line: int, base: Times, enter: Times, grid: Times) -> None:
    """Put a new function base[i] + (enter[i] + x)^2 into the Li Chao tree.

    Two such functions differ by a linear one, so they cross at most once: in every
    interval of the grid the loser can win on one side only.
    """
    node, low, high = 1, 0, len(grid) - 1
    while True:
        held = tree[node]
        if held < 0:
            tree[node] = line
            return
        middle = (low + high) // 2
        if _value(line, base, enter, grid[middle]) < _value(held, base, enter, grid[middle]):
            tree[node] = line
            line, held = held, line
        if low == high:
            return
        if _value(line, base, enter, grid[low]) < _value(held, base, enter, grid[low]):
            node, high = 2 * node, middle
        elif _value(line, base, enter, grid[high]) < _value(held, base, enter, grid[high]):
            node, low = 2 * node + 1, middle + 1
        else:
            return


@kernel
def _lowest(tree: Offsets, place: int, base: Times, enter: Times, grid: Times) -> int:
    """Which inserted function is the lowest at grid[place]."""
    node, low, high = 1, 0, len(grid) - 1
    best, least = -1, np.inf
    while True:
        held = tree[node]
        if held < 0:
            return best
        value = _value(held, base, enter, grid[place])
        if value < least:
            best, least = held, value
        if low == high:
            return best
        middle = (low + high) // 2
        if place <= middle:
            node, high = 2 * node, middle
        else:
            node, low = 2 * node + 1, middle + 1


@kernel
def _value(line: int, base: Times, enter: Times, x: float) -> float:
    away = enter[line] + x
    return float(base[line] + away * away)


@kernel
def cut_at_target(enter: Times, leave: Times, segments: int, target: float) -> Offsets:
    """Cut that minimises sum_k (T_k - target)^2, in O(M n log n).

    Dynamic programme over k and the end j of segment k,

        F_k(j) = min over i <= j of F_(k-1)(i) + (enter[k + i] + leave[k + j] - target)^2,

    the inner minimum being the lower envelope of functions inserted one by one.
    """
    width = len(enter) - segments + 1
    order = np.argsort(leave)
    grid = leave[order] - target
    rank = np.empty(len(leave), np.int64)
    rank[order] = np.arange(len(leave))
    tree = np.empty(4 * len(leave), np.int64)
    parent = np.zeros((segments, width), np.int64)
    cost = (enter[0] + leave[:width] - target) ** 2
    for k in range(1, segments):
        tree[:] = -1
        base, begin = cost.copy(), enter[k : k + width]
        for j in range(width):
            _insert(tree, j, base, begin, grid)
            i = _lowest(tree, rank[k + j], base, begin, grid)
            parent[k, j] = i
            cost[j] = _value(i, base, begin, leave[k + j] - target)
    return _trace(parent)


@kernel
def cut_below(enter: Times, leave: Times, segments: int, limit: float) -> Offsets:
    """Cut with every T_k <= limit, in O(M n); an empty array where there is none.

    An end is reached if the smallest `enter` among the reached beginnings allows it.
    """
    width = len(enter) - segments + 1
    parent = np.zeros((segments, width), np.int64)
    reached = np.zeros(width, np.bool_)
    reached[0] = True
    for k in range(segments):
        best, least = -1, np.inf
        for j in range(width):
            if reached[j] and enter[k + j] < least:
                best, least = j, enter[k + j]
            parent[k, j] = best
            reached[j] = best >= 0 and least + leave[k + j] <= limit
    return _trace(parent) if reached[width - 1] else np.empty(0, np.int64)


@kernel
def cut_least_squares(enter: Times, leave: Times, segments: int, limit: float) -> Offsets:
    """Cut that minimises sum_k T_k^2 among those with every T_k <= limit, in O(M n^2).

    At least one such cut must exist.
    """
    width = len(enter) - segments + 1
    parent = np.zeros((segments, width), np.int64)
    cost = np.full(width, np.inf)
    cost[0] = 0.0
    for k in range(segments):
        base = cost.copy()
        for j in range(width):
            best, least = 0, np.inf
            for i in range(j + 1):
                time = enter[k + i] + leave[k + j]
                if time <= limit and base[i] + time * time < least:
                    best, least = i, base[i] + time * time
            parent[k, j] = best
            cost[j] = least
    return _trace(parent)
