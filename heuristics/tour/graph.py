"""The giant-route problem as a symmetric travelling salesman problem with fixed edges.

A route from start to destination becomes a tour by an edge from the destination back to
the start that every tour contains and no move removes. Such a *fixed* edge needs no
artificial cost, so nothing is lost to rounding.

- Symmetric times: vertex v of the tour is vertex v of the problem, 0 to n + 1, and the one
  fixed edge joins 0 and n + 1.
- Asymmetric times (R. Jonker, T. Volgenant, "Transforming asymmetric into symmetric
  traveling salesman problems", Operations Research Letters 2, 1983,
  doi 10.1016/0167-6377(83)90048-2): vertex v is left at its *exit*, v, and reached at its
  *entry*, n + v. Exits are 0 to n, entries n + 1 to 2 n + 1. A leg joins an exit and an
  entry, a fixed edge joins entry and exit of each sensor node, and one more the entry of the
  destination, 2 n + 1, and the exit of the start, 0. All other edges are infinitely long.

Both cases read the problem's own travel times; no larger matrix is ever built.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.limits import Clock
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route

__all__ = ["NEIGHBOURS", "Graph", "edge_cost", "giant_graph", "route_of", "tour_cost"]

NEIGHBOURS = 10
"""Length of the neighbour lists."""

_ROWS_AT_ONCE = 1 << 26
"""Matrix entries that one call of the neighbour kernel looks at: well under 0.2 s."""


class Graph(NamedTuple):
    """A complete graph with fixed edges, in the form that kernels take.

    Parameters
    ----------
    travel
        The problem's leg times in seconds, shape (n + 2, n + 2).
    exits
        Number of exit vertices, n + 1; 0 for symmetric times.
    mate
        Other end of the fixed edge at every vertex, shape (N,); -1 where there is none.
    near
        Nearest neighbours of every vertex, nearest first, without its mate, shape (N, K).
    near_cost
        Their distances in seconds, shape (N, K).
    """

    travel: NDArray[np.float64]
    exits: int
    mate: NDArray[np.int64]
    near: NDArray[np.int64]
    near_cost: NDArray[np.float64]

    @property
    def size(self) -> int:
        """Number N of vertices."""
        return len(self.mate)

    @property
    def nodes(self) -> int:
        """Number n of sensor nodes."""
        return len(self.travel) - 2


@kernel
def edge_cost(graph: Graph, u: int, v: int) -> float:
    """Cost in seconds of the edge between two different vertices, in any order."""
    cost: float = np.inf
    if graph.exits == 0:
        cost = graph.travel[u, v]
        return cost
    if u >= graph.exits:
        u, v = v, u
    if u >= graph.exits or v < graph.exits:
        return cost
    cost = graph.travel[u, v - graph.exits + 1]
    return cost


@kernel
def tour_cost(graph: Graph, order: NDArray[np.int64]) -> float:
    """Length in seconds of a closed tour, fixed edges included."""
    total = edge_cost(graph, order[-1], order[0])
    for i in range(len(order) - 1):
        total += edge_cost(graph, order[i], order[i + 1])
    return total


def giant_graph(problem: TeamOrienteering, clock: Clock) -> Graph | None:
    """Graph whose shortest tour is the giant route; None where the clock expires first."""
    n = problem.n
    if problem.is_symmetric:
        exits = 0
        mate = np.full(n + 2, -1)
        mate[[0, n + 1]] = n + 1, 0
    else:
        exits = n + 1
        mate = np.concatenate(([2 * n + 1], np.arange(n + 1, 2 * n + 1), np.arange(1, n + 1), [0]))
    near = np.empty((len(mate), min(NEIGHBOURS, n)), dtype=np.int64)
    graph = Graph(problem.travel, exits, mate, near, np.empty(near.shape))
    step = max(_ROWS_AT_ONCE // len(mate), 1)
    for first in range(0, len(mate), step):
        if clock.expired:
            return None
        _fill_neighbours(graph, first, min(first + step, len(mate)))
    return graph


@kernel
def _fill_neighbours(graph: Graph, first: int, last: int) -> None:
    """Fill the lists of vertices `first` to `last` - 1, ties by vertex number."""
    size, width = len(graph.mate), graph.near.shape[1]
    for u in range(first, last):
        near, cost = graph.near[u], graph.near_cost[u]
        found = 0
        for v in range(size):
            if v == u or v == graph.mate[u]:
                continue
            c = edge_cost(graph, u, v)
            if c == np.inf or (found == width and c >= cost[width - 1]):
                continue
            j = min(found, width - 1)
            while j > 0 and cost[j - 1] > c:
                near[j], cost[j] = near[j - 1], cost[j - 1]
                j -= 1
            near[j], cost[j] = v, c
            found = min(found + 1, width)


def route_of(graph: Graph, order: NDArray[np.int64]) -> Route:
    """The route that a tour stands for: its sensor nodes from start to destination."""
    at = int(np.flatnonzero(order == 0)[0])
    route = np.roll(order, -at)
    if route[1] == graph.mate[0]:
        route = np.roll(route[::-1], 1)
    if graph.exits:
        route = route[route < graph.exits]
        return tuple(route[1:].tolist())
    return tuple(route[1:-1].tolist())
