"""Greedy insertion with blinks: idle nodes, the most promising first, where they cost least.

The order is by profit to a random power, disturbed: an exponent near 0 lets nodes come as
chance has it, a large one puts rich nodes first. By profit per second the nodes beside the
routes come first and use up the time that a region further off would need, and the search
keeps its shape; where many nodes are worth the same, nothing else tells them apart. So cost
has a say on some islands only, and there in half of the trials: `greed` is the largest
power of it by which the weights are divided. A place is looked
for beside the nearest stops on routes only, and now and then passed over (a "blink") as
in Christiaens and Vanden Berghe (2020, doi 10.1287/trsc.2019.0914, section 5.2).
"""

from __future__ import annotations

import numpy as np

from fiveroute.heuristics.fleet.chains import NEXT, PREVIOUS, ROUTE, put_in
from fiveroute.heuristics.fleet.network import Floats, Ints
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, uniform

__all__ = ["cheapest_place", "insert_nodes", "sort_descending"]

FEW_NODES, FEW_IDLE = 150, 30
"""Up to so many nodes in all, or on no route, all idle ones are tried; beyond, those in the
region."""

REGION = 24
"""Near stops of a removed node among which further nodes to try are looked for."""

PLACES = 12
"""Number of nearest nodes on routes beside which a place is looked for."""

BLINK = 0.01
"""Probability of passing a place over, as published."""

SKIP = 0.05
"""Probability of passing a node over."""

LEAST_COST = 1e-3
"""Least cost that counts, as a share of the longest limit shared out among all nodes."""

NOISE = 0.2
"""Largest relative disturbance of the order."""


@kernel
def insert_nodes(
    leg: Floats,
    back: Floats,
    near: Ints,
    limit: Floats,
    profit: Floats,
    weight: Floats,
    stops: Ints,
    time: Floats,
    idle: Ints,
    log: Ints,
    seed: int,
    mark: Ints,
    greed: float,
    state: RandomState,
) -> None:
    """Put idle nodes in, in the order of their disturbed weights, as far as time allows."""
    items = np.empty(idle[0], np.int64)
    count = _choose(near, stops, idle, log, seed, mark, items, state)
    keys = np.empty(count)
    power = greed * (2.0 * uniform(state) - 1.0) if greed > 0.0 else 0.0
    floor = max(LEAST_COST * limit.max() / len(profit), 1e-12)
    left = 0
    for rank in range(count):
        node = items[rank]
        key = weight[node] * (1.0 + NOISE * (2.0 * uniform(state) - 1.0))
        if power > 0.0:
            at, cost = cheapest_place(
                leg, back, near, limit, stops, time, node, np.inf, BLINK, state
            )
            if at < 0:
                continue
            key /= max(cost, floor) ** power
        items[left], keys[left] = node, key
        left += 1
    count = left
    sort_descending(keys, items, count)
    for rank in range(count):
        node = items[rank]
        ceiling = np.inf if profit[node] > 0.0 else 0.0  # no data: only to save time
        at, _ = cheapest_place(leg, back, near, limit, stops, time, node, ceiling, BLINK, state)
        if at >= 0:
            put_in(leg, stops, time, idle, log, node, at)


@kernel
def cheapest_place(
    leg: Floats,
    back: Floats,
    near: Ints,
    limit: Floats,
    stops: Ints,
    time: Floats,
    node: int,
    ceiling: float,
    blink: float,
    state: RandomState,
) -> tuple[int, float]:
    """The stop behind which the node costs least, less than `ceiling`, and the cost; -1 if none."""
    fleet_size = len(limit)
    size = len(stops) - 2 * fleet_size
    best, place = ceiling, -1
    for auv in range(fleet_size):
        start, end = size + auv, size + fleet_size + auv
        if stops[start, NEXT] == end:
            cost = leg[start, node] + leg[node, end] - leg[start, end]
            if cost < best and cost <= limit[auv] - time[auv]:
                best, place = cost, start
    places = 0
    for stop in near[node]:
        auv = stops[stop, ROUTE]
        if auv < 0:
            continue
        slack = limit[auv] - time[auv]
        before, behind = stops[stop, PREVIOUS], stops[stop, NEXT]
        cost = back[node, stop] + leg[node, behind] - leg[stop, behind]
        if cost < best and cost <= slack and uniform(state) >= blink:
            best, place = cost, stop
        cost = back[node, before] + leg[node, stop] - leg[before, stop]
        if cost < best and cost <= slack and uniform(state) >= blink:
            best, place = cost, before
        if stop < size:
            places += 1
            if places == PLACES:
                break
    return place, best


@kernel
def sort_descending(keys: Floats, items: Ints, count: int) -> None:
    """Sort the first `count` items by their keys, in place (Shell sort)."""
    gap = 1
    while gap < count // 3:
        gap = 3 * gap + 1
    while gap > 0:
        for rank in range(gap, count):
            key, item = keys[rank], items[rank]
            hole = rank
            while hole >= gap and keys[hole - gap] < key:
                keys[hole], items[hole] = keys[hole - gap], items[hole - gap]
                hole -= gap
            keys[hole], items[hole] = key, item
        gap //= 3


@kernel
def _choose(
    near: Ints,
    stops: Ints,
    idle: Ints,
    log: Ints,
    seed: int,
    mark: Ints,
    items: Ints,
    state: RandomState,
) -> int:
    """Fill `items` with the idle nodes to try: all, or those around what was removed."""
    count = 0
    if len(near) <= FEW_NODES or idle[0] <= FEW_IDLE:
        for node in idle[1 : idle[0] + 1]:
            if uniform(state) >= SKIP:
                items[count] = node
                count += 1
        return count
    size = len(near)
    mark[size] += 1
    for entry in range(log[0, 0] + 1):
        centre = log[entry, 0] if entry > 0 else seed
        for rank in range(-1, min(REGION, near.shape[1])):
            node = centre if rank < 0 else near[centre, rank]
            if node >= size or stops[node, ROUTE] >= 0 or mark[node] == mark[size]:
                continue
            mark[node] = mark[size]
            if uniform(state) >= SKIP:
                items[count] = node
                count += 1
    return count
