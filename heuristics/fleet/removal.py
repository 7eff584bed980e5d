"""Removal of strings: short pieces of neighbouring routes.

Slack is induced where several routes pass close to each other, so that what is put back
can go another way (J. Christiaens and G. Vanden Berghe, "Slack induction by string
removals for vehicle routing problems", Transportation Science 54(2), 2020, doi
10.1287/trsc.2019.0914, section 5.1). Around a random seed node, routes are met in order
of distance, and each of them loses one string with the node that is met. Half of the time
the string keeps a few of its inner nodes ("split string"). Now and then one long string
goes instead, up to a whole route: an AUV is sent to another region by no smaller change.
"""

from __future__ import annotations

import numpy as np

from fiveroute.heuristics.fleet.chains import NEXT, PREVIOUS, ROUTE, take_out
from fiveroute.heuristics.fleet.network import Floats, Ints
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below, uniform

__all__ = ["remove_strings"]

LONGEST_STRING = 10
"""Most nodes in one string, as published."""

MEAN_REMOVED = 10.0
"""Mean number of nodes removed, as published."""

MEAN_IN_LONG = 1.0
"""Mean number of nodes that long strings remove, over all trials."""

SHORT_ROUTE = 30.0
"""Mean number of nodes on a route below which long strings get no more frequent."""


@kernel
def remove_strings(
    leg: Floats,
    near: Ints,
    stops: Ints,
    time: Floats,
    idle: Ints,
    log: Ints,
    seed: int,
    state: RandomState,
) -> None:
    """Take strings of routes around the node `seed` out."""
    fleet_size = len(time)
    size = len(stops) - 2 * fleet_size
    mean_length = (size - idle[0]) / fleet_size
    if uniform(state) < MEAN_IN_LONG / max(SHORT_ROUTE, mean_length):
        node = seed
        if stops[node, ROUTE] < 0:
            node = stops[size + below(state, fleet_size), NEXT]
        _remove_string(
            leg, stops, time, idle, log, node, 1 + below(state, 2.0 * mean_length), state
        )
        return
    longest = max(1.0, min(float(LONGEST_STRING), mean_length))
    strings = 1 + below(state, 4.0 * MEAN_REMOVED / (1.0 + longest) - 1.0)
    hit = np.zeros(fleet_size, np.bool_)
    for rank in range(-1, near.shape[1]):
        node = seed if rank < 0 else near[seed, rank]
        auv = stops[node, ROUTE]
        if node >= size or auv < 0 or hit[auv]:
            continue
        hit[auv] = True
        length = 1 + below(state, longest)
        _remove_string(leg, stops, time, idle, log, node, length, state)
        strings -= 1
        if strings == 0:
            return


@kernel
def _remove_string(
    leg: Floats,
    stops: Ints,
    time: Floats,
    idle: Ints,
    log: Ints,
    node: int,
    length: int,
    state: RandomState,
) -> None:
    """Take out `length` nodes of a route, `node` or a kept node beside it among them."""
    size = len(stops) - 2 * len(time)
    for _ in range(below(state, length)):
        if stops[node, PREVIOUS] >= size:
            break
        node = stops[node, PREVIOUS]
    keep_from, keep_to = length, length
    if length > 1 and uniform(state) < 0.5:
        keep_from = 1 + below(state, length - 1)
        keep_to = keep_from + 1
        while uniform(state) < 0.5:
            keep_to += 1
        length += keep_to - keep_from
    for step in range(length):
        if node >= size:
            return
        behind = stops[node, NEXT]
        if not keep_from <= step < keep_to:
            take_out(leg, stops, time, idle, log, node)
        node = behind
