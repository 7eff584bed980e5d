"""An island: routes under annealing, the best so far, and a stream of chance of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fiveroute.heuristics.fleet.annealing import BEST_PROFIT, BEST_TIME, anneal
from fiveroute.heuristics.fleet.chains import NEXT, Chains, build_chains, measure, trails_of
from fiveroute.heuristics.fleet.cover import improve_cover
from fiveroute.heuristics.fleet.fresh_route import fresh_route
from fiveroute.heuristics.fleet.network import Floats, Ints, Network, Trail
from fiveroute.heuristics.fleet.route_pool import PooledRoutes
from fiveroute.randomness import RandomState, below

__all__ = ["Island"]

ATTEMPTS = 200
"""Most combinations that are tried in one recombination."""

MOST_LOOKS = 200_000_000
"""Looks at a node of a pooled route that these may take, some 0.2 seconds in all."""


@dataclass(frozen=True, slots=True)
class Island:
    """The arrays that the kernels change, and what stays the same.

    Parameters
    ----------
    network
        The problem.
    chains
        The current routes.
    best
        The stop behind every stop in the best routes.
    score
        Data of the current routes, and data and total time of the best ones.
    price
        Data that a second is worth.
    state
        Random state of the kernels.
    hot
        Temperature at which the island begins, in mean data of a node.
    greed
        Largest power of the cost in the order of insertion.
    """

    network: Network
    chains: Chains
    best: Ints
    score: Floats
    price: float
    state: RandomState
    hot: float = 1.0
    greed: float = 0.0

    @classmethod
    def settle(
        cls,
        network: Network,
        trails: Sequence[Trail],
        price: float,
        state: RandomState,
        hot: float = 1.0,
        greed: float = 0.0,
    ) -> Island:
        """An island whose current and best routes are the given ones."""
        chains = build_chains(network, trails)
        collected = sum(float(network.profit[list(trail)].sum()) for trail in trails)
        return cls(
            network,
            chains,
            chains.stops[:, NEXT].copy(),
            np.array([collected, collected, chains.time.sum()]),
            price,
            state,
            hot,
            greed,
        )

    @property
    def objective(self) -> float:
        """Data that the best routes collect."""
        return float(self.score[BEST_PROFIT])

    @property
    def worth(self) -> tuple[float, float]:
        """What the best routes are compared by: most data, then least time."""
        return self.objective, -float(self.score[BEST_TIME])

    @property
    def best_trails(self) -> list[Trail]:
        """The best routes."""
        return trails_of(self.network, self.best)

    @property
    def trails(self) -> list[Trail]:
        """The current routes."""
        return trails_of(self.network, self.chains.stops[:, NEXT])

    def run(self, trials: int, temperature: float) -> None:
        """Make trials at a temperature in units of a node's mean data."""
        net = self.network
        anneal(
            net.leg,
            net.back,
            net.profit,
            net.limit,
            net.near,
            *self.chains,
            self.best,
            self.score,
            trials,
            temperature * float(net.profit.mean()),
            self.price,
            self.greed,
            self.state,
        )

    def recombine(self, pool: PooledRoutes, chosen: Ints, *, explore: bool) -> None:
        """Go on from the best combination of a pool's routes that is found.

        Parameters
        ----------
        pool
            The routes.
        chosen
            Those of them that are the island's best, one for every AUV.
        explore
            Whether one AUV gets a new route of idle nodes instead.
        """
        net = self.network
        chosen = chosen.copy()
        looks = 2 * len(net.limit) * len(pool.nodes)  # of one attempt
        attempts = min(ATTEMPTS, MOST_LOOKS // (looks + 1))
        improve_cover(*pool, net.profit, net.limit, self.price, chosen, attempts, self.state)
        seen: set[int] = set()
        trails: list[Trail] = []
        for route in chosen:
            trails.append(tuple(node for node in pool.trail(route) if node not in seen))
            seen.update(trails[-1])
        if explore:
            auv = below(self.state, len(trails))
            trails[auv] = self._fresh(auv, seen)
        self._move_to(trails)

    def _fresh(self, auv: int, visited: set[int]) -> Trail:
        """A new route for an AUV, out of nodes that are not visited."""
        net = self.network
        size = len(net.nodes)
        idle = np.array([node for node in range(size) if node not in visited], np.int64)
        end, limit = size + len(net.limit) + auv, float(net.limit[auv])
        route = fresh_route(net.leg, net.profit, size + auv, end, limit, idle, self.state)
        return tuple(route.tolist())

    def _move_to(self, trails: Sequence[Trail]) -> None:
        """Make routes the current ones, unless one is late (detours may have saved time)."""
        net = self.network
        chains = build_chains(net, trails)
        measure(net.leg, chains.stops, chains.time)
        if (chains.time <= net.limit).all():
            for mine, new in zip(self.chains, chains, strict=True):
                mine[:] = new
