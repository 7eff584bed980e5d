"""Inner loops of the Held-Karp bound: shortest spanning trees under prices.

The nodes 1 to n are to be joined by a tree whose links are arcs of either direction. With
a price for leaving and for entering every node, the link i-j costs

    min(t_ij + leaving_i + entering_j,  t_ji + leaving_j + entering_i).

`there` holds the leg times and `back` their transpose; where both prices and times are
symmetric, `back` is never looked at. A tree is described by the `order` in which nodes
joined it, shape (n,), the `parent` of each, shape (n + 2,), and whether the arc runs
`forward`, from the parent, or back. The kernels fill these three and return the length;
the first node of the order has no parent.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["dense_tree", "links_within", "sparse_tree"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]


@kernel
def dense_tree(
    there: Floats, back: Floats, symmetric: bool, leaving: Floats, entering: Floats,
    order: Integers, parent: Integers, forward: Booleans,
) -> float:  # fmt: skip
    """Shortest tree over all links, by Prim's algorithm in O(n^2)."""
    n = len(order)
    cost = np.full(n + 1, np.inf)
    waiting = np.arange(2, n + 1)
    left, total, node = n - 1, 0.0, 1
    order[0] = 1
    for k in range(1, n):
        nearest, least = 0, np.inf
        for place in range(left):
            other = waiting[place]
            price = there[node, other] + leaving[node] + entering[other]
            onward = True
            if not symmetric:
                returning = back[node, other] + leaving[other] + entering[node]
                if returning < price:
                    price, onward = returning, False
            if price < cost[other]:
                cost[other] = price
                parent[other] = node
                forward[other] = onward
            if cost[other] < least:
                nearest, least = place, cost[other]
        node = waiting[nearest]
        left -= 1
        waiting[nearest] = waiting[left]
        order[k] = node
        total += least
    return total


@kernel
def sparse_tree(
    first: Integers, others: Integers, there: Floats, back: Floats, leaving: Floats,
    entering: Floats, order: Integers, parent: Integers, forward: Booleans,
) -> float:  # fmt: skip
    """Shortest tree over the links of a connected graph, by Prim's algorithm with a heap.

    The links of node i are those from first[i] to first[i + 1]: to others[e], taking
    there[e] out and back[e] home.
    """
    n = len(order)
    cost = np.full(n + 1, np.inf)
    joined = np.zeros(n + 1, np.bool_)
    heap = np.empty(n + 1, np.int64)
    place = np.full(n + 1, -1, np.int64)
    heap[0], place[1], cost[1] = 1, 0, 0.0
    size, total = 1, 0.0
    for k in range(n):
        node = heap[0]
        size -= 1
        _sink(heap, place, cost, heap[size], size)
        joined[node] = True
        order[k] = node
        total += cost[node]
        for e in range(first[node], first[node + 1]):
            other = others[e]
            if joined[other]:
                continue
            onward = there[e] + leaving[node] + entering[other]
            returning = back[e] + leaving[other] + entering[node]
            price = min(onward, returning)
            if price < cost[other]:
                cost[other] = price
                parent[other] = node
                forward[other] = onward <= returning
                if place[other] < 0:
                    place[other] = size
                    size += 1
                _rise(heap, place, cost, other)
    return total


@kernel
def _sink(heap: Integers, place: Integers, cost: Floats, node: int, size: int) -> None:
    """Put a node at the root of a heap of this size, and let it down to where it belongs."""
    here = 0
    while True:
        below = 2 * here + 1
        if below >= size:
            break
        if below + 1 < size and cost[heap[below + 1]] < cost[heap[below]]:
            below += 1
        if cost[heap[below]] >= cost[node]:
            break
        heap[here] = heap[below]
        place[heap[here]] = here
        here = below
    heap[here] = node
    place[node] = here


@kernel
def _rise(heap: Integers, place: Integers, cost: Floats, node: int) -> None:
    """Lift a node, whose cost has fallen, to where it belongs."""
    here = place[node]
    while here > 0:
        above = (here - 1) // 2
        if cost[heap[above]] <= cost[node]:
            break
        heap[here] = heap[above]
        place[heap[here]] = here
        here = above
    heap[here] = node
    place[node] = here


@kernel
def links_within(
    there: Floats, symmetric: bool, leaving: Floats, entering: Floats, order: Integers,
    parent: Integers, slack: float, most: int,
) -> Integers:  # fmt: skip
    """Arcs between nodes that lengthen the shortest tree by no more than `slack`, (2, any).

    An arc forced into the tree pushes out the dearest link between its two ends. Where
    times are symmetric, only arcs to a higher number are given. The search ends when there
    are more than `most`.
    """
    n = len(order)
    first, others, costs = _adjacency(there, symmetric, leaving, entering, order, parent)
    dearest = np.zeros(n + 1)
    stack = np.empty(n, np.int64)
    found = np.empty((2, 16 * n), np.int64)
    count = 0
    for i in range(1, n + 1):
        if count > most:
            break
        _dearest_from(i, first, others, costs, stack, dearest)
        for j in range(i + 1 if symmetric else 1, n + 1):
            if j == i or there[i, j] + leaving[i] + entering[j] - dearest[j] > slack:
                continue
            if count == found.shape[1]:
                found = np.concatenate((found, np.empty_like(found)), axis=1)
            found[0, count], found[1, count] = i, j
            count += 1
    return found[:, :count].copy()


@kernel
def _adjacency(
    there: Floats, symmetric: bool, leaving: Floats, entering: Floats, order: Integers,
    parent: Integers,
) -> tuple[Integers, Integers, Floats]:  # fmt: skip
    """Neighbours of every node in the tree, from first[i] to first[i + 1], and link costs."""
    n = len(order)
    first = np.zeros(n + 3, np.int64)
    for node in order[1:]:
        first[node + 2] += 1
        first[parent[node] + 2] += 1
    first = np.cumsum(first)
    others = np.empty(2 * n, np.int64)
    costs = np.empty(2 * n)
    for node in order[1:]:
        above = parent[node]
        cost = there[above, node] + leaving[above] + entering[node]
        if not symmetric:
            cost = min(cost, there[node, above] + leaving[node] + entering[above])
        for end, other in ((node, above), (above, node)):
            others[first[end + 1]] = other
            costs[first[end + 1]] = cost
            first[end + 1] += 1
    return first, others, costs


@kernel
def _dearest_from(
    root: int, first: Integers, others: Integers, costs: Floats, stack: Integers, dearest: Floats
) -> None:
    """Cost of the dearest link between the root and every other node, into `dearest`."""
    dearest[:] = -np.inf
    stack[0], size = root, 1
    while size:
        size -= 1
        node = stack[size]
        for e in range(first[node], first[node + 1]):
            other = others[e]
            if other != root and dearest[other] == -np.inf:
                dearest[other] = max(dearest[node], costs[e])
                stack[size] = other
                size += 1
