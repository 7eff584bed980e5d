"""Connectivity cuts by maximum flow.

Every route comes from the start, so a set S of vertices without the start must be entered as
often as any vertex k in it is visited:

    sum over (i, j) with i not in S, j in S of x_ij >= y_k,   k in S.

The left side is least over all S around k when it equals the maximum flow from the start to k in
the graph with capacities x (Ford and Fulkerson): a fractional point violates some such row
for k exactly where that flow stays below y_k. The two minimum cuts nearest to k and nearest to
the start give the two sets that are returned.

The flow is Dinic's, on real-valued capacities: an arc with less than 1e-9 left counts as full,
which can only miss a cut, never make one up, because the rows are valid for every S.

References
----------
M. Padberg and G. Rinaldi, "An efficient algorithm for the minimum capacity cut problem",
Mathematical Programming 47 (1990), doi 10.1007/BF01580850.
M. Fischetti, J. J. Salazar González and P. Toth, "Solving the orienteering problem through
branch-and-cut", INFORMS Journal on Computing 10 (1998), doi 10.1287/ijoc.10.2.133.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["violated_sets"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_FULL = 1e-9  # residual capacity that counts as none


def violated_sets(
    tails: Integers,
    heads: Integers,
    values: Floats,
    demand: Floats,
    *,
    source: int = 0,
    tolerance: float = 1e-4,
    most: int = 200,
) -> Booleans:
    """Vertex sets that the arc values enter less often than some vertex in them demands.

    Parameters
    ----------
    tails, heads
        Arcs of the support graph, shape (m,); for undirected edges give both directions.
    values
        Arc values x_ij, shape (m,).
    demand
        Visits y_k demanded of every vertex, shape (v,); zero where nothing is.
    source
        Vertex from which all routes come.
    tolerance
        Least violation worth a row.
    most
        Number of sets after which to stop looking.

    Returns
    -------
    Booleans
        Membership of every set, shape (c, v); none twice, none with the source.
    """
    if max(tails.max(initial=0), heads.max(initial=0)) >= len(demand):
        raise ValueError("every vertex needs a demand; give 0 to those without")
    used = values > _FULL
    found = _search(
        np.ascontiguousarray(tails[used], dtype=np.int64),
        np.ascontiguousarray(heads[used], dtype=np.int64),
        np.ascontiguousarray(values[used], dtype=np.float64),
        np.array(demand, dtype=np.float64),
        np.argsort(-demand, kind="stable"),
        source,
        tolerance,
        most,
    )
    distinct = {members.tobytes(): k for k, members in enumerate(np.packbits(found, axis=1))}
    return found[list(distinct.values())]


@kernel
def _search(
    tails: Integers,
    heads: Integers,
    values: Floats,
    demand: Floats,
    sinks: Integers,
    source: int,
    tolerance: float,
    most: int,
) -> Booleans:
    """One flow for every vertex with demand that lies in no set found before."""
    size = len(demand)
    ends, following, first = _residual_graph(tails, heads, size)
    room = np.empty(len(ends))
    sets = np.zeros((most, size), np.bool_)
    covered = np.zeros(size, np.bool_)
    covered[source] = True
    count = 0
    for sink in sinks:
        if demand[sink] <= tolerance or count + 2 > most:
            break
        if covered[sink]:
            continue
        room[0::2] = values
        room[1::2] = 0.0
        flow = _max_flow(source, sink, demand[sink], ends, following, first, room)
        if flow >= demand[sink] - tolerance:
            continue
        _levels(source, -1, ends, following, first, room, False, sets[count])
        sets[count] = ~sets[count]
        _levels(sink, -1, ends, following, first, room, True, sets[count + 1])
        covered |= sets[count + 1]
        count += 2
    return sets[:count]


@kernel
def _residual_graph(
    tails: Integers, heads: Integers, size: int
) -> tuple[Integers, Integers, Integers]:
    """Arc 2e runs from tails[e] to heads[e], arc 2e + 1 back; linked lists by tail."""
    arcs = 2 * len(tails)
    ends = np.empty(arcs, np.int64)
    following = np.empty(arcs, np.int64)
    first = np.full(size, -1, np.int64)
    for arc in range(arcs):
        tail, head = tails[arc // 2], heads[arc // 2]
        if arc % 2:
            tail, head = head, tail
        ends[arc] = head
        following[arc] = first[tail]
        first[tail] = arc
    return ends, following, first


@kernel
def _levels(
    origin: int,
    goal: int,
    ends: Integers,
    following: Integers,
    first: Integers,
    room: Floats,
    backwards: bool,
    seen: Booleans,
) -> Integers:
    """Breadth-first distances over arcs with room, -1 beyond reach; fills `seen`."""
    level = np.full(len(first), -1, np.int64)
    queue = np.empty(len(first), np.int64)
    queue[0] = origin
    level[origin] = 0
    head, tail = 0, 1
    while head < tail and (goal < 0 or level[goal] < 0):
        vertex = queue[head]
        head += 1
        arc = first[vertex]
        while arc >= 0:
            other = ends[arc]
            if level[other] < 0 and room[arc ^ 1 if backwards else arc] > _FULL:
                level[other] = level[vertex] + 1
                queue[tail] = other
                tail += 1
            arc = following[arc]
    seen[:] = level >= 0
    return level


@kernel
def _max_flow(
    source: int,
    sink: int,
    enough: float,
    ends: Integers,
    following: Integers,
    first: Integers,
    room: Floats,
) -> float:
    """Flow from source to sink, stopped once there is enough; leaves the residual `room`."""
    seen = np.empty(len(first), np.bool_)
    path = np.empty(len(first), np.int64)
    total = 0.0
    while total < enough:
        level = _levels(source, sink, ends, following, first, room, False, seen)
        if level[sink] < 0:
            break
        current = first.copy()
        vertex, depth = source, 0
        while total < enough:
            if vertex == sink:
                least = np.inf
                for k in range(depth):
                    least = min(least, room[path[k]])
                for k in range(depth):
                    room[path[k]] -= least
                    room[path[k] ^ 1] += least
                total += least
                vertex, depth = source, 0
                continue
            arc = current[vertex]
            while arc >= 0 and not (room[arc] > _FULL and level[ends[arc]] == level[vertex] + 1):
                arc = following[arc]
            current[vertex] = arc
            if arc >= 0:
                path[depth] = arc
                depth += 1
                vertex = ends[arc]
            elif depth == 0:
                break
            else:  # a dead end: no later path passes here
                level[vertex] = -1
                depth -= 1
                vertex = ends[path[depth] ^ 1]
    return total
