"""Edge assembly crossover: children that inherit nearly all of one parent.

Localised EAX with single AB-cycles (Y. Nagata, S. Kobayashi, "A powerful genetic algorithm
using edge assembly crossover for the traveling salesman problem", INFORMS Journal on
Computing 25, 2013, doi 10.1287/ijoc.1120.0506). A child is parent A with the edges of one
AB-cycle exchanged and the sub-tours joined. Of all children the one with the best ratio of
length gained to entropy lost takes the place of A.
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
from fiveroute.heuristics.tour.exchange import Tour, alternate, apply_exchange, vertex_at
from fiveroute.heuristics.tour.graph import Graph, edge_cost, tour_cost
from fiveroute.heuristics.tour.random_numbers import random_below
from fiveroute.heuristics.tour.subtours import unite
from fiveroute.kernels import kernel

__all__ = ["Population", "crossover", "start_population"]

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
    """A population of the given tours, shape (P, N), which it owns from now on."""
    lengths = np.array([tour_cost(graph, order) for order in orders])
    return Population(orders, np.argsort(orders, axis=1), lengths, count_edges(orders))


@kernel
def crossover(
    graph: Graph,
    population: Population,
    mother: int,
    father: int,
    children: int,
    tolerance: float,
    state: NDArray[np.uint64],
) -> float:
    """Replace a tour by its best child with another one.

    Parameters
    ----------
    graph
        The graph.
    population
        Changed in place.
    mother
        Index of the tour to improve, parent A.
    father
        Index of the tour that lends its edges, parent B.
    children
        Most children to look at.
    tolerance
        Least gain in seconds that is no rounding error.
    state
        State of the random numbers; advanced.

    Returns
    -------
    float
        Length gained in seconds; 0 where no child is shorter.
    """
    tour = Tour(population.orders[mother], population.positions[mother])
    other = Tour(population.orders[father], population.positions[father])
    vertices, starts = ab_cycles(tour, other, state)
    size = len(tour.order)
    cut, best_cut = np.empty(size, dtype=np.int64), np.empty(size, dtype=np.int64)
    join, best_join = np.empty(2 * size, dtype=np.int64), np.empty(2 * size, dtype=np.int64)
    scratch = np.empty(2 * size, dtype=np.int64)
    best_k, best_gain, best_score = 0, 0.0, 0.0
    left = len(starts) - 1
    chosen = np.arange(left)
    for _ in range(min(children, left)):
        i = random_below(state, left)
        c = chosen[i]
        left -= 1
        chosen[i] = chosen[left]
        cycle = vertices[starts[c] : starts[c + 1]]
        gain = _exchange_gain(graph, cycle)
        if gain <= tolerance:
            continue
        k = len(cycle) // 2
        alternate(tour, cycle, k, cut, join, scratch)
        k, extra = unite(graph, tour, cut, join, k, gain - tolerance)
        if k == 0:
            continue
        gain -= extra
        loss = _entropy_loss(population.edges, tour, cut, join, k)
        score = gain / max(loss, _LEAST_LOSS)
        if score > best_score:
            best_k, best_gain, best_score = k, gain, score
            cut, best_cut = best_cut, cut
            join, best_join = best_join, join
    if best_k > 0:
        _count_exchange(population.edges, tour, best_cut, best_join, best_k)
        apply_exchange(tour, best_cut, best_join, best_k, scratch)
        population.lengths[mother] -= best_gain
    return best_gain


@kernel
def _exchange_gain(graph: Graph, cycle: NDArray[np.int64]) -> float:
    """Length of the edges of A less that of the edges of B."""
    gain = 0.0
    last = len(cycle) - 1
    for i in range(0, last, 2):
        gain += edge_cost(graph, cycle[i], cycle[i + 1])
        gain -= edge_cost(graph, cycle[i + 1], cycle[i + 2 if i + 1 < last else 0])
    return gain


@kernel
def _entropy_loss(
    edges: EdgeCount, tour: Tour, cut: NDArray[np.int64], join: NDArray[np.int64], k: int
) -> float:
    """Entropy of the population less that after an exchange in one tour."""
    loss = 0.0
    for port in range(2 * k):
        u = vertex_at(tour, cut, port)
        if port & 1 == 0:
            c = multiplicity(edges, u, vertex_at(tour, cut, port + 1))
            loss += edges.entropy[c] - edges.entropy[c - 1]
        if port < join[port]:
            c = multiplicity(edges, u, vertex_at(tour, cut, join[port]))
            loss += edges.entropy[c] - edges.entropy[c + 1]
    return loss


@kernel
def _count_exchange(
    edges: EdgeCount, tour: Tour, cut: NDArray[np.int64], join: NDArray[np.int64], k: int
) -> None:
    """Count the edges of one tour anew after an exchange."""
    for r in range(k):
        remove_edge(edges, vertex_at(tour, cut, 2 * r), vertex_at(tour, cut, 2 * r + 1))
    for port in range(2 * k):
        if port < join[port]:
            add_edge(edges, vertex_at(tour, cut, port), vertex_at(tour, cut, join[port]))
