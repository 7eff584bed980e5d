"""Held-Karp bound: how short a route through all nodes can be at best.

A route from start to destination through the nodes 1 to n is an arc out of the start, an
arc into the destination, and between them a path, which is a spanning tree of the nodes.
Every node is left once and entered once. Dropping this last rule and charging prices
a_i for leaving and b_j for entering a node instead, the least cost

    L(a, b) = min_j (t_0j + b_j) + min_i (t_i,n+1 + a_i)
              + min over spanning trees of sum over links (t_ij + a_i + b_j)
              - sum_i (a_i + b_i)

is a lower bound on the travel time for *any* prices, whenever the search for good ones
stops. At the best prices it equals the linear relaxation with all sub-tour elimination
constraints, some 0.7 % below the optimum for random points in a square.

L is concave, and (times left - 1, times entered - 1) is a subgradient. The ascent follows
it with Polyak's steps towards a target; where times are symmetric a = b, and only the
number of links of a node counts. For many nodes the trees are grown on a sparse graph of
near neighbours, and only the final prices are put to the complete graph, which makes the
bound valid; links that it misses join the graph for another round.

References
----------
M. Held and R. M. Karp, "The traveling-salesman problem and minimum spanning trees: part
II", Mathematical Programming 1, 1971, doi 10.1007/BF01584070.
B. T. Polyak, "Minimization of unsmooth functionals", USSR Computational Mathematics and
Mathematical Physics 9(3), 1969, doi 10.1016/0041-5553(69)90061-5 (the steps).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock, Limits
from fiveroute.models.tree_kernels import dense_tree, links_within, sparse_tree
from fiveroute.problem import TeamOrienteering

__all__ = ["HeldKarp", "giant_route_bound", "has_symmetric_nodes", "held_karp", "useful_links"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_SPARSE_FROM = 250
"""Number of nodes from which the ascent runs on a sparse graph."""

_NEIGHBOURS = 8
"""Near neighbours of every node in the sparse graph."""

_PATIENCE = 20
"""Steps without gain after which the step factor is halved."""

_LEAST_FACTOR = 1e-3
"""Step factor at which the ascent ends."""

_STEPS = 1000
"""Steps of one ascent at most."""

_ROUNDS = 12
"""Ascents on ever larger sparse graphs at most."""

_MISSED = 1e-4
"""Share of the bound that may be missed on the sparse graph without another round."""

_HEADROOM = 0.04
"""How far the target of the steps lies above the best value, relative."""

_ROUNDING = 1e-12
"""Relative error that the rounding of long sums stays below."""


@dataclass(frozen=True, slots=True)
class Tree:
    """A shortest spanning tree with the arcs out of the start and into the destination.

    Parameters
    ----------
    value
        L, its priced time less all prices: a lower bound on the travel time.
    links
        Arcs of the spanning tree, tails and heads, shape (2, n - 1).
    excess
        Times left and times entered of every vertex, less one, shape (2, n + 2); zero at
        both ends, and everywhere if the tree is a route. The mean of both where times are
        symmetric.
    """

    value: float
    links: Integers
    excess: Floats


Grow = Callable[[Floats], Tree]
"""From prices, shape (2, n + 2), to a shortest tree."""


@dataclass(frozen=True, slots=True)
class HeldKarp:
    """What an ascent has found.

    Parameters
    ----------
    bound
        Lower bound on the travel time of every route through all nodes, in seconds.
    prices
        Prices a and b that prove it, shape (2, n + 2).
    """

    bound: float
    prices: Floats


def giant_route_bound(problem: TeamOrienteering, limits: Limits | None = None) -> float:
    """Lower bound on the time T_0 of the giant route, travel and services, in seconds.

    Valid whenever it is stopped; without a time limit the ascent ends by itself. Where all
    legs take whole seconds, so does the shortest way, and its bound is rounded up.
    """
    clock = (limits or Limits()).start()
    bound = held_karp(problem, clock).bound * (1.0 - _ROUNDING)
    if all((row == np.floor(row)).all() for row in problem.travel):
        bound = math.ceil(bound)
    return (bound + float(problem.service.sum())) * (1.0 - _ROUNDING)


def held_karp(problem: TeamOrienteering, clock: Clock) -> HeldKarp:
    """Ascend to good prices; only the leg times matter."""
    prices = np.zeros((2, problem.n + 2))
    if problem.n == 0:
        return HeldKarp(float(problem.travel[0, -1]), prices)
    symmetric = has_symmetric_nodes(problem)
    complete, scale = _complete_graph(problem, symmetric), float(problem.travel.mean())
    if problem.n < _SPARSE_FROM:
        return _ascend(complete, prices, clock, scale, _STEPS)
    tree = complete(prices)
    best, links, steps = HeldKarp(tree.value, prices), _near_links(problem, clock), _STEPS // 16
    if clock.expired:
        return best
    for _ in range(_ROUNDS):
        links = np.hstack((links, tree.links))
        sparse = _sparse_graph(problem, symmetric, links)
        relaxed = _ascend(sparse, best.prices, clock, scale, steps)
        tree = complete(relaxed.prices)
        if tree.value > best.bound:
            best = HeldKarp(tree.value, relaxed.prices)
        matched = tree.value >= relaxed.bound - _MISSED * abs(relaxed.bound)
        if clock.expired or (matched and steps == _STEPS):
            break
        steps = _STEPS if matched else min(2 * steps, _STEPS)
    return best


def useful_links(
    problem: TeamOrienteering, relaxed: HeldKarp, upper: float, most: int
) -> Integers | None:
    """Arcs that a route with a travel time below `upper` can use, shape (2, any).

    Every other arc, forced into the shortest tree, lifts the bound to `upper` or above.
    Where the nodes are symmetric, an arc between two of them stands for both directions.
    None is returned where there are more than `most`.
    """
    symmetric = has_symmetric_nodes(problem)
    there, back = problem.travel, _way_back(problem, symmetric)
    leaving, entering = relaxed.prices
    order, parent, forward = _blank(problem.n)
    dense_tree(there, back, symmetric, leaving, entering, order, parent, forward)
    slack = upper - relaxed.bound
    inner = links_within(there, symmetric, leaving, entering, order, parent, slack, most)
    out, home = there[0, 1:-1] + entering[1:-1], there[1:-1, -1] + leaving[1:-1]
    firsts = 1 + np.flatnonzero(out <= out.min() + slack)
    lasts = 1 + np.flatnonzero(home <= home.min() + slack)
    start, destination = np.zeros_like(firsts), np.full_like(lasts, problem.destination)
    links = np.hstack((inner, (start, firsts), (lasts, destination)))
    return links if links.shape[1] <= most else None


def _ascend(grow: Grow, prices: Floats, clock: Clock, scale: float, steps: int) -> HeldKarp:
    """Follow the subgradients in Polyak's steps, each turned a little towards the last.

    `scale` is a time that stands in for the bound while that is zero.
    """
    best, factor, stalled, last = HeldKarp(-np.inf, prices), 2.0, 0, np.zeros_like(prices)
    for _ in range(steps):
        tree = grow(prices)
        stalled += 1
        if tree.value > best.bound:
            best, stalled = HeldKarp(tree.value, prices), 0
        elif stalled == _PATIENCE:
            prices, factor, stalled = best.prices, factor / 2.0, 0
            continue
        headroom = _HEADROOM * max(best.bound, scale)
        steepness = float((tree.excess**2).sum())
        if steepness == 0.0 or factor < _LEAST_FACTOR or clock.expired:
            break
        step = factor * (best.bound + headroom - tree.value) / steepness
        prices = prices + step * (0.7 * tree.excess + 0.3 * last)
        last = tree.excess
    return best


def _complete_graph(problem: TeamOrienteering, symmetric: bool) -> Grow:
    there, back = problem.travel, _way_back(problem, symmetric)

    def grow(prices: Floats) -> Tree:
        skeleton = _blank(problem.n)
        order, parent, forward = skeleton
        length = dense_tree(there, back, symmetric, prices[0], prices[1], order, parent, forward)
        return _with_ends(problem, symmetric, prices, length, skeleton)

    return grow


def _sparse_graph(problem: TeamOrienteering, symmetric: bool, links: Integers) -> Grow:
    """Trees on a connected graph of undirected links, shape (2, any), however often given."""
    size = problem.n + 2
    both = np.hstack((links, links[::-1]))
    tails, heads = np.divmod(np.unique(both[0] * size + both[1]), size)
    first = np.searchsorted(tails, np.arange(size))
    there, back = problem.travel[tails, heads], problem.travel[heads, tails]

    def grow(prices: Floats) -> Tree:
        skeleton = _blank(problem.n)
        order, parent, forward = skeleton
        length = sparse_tree(
            first, heads, there, back, prices[0], prices[1], order, parent, forward
        )
        return _with_ends(problem, symmetric, prices, length, skeleton)

    return grow


def has_symmetric_nodes(problem: TeamOrienteering) -> bool:
    """Whether the legs between the nodes, the two ends apart, take the same time both ways."""
    inner = problem.travel[1:-1, 1:-1]
    return bool(np.array_equal(inner, inner.T))


def _way_back(problem: TeamOrienteering, symmetric: bool) -> Floats:
    """The leg times transposed, where that makes a difference."""
    if symmetric:
        return problem.travel
    back = np.ascontiguousarray(problem.travel.T)
    back.setflags(write=False)
    return back


Skeleton = tuple[Integers, Integers, Booleans]


def _blank(n: int) -> Skeleton:
    return np.zeros(n, np.int64), np.zeros(n + 2, np.int64), np.ones(n + 2, np.bool_)


def _with_ends(
    problem: TeamOrienteering, symmetric: bool, prices: Floats, length: float, skeleton: Skeleton
) -> Tree:
    order, parent, forward = skeleton
    leaving, entering = prices
    out = problem.travel[0, 1:-1] + entering[1:-1]
    home = problem.travel[1:-1, -1] + leaving[1:-1]
    value = length + float(out.min() + home.min() - prices.sum())
    node = order[1:]
    links = np.where(forward[node], (parent[node], node), (node, parent[node]))
    excess = np.stack([np.bincount(ends, minlength=problem.n + 2) - 1.0 for ends in links])
    excess[1, 1 + out.argmin()] += 1.0
    excess[0, 1 + home.argmin()] += 1.0
    excess[:, [0, -1]] = 0.0
    if symmetric:
        excess[:] = excess.mean(axis=0)
    return Tree(value, links, excess)


def _near_links(problem: TeamOrienteering, clock: Clock) -> Integers:
    """Links of the nodes to their nearest ones, taking the shorter way, shape (2, any)."""
    inner = problem.travel[1:-1, 1:-1]
    near: list[Integers] = []
    while len(near) < problem.n and not clock.expired:
        node = len(near)
        either = np.minimum(inner[node], inner[:, node])
        either[node] = np.inf
        near.append(np.argpartition(either, _NEIGHBOURS)[:_NEIGHBOURS])
    tails = np.repeat(np.arange(len(near)), _NEIGHBOURS)
    return np.stack((tails, np.ravel(near).astype(np.int64))) + 1
