"""Local search: Lin-Kernighan moves, and the iterated form with local kicks.

A move removes edges (t1, t2), (t3, t4), ... and adds (t2, t3), (t4, t5), ..., (t2k, t1),
every t_(2i+1) out of the neighbour list of t_2i, as long as the sum of removed minus added
edges stays positive (S. Lin, B. W. Kernighan, "An effective heuristic algorithm for the
traveling-salesman problem", Operations Research 21, 1973, doi 10.1287/opre.21.2.498). All
such moves up to five exchanged edges are searched depth first, with fewer branches the
deeper; only a move that pays is tested for leaving a single tour, and then carried out.
Nothing is ever tried out on the tour itself, intermediate stages need not be tours
(K. Helsgaun, "An effective implementation of the Lin-Kernighan traveling salesman heuristic",
European Journal of Operational Research 126, 2000, doi 10.1016/S0377-2217(99)00284-2), and so
moves that keep all directions, the only ones that asymmetric times admit, come for free.

The iterated search kicks a local optimum with a double bridge over a few dozen neighbouring
positions (D. Applegate, W. Cook, A. Rohe, "Chained Lin-Kernighan for large traveling
salesman problems", INFORMS Journal on Computing 15, 2003, doi 10.1287/ijoc.15.1.82.15157),
repairs it from the ends of the changed edges only, and takes the kick back unless the tour
is at least as short as before.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.exchange import (
    Tour,
    alternate,
    apply_exchange,
    beside,
    is_single_tour,
    place,
    sort_keys,
    vertex_at,
)
from fiveroute.heuristics.tour.graph import Graph, edge_cost
from fiveroute.heuristics.tour.random_numbers import random_below
from fiveroute.kernels import kernel

__all__ = ["Walk", "iterate", "start_walk"]

BREADTH = np.array([8, 5, 3, 2])
"""Neighbours tried for t3, t5, t7, t9."""

DEPTH = 5
"""Most edges that one move exchanges: the four above and the closing one."""

STEPS = 3
"""Length of the random walks on the neighbour lists between the edges that a kick removes."""

_RANGES = 64
_HEAD, _WAITING, _WRITTEN = 0, 1, 2


class Walk(NamedTuple):
    """A tour under iterated local search; kernels change all of it in place.

    Parameters
    ----------
    tour
        The current tour.
    accepted
        Order of the last accepted tour, shape (N,).
    queue
        Ring of the vertices whose moves must be searched, shape (N,).
    queued
        Whether a vertex is in it, shape (N,).
    written
        First position and length of the ranges where tour and accepted may differ,
        shape (R, 2).
    count
        Head of the queue, vertices in it, ranges written; shape (3,).
    excess
        Length of the tour minus length of the accepted one in seconds, shape (1,).
    scratch
        Working space, shape (N,).
    state
        State of the random numbers, shape (1,).
    """

    tour: Tour
    accepted: NDArray[np.int64]
    queue: NDArray[np.int64]
    queued: NDArray[np.bool_]
    written: NDArray[np.int64]
    count: NDArray[np.int64]
    excess: NDArray[np.float64]
    scratch: NDArray[np.int64]
    state: NDArray[np.uint64]


def start_walk(order: NDArray[np.int64], state: NDArray[np.uint64]) -> Walk:
    """A walk from a copy of any tour, with all vertices to be searched in tour order."""
    size = len(order)
    tour = Tour(order.copy(), np.empty(size, dtype=np.int64))
    place(tour)
    return Walk(
        tour,
        accepted=order.copy(),
        queue=order.copy(),
        queued=np.ones(size, dtype=np.bool_),
        written=np.zeros((_RANGES, 2), dtype=np.int64),
        count=np.array([0, size, 0]),
        excess=np.zeros(1),
        scratch=np.empty(size, dtype=np.int64),
        state=state,
    )


@kernel
def iterate(graph: Graph, walk: Walk, kicks: int, work: int, tolerance: float) -> int:
    """Improve a walk to a local optimum, then kick it and repair it again and again.

    Parameters
    ----------
    graph
        The graph.
    walk
        Changed in place. Its current tour is the best so far whenever the queue is empty.
    kicks
        Number of kicks to make.
    work
        Number of vertices to search before returning, finished or not.
    tolerance
        Least gain in seconds that is no rounding error.

    Returns
    -------
    int
        Kicks left to make; the search is finished when none is left and the queue is empty,
        and otherwise goes on from where it stopped when it is called again.
    """
    cut = np.empty(DEPTH, dtype=np.int64)
    join = np.empty(2 * DEPTH, dtype=np.int64)
    path = np.empty(2 * DEPTH, dtype=np.int64)
    while True:
        while walk.count[_WAITING] > 0:
            if work == 0:
                return kicks
            work -= 1
            vertex = _next_in_queue(walk)
            while True:
                k, gain = _find_move(graph, walk, vertex, tolerance, path, cut, join)
                if k == 0:
                    break
                walk.excess[0] -= gain
                _carry_out(walk, path, k, cut, join)
        _accept_or_restore(walk)
        if kicks == 0:
            return 0
        kicks -= 1
        _kick(graph, walk, path, cut, join)


@kernel
def _next_in_queue(walk: Walk) -> int:
    head = walk.count[_HEAD]
    vertex = walk.queue[head]
    walk.queued[vertex] = False
    walk.count[_HEAD] = head + 1 if head + 1 < len(walk.queue) else 0
    walk.count[_WAITING] -= 1
    return vertex


@kernel
def _enqueue(walk: Walk, vertex: int) -> None:
    if not walk.queued[vertex]:
        walk.queued[vertex] = True
        tail = walk.count[_HEAD] + walk.count[_WAITING]
        walk.queue[tail if tail < len(walk.queue) else tail - len(walk.queue)] = vertex
        walk.count[_WAITING] += 1


@kernel
def _find_move(
    graph: Graph,
    walk: Walk,
    base: int,
    tolerance: float,
    path: NDArray[np.int64],
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
) -> tuple[int, float]:
    """First move from t1 = `base` that pays, in `path`, `cut` and `join`; 0 edges if none."""
    tour = walk.tour
    width = graph.near.shape[1]
    last = len(tour.order) - 1
    choice = np.zeros(DEPTH + 1, dtype=np.int64)
    gain = np.zeros(DEPTH + 1)
    keys = np.empty(2 * DEPTH, dtype=np.int64)
    path[0] = base
    for side in range(2):
        path[1] = beside(tour, base, side)
        if graph.mate[base] == path[1]:
            continue
        level = 1
        choice[1] = 0
        gain[1] = edge_cost(graph, base, path[1])
        while level > 0:
            tail = path[2 * level - 1]
            j = choice[level] >> 1
            if j >= width or j >= BREADTH[level - 1]:
                level -= 1
                continue
            opened = gain[level] - graph.near_cost[tail, j]
            if opened <= tolerance:
                level -= 1
                continue
            head = graph.near[tail, j]
            end = beside(tour, head, choice[level] & 1)
            choice[level] += 1
            apart = abs(tour.position[head] - tour.position[tail])
            if apart == 1 or apart == last or graph.mate[head] == end:
                continue
            if _is_removed(path, level, head, end):
                continue
            path[2 * level], path[2 * level + 1] = head, end
            opened += edge_cost(graph, head, end)
            if end != base:
                closed = opened - edge_cost(graph, end, base)
                if closed > tolerance:
                    alternate(tour, path, level + 1, cut, join, keys)
                    if is_single_tour(join, level + 1):
                        return level + 1, closed
            if level + 1 < DEPTH:
                level += 1
                choice[level] = 0
                gain[level] = opened
    return 0, 0.0


@kernel
def _is_removed(path: NDArray[np.int64], level: int, u: int, v: int) -> bool:
    for i in range(level):
        if (path[2 * i] == u and path[2 * i + 1] == v) or (
            path[2 * i] == v and path[2 * i + 1] == u
        ):
            return True
    return False


@kernel
def _carry_out(
    walk: Walk, path: NDArray[np.int64], k: int, cut: NDArray[np.int64], join: NDArray[np.int64]
) -> None:
    """Apply an exchange, note where the tour was written, and queue the ends of its edges."""
    first, count = apply_exchange(walk.tour, cut, join, k, walk.scratch)
    r = walk.count[_WRITTEN]
    if r < len(walk.written):
        walk.written[r, 0], walk.written[r, 1] = first, count
    walk.count[_WRITTEN] = r + 1
    for i in range(2 * k):
        _enqueue(walk, path[i])


@kernel
def _accept_or_restore(walk: Walk) -> None:
    """Make the accepted tour and the current one agree again."""
    tour = walk.tour
    size = len(tour.order)
    ranges = walk.count[_WRITTEN]
    if ranges > len(walk.written):
        walk.written[0, 0], walk.written[0, 1] = 0, size
        ranges = 1
    accept = walk.excess[0] <= 0.0
    for r in range(ranges):
        p = walk.written[r, 0]
        for _ in range(walk.written[r, 1]):
            if p >= size:
                p -= size
            if accept:
                walk.accepted[p] = tour.order[p]
            else:
                tour.order[p] = walk.accepted[p]
                tour.position[tour.order[p]] = p
            p += 1
    walk.count[_WRITTEN] = 0
    walk.excess[0] = 0.0


@kernel
def _kick(
    graph: Graph,
    walk: Walk,
    path: NDArray[np.int64],
    cut: NDArray[np.int64],
    join: NDArray[np.int64],
) -> None:
    """Double bridge at four nearby edges: with segments a, b, c, d, tour a d c b."""
    tour = walk.tour
    _choose_cuts(graph, walk, cut)
    for i in range(4):
        path[2 * i], path[2 * i + 1] = vertex_at(tour, cut, 2 * i), vertex_at(tour, cut, 2 * i + 1)
        walk.excess[0] -= edge_cost(graph, path[2 * i], path[2 * i + 1])
    for i in range(4):
        opposite = (2 * i + 5) % 8
        join[2 * i], join[opposite] = opposite, 2 * i
        walk.excess[0] += edge_cost(graph, path[2 * i], path[opposite])
    _carry_out(walk, path, 4, cut, join)


@kernel
def _choose_cuts(graph: Graph, walk: Walk, cut: NDArray[np.int64]) -> None:
    """Fill in four different cuts, found by random walks on the neighbour lists."""
    order = walk.tour.order
    size, width = len(order), graph.near.shape[1]
    found = 0
    vertex = random_below(walk.state, size)
    while found < 4:
        p = walk.tour.position[vertex]
        if graph.mate[vertex] == order[p + 1 if p + 1 < size else 0]:
            p = p - 1 if p > 0 else size - 1
        new = True
        for i in range(found):
            new = new and cut[i] != p
        if new:
            cut[found] = p
            found += 1
        elif random_below(walk.state, 8) == 0:
            vertex = random_below(walk.state, size)
        for _ in range(STEPS):
            vertex = graph.near[vertex, random_below(walk.state, width)]
    sort_keys(cut[:4])
