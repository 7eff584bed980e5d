"""How S-GGARP makes new individuals: initial routes, crossover and mutations.

None of them heeds the time limit; `rebirth` does that afterwards. That is their use: a
route that is far too long, shed node by node, ends elsewhere than one grown from nothing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.route_kernels import cheapest_place
from fiveroute.kernels import kernel
from fiveroute.randomness import RandomState, below
from fiveroute.stops import Stops, insert_stop, remove_stops

__all__ = ["crossover", "mutate", "random_route"]


@kernel
def random_route(legs: NDArray[np.float64], stops: Stops, state: RandomState) -> int:
    """Fill a route with a random share of all nodes, each put at its cheapest place.

    The nodes come in random order. Returns the length of the route.
    """
    size = len(legs)
    order = np.arange(1, size - 1)
    for i in range(size - 3, 0, -1):
        j = below(state, i + 1)
        order[i], order[j] = order[j], order[i]
    stops[0], stops[1] = 0, size - 1
    length = 2
    for node in order[: below(state, size - 1)]:
        length = insert_stop(stops, length, cheapest_place(legs, stops, length, node)[1], node)
    return length


@kernel
def crossover(
    first: Stops,
    first_length: int,
    second: Stops,
    second_length: int,
    child: Stops,
    state: RandomState,
) -> int:
    """Fill a child with the first parent up to a common node, and the second from there on.

    The common node is drawn at random; without one the parents are cut at random places.
    Nodes of the second parent that the child has already are left out. Returns the
    length of the child.
    """
    position = np.full(len(child), -1)
    for at in range(second_length - 1):
        position[second[at]] = at
    cut = below(state, first_length - 1)
    for step in range(first_length - 1):
        at = (cut + step) % (first_length - 1)
        if position[first[at]] > 0:
            cut = at
            break
    follow = position[first[cut]]
    if follow <= 0:
        follow = below(state, second_length - 1)
    length = cut + 1
    child[:length] = first[:length]
    taken = np.zeros(len(child), np.bool_)
    for at in range(length):
        taken[child[at]] = True
    for at in range(follow + 1, second_length):
        if not taken[second[at]]:
            child[length] = second[at]
            length += 1
    return length


@kernel
def mutate(legs: NDArray[np.float64], stops: Stops, length: int, state: RandomState) -> int:
    """Exchange two strings, leave one out, or visit a group of idle nodes.

    Returns the new length.
    """
    kind = below(state, 5)
    if kind == 0:
        _exchange_strings(stops, length, state)
    elif kind <= 2 and length > 2:
        count = 1 + below(state, (length - 1) // 2)
        length = remove_stops(stops, length, 1 + below(state, length - 1 - count), count)
    else:
        length = _visit_group(legs, stops, length, 1 + below(state, 4), state)
    return length


@kernel
def _exchange_strings(stops: Stops, length: int, state: RandomState) -> None:
    """Exchange two neighbouring strings of nodes without reversing them."""
    if length < 4:
        return
    first = 1 + below(state, length - 3)
    last = first + 2 + below(state, length - 2 - first)
    middle = first + 1 + below(state, last - first - 1)
    string = stops[first:middle].copy()
    count = last - middle
    for i in range(count):
        stops[first + i] = stops[middle + i]
    stops[first + count : last] = string


@kernel
def _visit_group(
    legs: NDArray[np.float64], stops: Stops, length: int, count: int, state: RandomState
) -> int:
    """Insert a random idle node and the idle nodes nearest to it, in time or not."""
    size = len(legs)
    idle = np.ones(size, np.bool_)
    for at in range(length):
        idle[stops[at]] = False
    centre = node = _random_idle(idle, size - length, state)
    for _ in range(min(count, size - length)):
        length = insert_stop(stops, length, cheapest_place(legs, stops, length, node)[1], node)
        idle[node] = False
        nearest = np.inf
        for other in range(1, size - 1):
            if idle[other] and legs[centre, other] < nearest:
                node, nearest = other, legs[centre, other]
    return length


@kernel
def _random_idle(idle: NDArray[np.bool_], count: int, state: RandomState) -> int:
    left = below(state, count) if count > 0 else 0
    for node in range(len(idle)):
        if idle[node]:
            if left == 0:
                return node
            left -= 1
    return 0
