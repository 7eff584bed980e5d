"""The routes that the islands have come across, for recombination."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import NamedTuple

import numpy as np

from fiveroute.heuristics.fleet.chains import duration
from fiveroute.heuristics.fleet.network import Floats, Ints, Network, Trail

__all__ = ["Pool", "PooledRoutes"]


class PooledRoutes(NamedTuple):
    """The routes of a pool, side by side for the kernels.

    Parameters
    ----------
    first
        Place of every route's first node among `nodes`, and at last their number.
    nodes
        The nodes of all routes.
    time
        Duration of every route in seconds.
    """

    first: Ints
    nodes: Ints
    time: Floats

    def trail(self, route: int) -> Trail:
        """The nodes of a route."""
        return tuple(self.nodes[self.first[route] : self.first[route + 1]].tolist())


class Pool:
    """Routes by the set of their nodes, each in the fastest order that was met.

    Parameters
    ----------
    network
        The problem.
    capacity
        Most routes that are kept; the oldest leave first.
    """

    __slots__ = ("_capacity", "_network", "_routes")

    def __init__(self, network: Network, capacity: int) -> None:
        self._network = network
        self._capacity = capacity
        self._routes: dict[frozenset[int], tuple[float, Trail]] = {}

    def __len__(self) -> int:
        return len(self._routes)

    def add(self, trails: Iterable[Trail]) -> None:
        """Keep routes; of two with the same nodes only the faster one."""
        leg, size = self._network.leg, len(self._network.nodes)
        for trail in trails:
            time = duration(leg, size, len(leg) - 1, np.array(trail, np.int64))
            key = frozenset(trail)
            known = self._routes.pop(key, None)
            self._routes[key] = (time, trail) if known is None or time < known[0] else known
        while len(self._routes) > self._capacity:
            del self._routes[next(iter(self._routes))]

    @property
    def trails(self) -> list[Trail]:
        """All routes, in the order in which they were last met."""
        return [trail for _, trail in self._routes.values()]

    def routes(self) -> PooledRoutes:
        """All routes, side by side."""
        trails = self.trails
        return PooledRoutes(
            np.cumsum([0, *map(len, trails)]),
            np.fromiter(chain.from_iterable(trails), np.int64),
            np.array([time for time, _ in self._routes.values()]),
        )

    def places(self, trails: Iterable[Trail]) -> Ints:
        """Numbers that routes of the pool have among `routes`."""
        number = {key: place for place, key in enumerate(self._routes)}
        return np.array([number[frozenset(trail)] for trail in trails])
