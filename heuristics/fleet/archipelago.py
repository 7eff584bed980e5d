"""Islands in parallel, and the pools of routes through which they learn from each other.

Every island anneals for itself, from hot to cold. Then each of them starts again from the
best combination of what it and its neighbour have found so far (see
`fiveroute.heuristics.fleet.cover`), not quite as hot as before, and so round after round; in
the last rounds all learn from all. One long annealing run gets stuck in the first valley that
it freezes in; several short ones freeze in several, whose routes complement each other, unless
they meet too soon.

There are as many islands whatever the machine, and they exchange routes at the same trials
whatever their pace: the number of workers changes the time that it takes, not the answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np

from fiveroute.heuristics.fleet.crew import ForEach
from fiveroute.heuristics.fleet.island import Island
from fiveroute.heuristics.fleet.network import Network, Trail, trails_in
from fiveroute.heuristics.fleet.route_pool import Pool
from fiveroute.heuristics.fleet.schedule import stage
from fiveroute.randomness import random_state
from fiveroute.routes import Plan, Route

__all__ = ["Archipelago"]

MANNERS = ((1.0, 0.0), (1.0, 0.0), (1.0, 0.0), (10.0, 1.0))
"""Temperature at the start, and greed, of every island. No one manner suits all problems."""

FEW_NODES, MANNERS_OF_FEW = 150, ((1.0, 0.0), (1.0, 0.0), (3.0, 0.0), (3.0, 0.0))
"""Number of nodes up to which islands have other manners, and these."""

CAPACITY = 4000
"""Most routes that are kept, but for large fleets."""

PAIRS, TOGETHER = 2, 3
"""Pools at first, one for every two islands, and the round from which on all share one."""


@dataclass(slots=True)
class Archipelago:
    """Islands that search for the best plan of one problem.

    Parameters
    ----------
    islands
        The islands.
    pools
        Routes that they came across, each pool those of as many neighbours.
    round
        Number of the round that they are in.
    """

    islands: tuple[Island, ...]
    pools: tuple[Pool, ...]
    round: int = 0

    @classmethod
    def around(
        cls, plan: Plan, network: Network, price: float, rng: np.random.Generator
    ) -> Archipelago:
        """Islands of which the first starts from a plan, the others from routes without nodes.

        A plan may lie in a valley that is hard to leave.
        """
        trails = trails_in(network, plan)
        bare = _bare(network, trails)
        manners = MANNERS_OF_FEW if len(network.nodes) <= FEW_NODES else MANNERS
        return cls(
            tuple(
                Island.settle(network, bare if k else trails, price, random_state(rng), *manner)
                for k, manner in enumerate(manners)
            ),
            tuple(Pool(network, _capacity(network) // PAIRS) for _ in range(PAIRS)),
        )

    @property
    def network(self) -> Network:
        """The problem."""
        return self.islands[0].network

    @property
    def leader(self) -> Island:
        """The island with the best routes, the first of equals."""
        return max(self.islands, key=lambda island: island.worth)

    @property
    def objective(self) -> float:
        """Data that the best routes collect."""
        return self.leader.objective

    @property
    def plan(self) -> Plan:
        """The best routes."""
        nodes = self.leader.network.nodes
        return Plan.of(nodes[list(trail)] for trail in self.leader.best_trails)

    @property
    def routes(self) -> list[Route]:
        """Good routes, those of the best plan of every island among them."""
        self._pool_best()
        nodes = self.network.nodes
        trails = dict.fromkeys(chain.from_iterable(pool.trails for pool in self.pools))
        return [tuple(nodes[list(trail)].tolist()) for trail in trails]

    def run(self, trials: int, part: float, for_each: ForEach) -> None:
        """Make trials on every island, a share `part` of all the work being done."""
        entered, _, is_cold = stage(part)
        if entered > self.round:
            self.round = entered
            self._recombine(for_each)
        for_each(lambda island: island.run(trials, stage(part, island.hot)[1]), self.islands)
        if is_cold:
            for pool, island in self._pooled():
                pool.add(island.trails)

    def _pooled(self) -> list[tuple[Pool, Island]]:
        """Every island behind the pool that it shares."""
        pools, count = self.pools, len(self.islands)
        return [(pools[k * len(pools) // count], island) for k, island in enumerate(self.islands)]

    def _pool_best(self) -> None:
        for pool, island in self._pooled():
            pool.add(island.best_trails)

    def _recombine(self, for_each: ForEach) -> None:
        if self.round >= TOGETHER and len(self.pools) > 1:
            everything = Pool(self.network, _capacity(self.network))
            for pool in self.pools:
                everything.add(pool.trails)
            self.pools = (everything,)
        self._pool_best()  # at last, so that none of these has left when they are looked up
        for pool in self.pools:
            neighbours = [island for shared, island in self._pooled() if shared is pool]
            self._learn(pool, neighbours, for_each)

    def _learn(self, pool: Pool, islands: Iterable[Island], for_each: ForEach) -> None:
        routes = pool.routes()
        explorer = self.islands[-1]
        for_each(
            lambda island: island.recombine(
                routes, pool.places(island.best_trails), explore=island is explorer
            ),
            islands,
        )


def _capacity(network: Network) -> int:
    """Routes that are kept in all: twice the best ones of all islands at least."""
    return max(CAPACITY, 2 * len(MANNERS) * len(network.limit))


def _bare(network: Network, trails: Sequence[Trail]) -> list[Trail]:
    """Routes without nodes, but for AUVs that are late without a detour."""
    starts = len(network.nodes) + np.arange(len(trails))
    late = network.leg[starts, starts + len(trails)] > network.limit
    return [trail if late[auv] else () for auv, trail in enumerate(trails)]
