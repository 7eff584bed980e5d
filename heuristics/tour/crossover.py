"""Edge assembly crossover: children that inherit nearly all of one parent.

A child is tour A with the edges of A on chosen AB-cycles exchanged for those of tour B, and
the sub-tours that result joined to one (Y. Nagata, S. Kobayashi, "A powerful genetic
algorithm using edge assembly crossover for the traveling salesman problem", INFORMS Journal
on Computing 25, 2013, doi 10.1287/ijoc.1120.0506). The best child takes the place of A: the
one with the highest ratio of length gained to entropy lost, equation (6) there. The work is
proportional to the number of edges exchanged, not to the size of the tour.

Two ways to choose AB-cycles:

- *single*: one at random; children differ little from A;
- *block*: one at random, and every other one that touches a sub-tour which the first leaves,
  except for the largest. This finds what single cycles cannot, once the population hardly
  improves; it is a simple form of the block strategy (Y. Nagata, "New EAX crossover for
  large TSP instances", PPSN IX, 2006, doi 10.1007/11844297_38).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.ab_cycles import ab_cycles
from fiveroute.heuristics.tour.diversity import (
    EdgeCount,
    add_edge,
    count_edges,
    multiplicity,
    remove_edge,
)
from fiveroute.heuristics.tour.exchange import (
    Cycles,
    Exchange,
    Tour,
    alternate,
    apply_exchange,
    new_exchange,
    vertex_at,
)
from fiveroute.heuristics.tour.graph import Graph, edge_cost, tour_cost
from fiveroute.heuristics.tour.subtours import label_segments, segment_at, unite
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below

__all__ = ["CHILDREN", "Population", "crossover", "start_population"]

CHILDREN = 30
"""Most children of one pair of parents."""

_LEAST_LOSS = 1e-9
"""Loss of entropy that stands for none at all."""


class Population(NamedTuple):
    """Tours that breed; kernels change all of it in place.

    Parameters
    ----------
    orders
        Vertices in the order of the visits, shape (P, N).
    positions
        Position of every vertex in every tour, shape (P, N).
    lengths
        Lengths of the tours in seconds, shape (P,).
    edges
        The edges of all tours.
    """

    orders: NDArray[np.int64]
    positions: NDArray[np.int64]
    lengths: NDArray[np.float64]
    edges: EdgeCount


def start_population(graph: Graph, orders: NDArray[np.int64]) -> Population:
    """A population of copies of the given tours, shape (P, N)."""
    lengths = np.array([tour_cost(graph, order) for order in orders])
    return Population(orders.copy(), np.argsort(orders, axis=1), lengths, count_edges(orders))


@kernel
def crossover(
    graph: Graph,
    population: Population,
    a: int,
    b: int,
    block: bool,
    tolerance: float,
    state: RandomState,
) -> float:
    """Replace a tour by its best child with another one, if that is shorter.

    Parameters
    ----------
    graph
        The graph.
    population
        Changed in place.
    a, b
        Indices of the parents.
    block
        Whether to choose AB-cycles by blocks rather than single ones.
    tolerance
        Least gain in seconds that is no rounding error.
    state
        State of the random numbers; advanced.

    Returns
    -------
    float
        Length gained in seconds; 0 where no child is shorter.
    """
    tour = Tour(population.orders[a], population.positions[a])
    other = Tour(population.orders[b], population.positions[b])
    cycles = ab_cycles(tour, other, state)
    length = len(cycles.vertices)
    child, best = _room_for_child(tour, length), _room_for_child(tour, length)
    chosen = Cycles(np.empty(length, dtype=np.int64), np.zeros(len(cycles.starts), dtype=np.int64))
    scratch = np.empty(max(length, len(tour.order)), dtype=np.int64)
    best_k, best_gain, best_score = 0, 0.0, 0.0
    centres = np.arange(len(cycles.starts) - 1)
    for i in range(min(CHILDREN, len(centres))):
        j = i + below(state, len(centres) - i)
        centres[i], centres[j] = centres[j], centres[i]
        count = _copy_cycle(cycles, centres[i], chosen, 0)
        k = alternate(tour, chosen, count, child, scratch)
        if block:
            count = _add_block(tour, cycles, centres[i], child, k, chosen)
            k = alternate(tour, chosen, count, child, scratch)
        gain = _gain(graph, chosen, count)
        if gain <= tolerance:
            continue
        k, extra = unite(graph, tour, child, k, gain - tolerance)
        if k == 0:
            continue
        gain -= extra
        score = gain / max(_entropy_loss(population.edges, tour, child, k), _LEAST_LOSS)
        if score > best_score:
            best_k, best_gain, best_score = k, gain, score
            child, best = best, child
    if best_k > 0:
        _count_anew(population.edges, tour, best, best_k)
        apply_exchange(tour, best, best_k, scratch)
        population.lengths[a] -= best_gain
    return best_gain


@kernel
def _room_for_child(tour: Tour, length: int) -> Exchange:
    """Joining sub-tours adds at most two cuts for every cut of the AB-cycles."""
    return new_exchange(min(len(tour.order), 3 * length // 2))


@kernel
def _copy_cycle(cycles: Cycles, c: int, chosen: Cycles, count: int) -> int:
    """Add one cycle to the chosen ones; returns their number."""
    first = chosen.starts[count]
    end = first + cycles.starts[c + 1] - cycles.starts[c]
    chosen.vertices[first:end] = cycles.vertices[cycles.starts[c] : cycles.starts[c + 1]]
    chosen.starts[count + 1] = end
    return count + 1


@kernel
def _add_block(
    tour: Tour, cycles: Cycles, centre: int, exchange: Exchange, k: int, chosen: Cycles
) -> int:
    """Choose the cycles that touch a sub-tour left by the first; returns their number."""
    label, vertices = np.empty(k, dtype=np.int64), np.empty(k, dtype=np.int64)
    tours = label_segments(tour, exchange, k, label, vertices)
    count = 1
    if tours == 1:
        return count
    largest = np.argmax(vertices[:tours])
    for c in range(len(cycles.starts) - 1):
        if c == centre:
            continue
        for i in range(cycles.starts[c], cycles.starts[c + 1]):
            if label[segment_at(exchange, k, tour.position[cycles.vertices[i]])] != largest:
                count = _copy_cycle(cycles, c, chosen, count)
                break
    return count


@kernel
def _gain(graph: Graph, cycles: Cycles, count: int) -> float:
    """Length of the removed edges less that of the added ones."""
    gain = 0.0
    w = cycles.vertices
    for c in range(count):
        first, end = cycles.starts[c], cycles.starts[c + 1]
        for i in range(first, end, 2):
            gain += edge_cost(graph, w[i], w[i + 1])
            gain -= edge_cost(graph, w[i + 1], w[i + 2 if i + 2 < end else first])
    return gain


@kernel
def _entropy_loss(edges: EdgeCount, tour: Tour, exchange: Exchange, k: int) -> float:
    """Entropy of the population less that after an exchange in one tour."""
    loss = 0.0
    for port in range(2 * k):
        u = vertex_at(tour, exchange, port)
        if port & 1 == 0:
            c = multiplicity(edges, u, vertex_at(tour, exchange, port + 1))
            loss += edges.entropy[c] - edges.entropy[c - 1]
        if port < exchange.join[port]:
            c = multiplicity(edges, u, vertex_at(tour, exchange, exchange.join[port]))
            loss += edges.entropy[c] - edges.entropy[c + 1]
    return loss


@kernel
def _count_anew(edges: EdgeCount, tour: Tour, exchange: Exchange, k: int) -> None:
    """Count the edges of a tour as they are after an exchange."""
    for port in range(0, 2 * k, 2):
        u, v = vertex_at(tour, exchange, port), vertex_at(tour, exchange, port + 1)
        remove_edge(edges, u, v)
    for port in range(2 * k):
        if port < exchange.join[port]:
            u, v = vertex_at(tour, exchange, port), vertex_at(tour, exchange, exchange.join[port])
            add_edge(edges, u, v)
