"""Cutting the giant route so that the absolute deviations from the mean time are least.

The objective sum_i |T_i - T'| with T' = (1 / M) sum_i T_i couples all segments through
T', and, other than for squares, the mean is not the best common target: no parametric
search over targets need meet the optimum. It is found by branch and bound over the mean.

Let T' lie in [low, high], and let -1 <= s <= 1. Adding s sum_i (T_i - T') = 0 gives

    sum_i |T_i - T'| = sum_i |T_i - T'| + s (T_i - T') >= sum_i phi(T_i),

    phi(T) = (1 - s) (low - T) below low,  0 inside,  (1 + s) (T - high) above high,

and the right side is minimised by dynamic programming. The table of its best completions
also drives a depth-first enumeration of all cuts whose bound stays below the best known
value. An interval is done when its bound reaches that value or when its enumeration ends
within a given number of steps; otherwise it is halved.

The work is limited by a number of steps. Within it the optimum is proved for small and
middle sizes; beyond, the best cut found is returned.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.models.cut_kernels import segment_times

__all__ = ["AbsoluteSearch"]

_SLANTS = 4
"""Values of s tried per interval, by bisection on the concave bound."""

_PATIENCE = 20
"""Steps of an enumeration for each step of the dynamic programme before it is given up."""

Times = NDArray[np.float64]
Offsets = NDArray[np.int64]


@kernel
def _penalty(time: float, low: float, high: float, slant: float) -> float:
    if time < low:
        return (1.0 - slant) * (low - time)
    if time > high:
        return (1.0 + slant) * (time - high)
    return 0.0


@kernel
def _windows(enter: Times, leave: Times, shortest: float, longest: float) -> Offsets:
    """First and last end of a segment from each beginning with a time in the given range.

    Shape (n, 2); the window of a beginning without any such end is empty.
    """
    nodes = len(enter)
    windows = np.empty((nodes, 2), np.int64)
    for a in range(nodes):
        first, last = nodes, -1
        for b in range(a, nodes):
            if shortest <= enter[a] + leave[b] <= longest:
                first, last = min(first, b), b
        windows[a] = first, last
    return windows


@kernel
def _completions(
    enter: Times, leave: Times, windows: Offsets, segments: int, low: float, high: float,
    slant: float,
) -> Times:  # fmt: skip
    """Least penalty of the segments k to M - 1 when segment k begins at offset i.

    Shape (M + 1, w); infinite where every way leaves the windows.
    """
    width = len(enter) - segments + 1
    table = np.full((segments + 1, width), np.inf)
    table[segments, width - 1] = 0.0
    for k in range(segments - 1, -1, -1):
        for i in range(width):
            first, last = windows[k + i]
            least = np.inf
            for j in range(max(first - k, i), min(last - k, width - 1) + 1):
                penalty = _penalty(enter[k + i] + leave[k + j], low, high, slant)
                least = min(least, penalty + table[k + 1, j])
            table[k, i] = least
    return table


@kernel
def _enumerate(
    enter: Times, leave: Times, windows: Offsets, table: Times, low: float, high: float,
    slant: float, ends: Offsets, value: float, steps: int,
) -> tuple[float, int]:  # fmt: skip
    """Walk through all cuts whose penalty stays below `value`, which falls as we go.

    Writes the best cut into `ends`. Returns its value and the steps left, -1 where they
    did not suffice.
    """
    segments, width = len(ends), table.shape[1]
    trial = np.empty(segments, np.int64)
    spent = np.zeros(segments + 1)
    begin = np.zeros(segments + 1, np.int64)
    k = 0
    trial[0] = max(windows[0, 0], 0) - 1
    while k >= 0:
        trial[k] += 1
        j = trial[k]
        if j > min(windows[k + begin[k], 1] - k, width - 1):
            k -= 1
            continue
        steps -= 1
        if steps < 0:
            return value, -1
        penalty = _penalty(enter[k + begin[k]] + leave[k + j], low, high, slant)
        if spent[k] + penalty + table[k + 1, j] >= value:
            continue
        if k == segments - 1:
            times = segment_times(enter, leave, trial)
            exact = np.abs(times - times.mean()).sum()
            if exact < value:
                value = exact
                ends[:] = trial
            continue
        spent[k + 1] = spent[k] + penalty
        begin[k + 1] = j
        k += 1
        trial[k] = max(windows[k + j, 0] - k, j) - 1
    return value, steps


@kernel
def _follow(
    enter: Times, leave: Times, windows: Offsets, table: Times, low: float, high: float,
    slant: float,
) -> Offsets:  # fmt: skip
    """Cut of least penalty, read off a finite table."""
    segments, width = table.shape[0] - 1, table.shape[1]
    ends = np.empty(segments, np.int64)
    i = 0
    for k in range(segments):
        first, last = windows[k + i]
        best, least = width - 1, np.inf
        for j in range(max(first - k, i), min(last - k, width - 1) + 1):
            penalty = _penalty(enter[k + i] + leave[k + j], low, high, slant)
            if penalty + table[k + 1, j] < least:
                best, least = j, penalty + table[k + 1, j]
        ends[k] = i = best
    return ends


@dataclass(slots=True)
class AbsoluteSearch:
    """The search: the best cut so far, and the work still allowed.

    Parameters
    ----------
    enter, leave
        See `fiveroute.models.cut_kernels`, each of shape (n,).
    ends
        Best cut so far, shape (M,).
    steps
        Inner steps still allowed, about a nanosecond each.
    """

    enter: Times
    leave: Times
    ends: Offsets
    steps: int = 1_000_000_000

    @property
    def value(self) -> float:
        """Sum of the absolute deviations of the best cut so far."""
        return self._value_of(self.ends)

    def run(self) -> bool:
        """Search until the best cut is proved optimal, or the steps are used up.

        Returns
        -------
        bool
            Whether `ends` is proved optimal.
        """
        low = float((self.leave + np.minimum.accumulate(self.enter)).min())
        high = float((self.leave + np.maximum.accumulate(self.enter)).max())
        waiting = [(0.0, low, high)]
        while waiting:
            bound, low, high = heapq.heappop(waiting)
            if bound >= self.value:
                return True
            if self.steps < 0:
                return False
            bound, done = self._examine(low, high)
            middle = (low + high) / 2.0
            if not done:
                heapq.heappush(waiting, (bound, low, middle))
                heapq.heappush(waiting, (bound, middle, high))
        return True

    def _examine(self, low: float, high: float) -> tuple[float, bool]:
        """Bound the means of an interval; True if no better cut has its mean there."""
        bound, (least, most) = -1.0, (-1.0, 1.0)
        for _ in range(_SLANTS):
            slant = (least + most) / 2.0
            windows, table = self._relax(low, high, slant)
            if table[0, 0] >= self.value:
                return float(table[0, 0]), True
            ends = _follow(self.enter, self.leave, windows, table, low, high, slant)
            self._offer(ends)
            if table[0, 0] > bound:
                bound, chosen = float(table[0, 0]), (windows, table, low, high, slant)
            times = segment_times(self.enter, self.leave, ends)
            if (times - np.clip(times, low, high)).sum() > 0.0:
                least = slant
            else:
                most = slant
        return bound, bound >= self.value or self._exhaust(*chosen)

    def _relax(self, low: float, high: float, slant: float) -> tuple[Offsets, Times]:
        shortest = low - self.value / (1.0 - slant)
        longest = high + self.value / (1.0 + slant)
        windows = _windows(self.enter, self.leave, shortest, longest)
        segments = len(self.ends)
        self.steps -= self._effort(windows)
        table = _completions(self.enter, self.leave, windows, segments, low, high, slant)
        return windows, table

    def _effort(self, windows: Offsets) -> int:
        pairs = int(np.maximum(windows[:, 1] - windows[:, 0] + 1, 0).sum())
        return pairs * len(self.ends) + len(self.enter) ** 2 // 2

    def _exhaust(
        self, windows: Offsets, table: Times, low: float, high: float, slant: float
    ) -> bool:
        """Enumerate all cuts that the relaxation leaves; True if they came to an end."""
        allowed = min(_PATIENCE * self._effort(windows), self.steps)
        _, left = _enumerate(
            self.enter, self.leave, windows, table, low, high, slant, self.ends, self.value, allowed
        )
        self.steps -= allowed - left
        return bool(left >= 0)

    def _offer(self, ends: Offsets) -> None:
        if self._value_of(ends) < self.value:
            self.ends = ends

    def _value_of(self, ends: Offsets) -> float:
        times = segment_times(self.enter, self.leave, ends)
        return float(np.abs(times - times.mean()).sum())
