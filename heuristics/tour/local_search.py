"""Local search with Lin-Kernighan moves.

A move removes edges (t1, t2), (t3, t4), ... and adds (t2, t3), (t4, t5), ..., (t2k, t1),
every t_(2i+1) out of the neighbour list of t_2i, as long as the sum of removed minus added
edges stays positive (S. Lin, B. W. Kernighan, "An effective heuristic algorithm for the
traveling-salesman problem", Operations Research 21, 1973, doi 10.1287/opre.21.2.498). All
such moves of a few exchanged edges are searched depth first, with fewer branches the deeper;
only a move that pays is tested for leaving a single tour, and then carried out. Nothing is
ever tried out on the tour itself, and intermediate stages need not be tours (K. Helsgaun,
"An effective implementation of the Lin-Kernighan traveling salesman heuristic", European
Journal of Operational Research 126, 2000, doi 10.1016/S0377-2217(99)00284-2). So the moves
that keep all directions, the only ones that asymmetric times admit, need no case of their
own.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.exchange import (
    Cycles,
    Exchange,
    Tour,
    alternate,
    apply_exchange,
    beside,
    is_single_tour,
    new_exchange,
)
from fiveroute.heuristics.tour.graph import Graph, edge_cost
from fiveroute.kernels import kernel

__all__ = ["LocalSearch", "improve", "start_search"]

BREADTH = np.array([10, 5, 3, 2, 1])
"""Neighbours tried for t3, t5, t7, t9, t11."""

DEPTH = 6
"""Most edges that one move exchanges."""

_HEAD, _WAITING = 0, 1


class LocalSearch(NamedTuple):
    """A tour under local search; kernels change all of it in place.

    Parameters
    ----------
    tour
        The current tour.
    queue
        Ring of the vertices whose moves must still be searched, shape (N,).
    queued
        Whether a vertex is in it, shape (N,).
    ring
        Index of the head of the queue, and number of vertices in it.
    """

    tour: Tour
    queue: NDArray[np.int64]
    queued: NDArray[np.bool_]
    ring: NDArray[np.int64]


def start_search(order: NDArray[np.int64]) -> LocalSearch:
    """A search from a copy of any tour, all vertices queued in tour order."""
    size = len(order)
    tour = Tour(order.copy(), np.argsort(order))
    return LocalSearch(tour, order.copy(), np.ones(size, dtype=np.bool_), np.array([0, size]))


@kernel
def improve(graph: Graph, search: LocalSearch, work: int, tolerance: float) -> bool:
    """Improve a tour until no move from any vertex pays, or the work is done.

    Parameters
    ----------
    graph
        The graph.
    search
        Changed in place.
    work
        Number of vertices to take from the queue.
    tolerance
        Least gain in seconds that is no rounding error.

    Returns
    -------
    bool
        Whether a local optimum is reached; otherwise call again.
    """
    exchange = new_exchange(DEPTH)
    path = Cycles(np.empty(2 * DEPTH, dtype=np.int64), np.zeros(2, dtype=np.int64))
    scratch = np.empty(len(search.queue) + 2 * DEPTH, dtype=np.int64)
    for _ in range(work):
        if search.ring[_WAITING] == 0:
            return True
        vertex = _next_in_queue(search)
        while True:
            k = _find_move(graph, search.tour, vertex, tolerance, path, exchange, scratch)
            if k == 0:
                break
            apply_exchange(search.tour, exchange, k, scratch)
            for i in range(2 * k):
                _enqueue(search, path.vertices[i])
    return bool(search.ring[_WAITING] == 0)


@kernel
def _next_in_queue(search: LocalSearch) -> int:
    head = search.ring[_HEAD]
    vertex: int = search.queue[head]
    search.queued[vertex] = False
    search.ring[_HEAD] = head + 1 if head + 1 < len(search.queue) else 0
    search.ring[_WAITING] -= 1
    return vertex


@kernel
def _enqueue(search: LocalSearch, vertex: int) -> None:
    if not search.queued[vertex]:
        search.queued[vertex] = True
        tail = search.ring[_HEAD] + search.ring[_WAITING]
        search.queue[tail if tail < len(search.queue) else tail - len(search.queue)] = vertex
        search.ring[_WAITING] += 1


@kernel
def _find_move(
    graph: Graph,
    tour: Tour,
    base: int,
    tolerance: float,
    path: Cycles,
    exchange: Exchange,
    scratch: NDArray[np.int64],
) -> int:
    """Find the first move from t1 = `base` that pays.

    Fills `path` with t1, t2, ... and `exchange` with the move; returns its number of edges,
    0 where there is none.
    """
    t = path.vertices
    width = graph.near.shape[1]
    last = len(tour.order) - 1
    choice = np.zeros(DEPTH, dtype=np.int64)  # next neighbour and side to try at each level
    gain = np.zeros(DEPTH)  # removed less added edges at each level
    t[0] = base
    for side in range(2):
        t[1] = beside(tour, base, side)
        if graph.mate[base] == t[1]:
            continue
        level = 1
        choice[1], gain[1] = 0, edge_cost(graph, base, t[1])
        while level > 0:
            tail = t[2 * level - 1]
            j = choice[level] >> 1
            if (
                j >= min(width, BREADTH[level - 1])
                or gain[level] - graph.near_cost[tail, j] <= tolerance
            ):
                level -= 1
                continue
            head = graph.near[tail, j]
            end = beside(tour, head, choice[level] & 1)
            choice[level] += 1
            apart = abs(tour.position[head] - tour.position[tail])
            if apart == 1 or apart == last or _is_kept(graph, t, level, head, end):
                continue
            t[2 * level], t[2 * level + 1] = head, end
            opened = gain[level] - graph.near_cost[tail, j] + edge_cost(graph, head, end)
            if end != base and opened - edge_cost(graph, end, base) > tolerance:
                path.starts[1] = 2 * level + 2
                k = alternate(tour, path, 1, exchange, scratch)
                if is_single_tour(exchange, k):
                    return k
            if level + 1 < DEPTH:
                level += 1
                choice[level], gain[level] = 0, opened
    return 0


@kernel
def _is_kept(graph: Graph, t: NDArray[np.int64], level: int, head: int, end: int) -> bool:
    """Whether a tour edge is fixed, or one of the `level` edges removed already."""
    if graph.mate[head] == end:
        return True
    for i in range(0, 2 * level, 2):
        if (t[i] == head and t[i + 1] == end) or (t[i] == end and t[i + 1] == head):
            return True
    return False
