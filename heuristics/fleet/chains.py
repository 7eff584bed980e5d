"""The routes as doubly linked chains of stops, and a journal that takes changes back.

`stops` is a table of one row a stop: the stop behind it, the stop before it, its AUV (-1
for a node on no route), and for a node on no route its place in `idle`. Its rows lie next
to each other in memory, so that one look at a node brings all that is known of it. `idle`
lists the nodes on no route behind their number, idle[0]. `log` is the journal: log[0, 0]
entries, each a node and the stop that it was taken from behind, or -1 where it was put
in. Every change goes through `put_in` and `take_out`, which makes trying cheap: a trial
that is not worth keeping is undone in as many steps as it had changes, whatever the size
of the problem.

Kernels are handed plain arrays, not the tuple that holds them: taking an array out of a
tuple counts a reference, which costs more than a change does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fiveroute.heuristics.fleet.network import Floats, Ints, Network, Trail
from fiveroute.kernels import kernel

__all__ = [
    "NEXT",
    "PLACE",
    "PREVIOUS",
    "ROUTE",
    "Chains",
    "build_chains",
    "duration",
    "measure",
    "put_in",
    "take_out",
    "trails_of",
    "undo",
]

NEXT, PREVIOUS, ROUTE, PLACE = 0, 1, 2, 3
"""Columns of `stops`."""


class Chains(NamedTuple):
    """The routes of a fleet.

    Parameters
    ----------
    stops
        The table of stops, shape (K, 4).
    time
        Duration of every route in seconds, shape (M,).
    idle
        Number of nodes on no route, and behind it these nodes, shape (k + 1,).
    log
        The journal, shape (entries, 2).
    """

    stops: Ints
    time: Floats
    idle: Ints
    log: Ints


def build_chains(network: Network, trails: Sequence[Trail]) -> Chains:
    """Chains that follow a trail for every AUV."""
    size, fleet_size = len(network.nodes), len(network.limit)
    starts = size + np.arange(fleet_size)
    stops = np.full((len(network.leg), 4), -1)
    stops[:size, PLACE] = np.arange(1, size + 1)
    for row in (starts, starts + fleet_size):
        stops[row, NEXT] = starts + fleet_size
        stops[row, PREVIOUS] = starts
        stops[row, ROUTE] = np.arange(fleet_size)
    chains = Chains(
        stops,
        network.leg[starts, starts + fleet_size],
        np.arange(-1, size),
        np.zeros((4 * size + 2, 2), np.int64),
    )
    chains.idle[0] = size
    for start, trail in zip(starts, trails, strict=True):
        last = int(start)
        for node in trail:
            put_in(network.leg, *chains, node, last)
            last = node
    chains.log[0, 0] = 0
    return chains


def trails_of(network: Network, behind: Ints) -> list[Trail]:
    """The trail of every AUV, where behind[stop] is the stop behind every stop."""
    size, fleet_size = len(network.nodes), len(network.limit)
    following = behind.tolist()
    trails: list[Trail] = []
    for start in range(size, size + fleet_size):
        trail: list[int] = []
        stop = following[start]
        while stop < size:
            trail.append(stop)
            stop = following[stop]
        trails.append(tuple(trail))
    return trails


@kernel
def put_in(
    leg: Floats, stops: Ints, time: Floats, idle: Ints, log: Ints, node: int, at: int
) -> None:
    """Put an idle node in behind stop `at`, and note it down."""
    _link(leg, stops, time, idle, node, at)
    entry = log[0, 0] + 1
    log[0, 0] = entry
    log[entry, 0] = node
    log[entry, 1] = -1


@kernel
def take_out(leg: Floats, stops: Ints, time: Floats, idle: Ints, log: Ints, node: int) -> None:
    """Take a node out of its route, and note it down."""
    entry = log[0, 0] + 1
    log[0, 0] = entry
    log[entry, 0] = node
    log[entry, 1] = stops[node, PREVIOUS]
    _unlink(leg, stops, time, idle, node)


@kernel
def undo(leg: Floats, stops: Ints, time: Floats, idle: Ints, log: Ints) -> None:
    """Take all changes in the journal back, the last one first."""
    for entry in range(log[0, 0], 0, -1):
        node, at = log[entry]
        if at < 0:
            _unlink(leg, stops, time, idle, node)
        else:
            _link(leg, stops, time, idle, node, at)
    log[0, 0] = 0


@kernel
def measure(leg: Floats, stops: Ints, time: Floats) -> None:
    """Add all durations up afresh, so that rounding errors do not gather."""
    fleet_size = len(time)
    size = len(stops) - 2 * fleet_size
    for auv in range(fleet_size):
        total = 0.0
        stop = size + auv
        while stop != size + fleet_size + auv:
            behind = stops[stop, NEXT]
            total += leg[stop, behind]
            stop = behind
        time[auv] = total


@kernel
def duration(leg: Floats, start: int, end: int, trail: Ints) -> float:
    """Duration of a route."""
    time: float = leg[start, trail[0]] if len(trail) else leg[start, end]
    for step in range(len(trail)):
        time += leg[trail[step], trail[step + 1] if step + 1 < len(trail) else end]
    return time


@kernel
def _link(leg: Floats, stops: Ints, time: Floats, idle: Ints, node: int, at: int) -> None:
    behind, auv = stops[at, NEXT], stops[at, ROUTE]
    stops[at, NEXT] = stops[behind, PREVIOUS] = node
    place = stops[node, PLACE]
    stops[node, NEXT] = behind
    stops[node, PREVIOUS] = at
    stops[node, ROUTE] = auv
    time[auv] += leg[at, node] + leg[node, behind] - leg[at, behind]
    count = idle[0]
    last = idle[count]
    idle[place] = last
    stops[last, PLACE] = place
    idle[0] = count - 1


@kernel
def _unlink(leg: Floats, stops: Ints, time: Floats, idle: Ints, node: int) -> None:
    behind, before, auv = stops[node, NEXT], stops[node, PREVIOUS], stops[node, ROUTE]
    stops[before, NEXT] = behind
    stops[behind, PREVIOUS] = before
    stops[node, ROUTE] = -1
    time[auv] -= leg[before, node] + leg[node, behind] - leg[before, behind]
    count = idle[0] + 1
    idle[0] = count
    idle[count] = node
    stops[node, PLACE] = count
