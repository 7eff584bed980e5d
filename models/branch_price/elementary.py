"""Every elementary route that a better plan may sail, each node set once, in its shortest order.

Let U be a bound with multipliers, best_c its parts and v(r) the worth of a route, see
`fiveroute.models.branch_price.pricing`. A plan that sails r with an AUV of class c collects at
most U - (best_c - v(r)). So every plan that collects more than a target L consists of routes with

    v(r) > best_c - (U - L).

They are enumerated node by node (R. Baldacci, A. Mingozzi and R. Roberti 2011, doi
10.1287/opre.1110.0975). Of two orders of the same nodes with the same end the shorter one replaces
the other in any plan: a table of node sets tells in no time. What a partial route can still
collect is bounded by walks.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.limits import Clock
from fiveroute.models.branch_price.buckets import priced
from fiveroute.models.branch_price.column_generation import Relaxation
from fiveroute.models.branch_price.completion import complete
from fiveroute.models.branch_price.labels import promising
from fiveroute.models.branch_price.pool import Pool
from fiveroute.models.branch_price.roads import Roads

__all__ = ["enumerate_routes"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Shorts = NDArray[np.int16]

_BITS = 62  # nodes in a word
_STEPS, _MEMORY = 1000, 5  # of the completion bounds
_WORK = 400_000  # extensions between two looks at the clock
_END, _PARENT, _HASH, _CUTS = 0, 1, 2, 3


def enumerate_routes(
    roads: Roads, relaxation: Relaxation, target: float, clock: Clock, most: float
) -> Pool | None:
    """All routes of plans that collect more than `target`; None beyond `most` partial routes."""
    gap = relaxation.value - target + 1e-9 * max(1.0, abs(relaxation.value))
    table = _Table(roads, relaxation, gap)
    is_whole = table.grow(clock, most)
    clock.spend(table.count)
    return table.pool() if is_whole else None


class _Table:
    """Partial routes by node set and end."""

    def __init__(self, roads: Roads, relaxation: Relaxation, gap: float) -> None:
        self.roads = roads
        size = len(roads.leg)
        self.gain = roads.profit - relaxation.duals.node
        self.in_cut, self.recall, self.sigma = relaxation.duals.cut_masks()
        self.floors = relaxation.best - gap
        horizon = float(roads.limits[-1])
        self.rest = complete(roads.leg.T, self.gain, size - 1, horizon, _STEPS, _MEMORY, roads.toll)
        rng = np.random.default_rng(0)
        self.code = rng.integers(1, 1 << 62, size=size)
        self.end_code = rng.integers(1, 1 << 62, size=size)
        room = 1 << 12
        self.words = np.zeros((room, size // _BITS + 1), dtype=np.int64)
        self.time, self.value = np.zeros(room), np.zeros(room)
        self.links = np.zeros((room, 4), dtype=np.int64)
        self.links[0, _PARENT] = -1
        self.slots = np.full(2 * room, -1, dtype=np.int64)
        self.count = 1

    def grow(self, clock: Clock, most: float) -> bool:
        """Enumerate; return whether that came to an end."""
        first, last = 0, 1
        while first < last:
            at = first
            while at < last:
                at, self.count = _extend(
                    self.roads.leg, self.gain, self.in_cut, self.recall, self.sigma,
                    self.roads.limits, self.floors, self.roads.toll, self.rest.value,
                    self.rest.nearest, self.rest.step, self.code, self.end_code, self.words,
                    self.time, self.value, self.links, self.slots, self.count, at, last, _WORK,
                )  # fmt: skip
                if clock.expired or self.count > most:
                    return False
                if self.count + len(self.code) > len(self.time):
                    self._double()
            first, last = last, self.count
        return True

    def _double(self) -> None:
        for name in ("words", "time", "value", "links"):
            old = getattr(self, name)
            setattr(self, name, np.concatenate([old, np.zeros_like(old)]))
        self.slots = np.full(2 * len(self.time), -1, dtype=np.int64)
        _enter_all(self.links, self.end_code, self.slots, self.count)

    def pool(self) -> Pool:
        """The shortest route over every node set that is worth enough."""
        ends = self.links[: self.count, _END]
        home = self.roads.leg[ends, -1]
        time = self.time[: self.count] + home
        classes = np.searchsorted(self.roads.limits, time)
        within = classes < len(self.roads.limits)
        value = self.value[: self.count][within] - self.roads.toll * home[within]
        within[within] = value > self.floors[classes[within]]
        labels = np.flatnonzero(within)
        order = np.lexsort((time[labels], *self.words[labels].T))
        labels = labels[order]
        if len(labels):
            new = (np.diff(self.words[labels], axis=0) != 0).any(axis=1)
            labels = labels[np.concatenate([[True], new])]
        return Pool.along(self.roads, self._stops(labels), time[labels])

    def _stops(self, labels: Ints) -> Shorts:
        """Nodes of partial routes in the order of the visits."""
        columns: list[Shorts] = []
        while (labels > 0).any():
            columns.append(self.links[labels, _END].astype(np.int16))
            labels = np.where(labels > 0, self.links[labels, _PARENT], 0)
        stops = np.zeros((len(labels), len(columns)), dtype=np.int16)
        for k, column in enumerate(reversed(columns)):
            stops[:, k] = column
        return _left_aligned(stops)


def _left_aligned(stops: Shorts) -> Shorts:
    """Rows with their zeros moved behind the rest."""
    order = np.argsort(stops == 0, axis=1, kind="stable")
    aligned: Shorts = np.take_along_axis(stops, order, axis=1)
    return aligned


@kernel
def _extend(
    leg: Floats,
    gain: Floats,
    in_cut: Ints,
    recall: Ints,
    sigma: Floats,
    limits: Floats,
    floors: Floats,
    toll: float,
    rest: Floats,
    nearest: Ints,
    step: float,
    code: Ints,
    end_code: Ints,
    words: Ints,
    time: Floats,
    value: Floats,
    links: Ints,
    slots: Ints,
    count: int,
    at: int,
    last: int,
    work: int,
) -> tuple[int, int]:
    """Extend partial routes from `at` on, all before `last` having the same number of nodes.

    Returns
    -------
    int, int
        Where to go on, and the number of partial routes. All arrays from `words` on are
        changed in place; the call ends when they have no room for another extension.
    """
    size = len(gain)
    done = 0
    for label in range(at, last):
        if done > work or count + size > len(time):
            return label, count
        i = links[label, _END]
        for j in range(1, size - 1):
            t = time[label] + leg[i, j]
            word, bit = j // _BITS, 1 << (j % _BITS)
            if t > limits[-1] or words[label, word] & bit:
                continue
            done += 1
            cuts = links[label, _CUTS] & recall[j]
            v = value[label] + gain[j] - toll * leg[i, j]
            paid = cuts & in_cut[j]
            if paid:
                v -= priced(paid, sigma)
            known = _visited(words[label], nearest[j])
            if not promising(rest, step, limits, floors, t, v - gain[j], j, known):
                continue
            mixed = links[label, _HASH] ^ code[j]
            slot = _find(words, links, slots, words[label], word, bit, mixed, j, end_code[j])
            new = slots[slot]
            if new < 0:
                new = slots[slot] = count
                count += 1
                words[new] = words[label]
                words[new, word] |= bit
                links[new, _END], links[new, _HASH] = j, mixed
                time[new] = np.inf
            if t < time[new]:
                time[new], value[new] = t, v
                links[new, _PARENT], links[new, _CUTS] = label, cuts ^ in_cut[j]
    return last, count


@kernel
def _visited(words: Ints, nodes: Ints) -> int:
    """Which of some nodes a partial route has visited, a bit each; those at -1 left out."""
    known = 0
    for b in range(len(nodes)):
        k = nodes[b]
        if k >= 0 and words[k // _BITS] >> (k % _BITS) & 1:
            known |= 1 << b
    return known


@kernel
def _find(
    words: Ints,
    links: Ints,
    slots: Ints,
    before: Ints,
    word: int,
    bit: int,
    mixed: int,
    end: int,
    end_code: int,
) -> int:
    """Slot of the partial route over the nodes `before` and one more, its end; or a free slot."""
    slot = (mixed ^ end_code) % len(slots)
    while slots[slot] >= 0:
        known = slots[slot]
        if links[known, _HASH] == mixed and links[known, _END] == end:
            same = True
            for w in range(len(before)):
                if words[known, w] != (before[w] | bit if w == word else before[w]):
                    same = False
                    break
            if same:
                return slot
        slot += 1
        if slot == len(slots):
            slot = 0
    return slot


@kernel
def _enter_all(links: Ints, end_code: Ints, slots: Ints, count: int) -> None:
    """Fill an empty table with all partial routes, which are different."""
    for label in range(1, count):
        slot = (links[label, _HASH] ^ end_code[links[label, _END]]) % len(slots)
        while slots[slot] >= 0:
            slot += 1
            if slot == len(slots):
                slot = 0
        slots[slot] = label
