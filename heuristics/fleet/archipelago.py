"""Islands in parallel, and the pool of routes through which they learn from each other.

Every island anneals for itself, from hot to cold. Then each of them starts again from the
best combination of what all of them have found so far (see `fiveroute.heuristics.fleet.cover`),
not quite as hot as before, and so round after round. One long annealing run gets stuck in
the first valley that it freezes in; several short ones freeze in several, whose routes
complement each other.

There are as many islands whatever the machine, and they exchange routes at the same trials
whatever their pace: the number of workers changes the time that it takes, not the answer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fiveroute.heuristics.fleet.crew import ForEach
from fiveroute.heuristics.fleet.island import Island
from fiveroute.heuristics.fleet.network import Network, trails_in
from fiveroute.heuristics.fleet.route_pool import Pool
from fiveroute.heuristics.fleet.schedule import stage
from fiveroute.heuristics.randomness import random_state
from fiveroute.routes import Plan, Route

__all__ = ["Archipelago"]

MANNERS = ((1.0, 0.0), (1.0, 0.0), (1.0, 0.0), (10.0, 1.0))
"""Temperature at the start, and greed, of every island. No one manner suits all problems."""

FEW_NODES = 150
"""Number of nodes up to which all islands are of the first manner."""


@dataclass(slots=True)
class Archipelago:
    """Islands that search for the best plan of one problem.

    Parameters
    ----------
    islands
        The islands.
    pool
        Routes that they came across.
    round
        Number of the round that they are in.
    """

    islands: tuple[Island, ...]
    pool: Pool
    round: int = 0

    @classmethod
    def around(
        cls, plan: Plan, network: Network, price: float, rng: np.random.Generator
    ) -> Archipelago:
        """Islands that all start from a plan."""
        trails = trails_in(network, plan)
        is_small = len(network.nodes) <= FEW_NODES
        manners = MANNERS[:1] * len(MANNERS) if is_small else MANNERS
        return cls(
            tuple(
                Island.settle(network, trails, price, random_state(rng), *manner)
                for manner in manners
            ),
            Pool(network, least=2 * len(MANNERS) * len(network.limit)),
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
        return [tuple(nodes[list(trail)].tolist()) for trail in self.pool.trails]

    def run(self, trials: int, part: float, for_each: ForEach) -> None:
        """Make trials on every island, a share `part` of all the work being done."""
        entered, _, is_cold = stage(part)
        if entered > self.round:
            self.round = entered
            self._recombine(for_each)
        for_each(lambda island: island.run(trials, stage(part, island.hot)[1]), self.islands)
        if is_cold:
            for island in self.islands:
                self.pool.add(island.trails)

    def _pool_best(self) -> None:
        for island in self.islands:
            self.pool.add(island.best_trails)

    def _recombine(self, for_each: ForEach) -> None:
        self._pool_best()
        routes = self.pool.routes()
        explorer = self.islands[-1]
        for_each(
            lambda island: island.recombine(
                routes, self.pool.places(island.best_trails), explore=island is explorer
            ),
            self.islands,
        )
