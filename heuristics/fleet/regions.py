"""A large fleet in regions: every island anneals a part of one and the same plan.

For thousands of nodes there is no time for several plans. The routes are divided into
groups of neighbours instead, each with the nodes around it, and every group is a problem
of its own on an island (E. D. Taillard, S. Voss, "POPMUSIC", 2002,
doi 10.1007/978-1-4615-1507-4_27). Their plans add up to one of the whole fleet. After
some trials for every node the routes are divided anew from another AUV, so that no border
lasts. The islands work at the same time, and their leg times fit into a processor's cache
where those of all nodes do not. The number of workers does not change the answer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fiveroute.heuristics.fleet.annealing import BEST_TIME
from fiveroute.heuristics.fleet.crew import ForEach
from fiveroute.heuristics.fleet.fresh_route import fill_empty_routes
from fiveroute.heuristics.fleet.island import Island
from fiveroute.heuristics.fleet.network import Ints, Network, Trail, part_of, trails_in
from fiveroute.heuristics.fleet.schedule import COLD, HOT
from fiveroute.randomness import random_state
from fiveroute.routes import Plan, Route

__all__ = ["Regions", "divide"]

WHOLE = 0.2
"""Share of the work after which there is more than one region: the routes have to spread
over all of the field first."""

REGIONS = 4
"""Most regions; each of them has two AUVs at least."""

TRIALS_PER_NODE = 20
"""Trials for every node of a region before the routes are divided anew."""


@dataclass(slots=True)
class Regions:
    """A plan that is annealed region by region.

    Parameters
    ----------
    network
        The whole problem.
    price
        Data that a second is worth.
    rng
        Source of the seeds and of the AUVs to divide from.
    best
        The best routes before the last division.
    worth
        Their data and total time, the latter negative.
    islands
        One for every region.
    auvs
        The AUVs of every region.
    left
        Trials on every island before the next division.
    """

    network: Network
    price: float
    rng: np.random.Generator
    best: list[Route]
    worth: tuple[float, float]
    islands: tuple[Island, ...] = ()
    auvs: tuple[Ints, ...] = ()
    left: int = 0

    @classmethod
    def around(
        cls, plan: Plan, network: Network, price: float, rng: np.random.Generator
    ) -> Regions:
        """Regions of a plan; first every AUV that visits nothing gets a route.

        From nothing at all annealing never gets to where all that is rich is far.
        """
        state = random_state(rng)
        trails = fill_empty_routes(network, trails_in(network, plan), state)
        whole = Island.settle(network, trails, price, state)
        routes = [tuple(network.nodes[list(trail)].tolist()) for trail in trails]
        regions = cls(network, price, rng, routes, whole.worth)
        regions._divide(regions.best, 1)
        return regions

    @property
    def objective(self) -> float:
        """Data that the best routes collect."""
        return max(self.worth, self._worth)[0]

    @property
    def plan(self) -> Plan:
        """The best routes."""
        self._note_best()
        return Plan.of(self.best)

    @property
    def routes(self) -> list[Route]:
        """The best routes; there is no pool."""
        return list(self.plan.routes)

    def run(self, trials: int, part: float, for_each: ForEach) -> None:
        """Make trials on every island, a share `part` of all the work being done."""
        if self.left <= 0 and part >= WHOLE:
            self._note_best()
            count = max(1, min(REGIONS, len(self.network.limit) // 2))
            self._divide(self._joined([island.trails for island in self.islands]), count)
        temperature = HOT * (COLD / HOT) ** part
        inhabited = [island for island in self.islands if len(island.network.nodes)]
        for_each(lambda island: island.run(trials, temperature), inhabited)
        self.left -= trials

    @property
    def _worth(self) -> tuple[float, float]:
        """Data and negative time of the islands' best routes together."""
        times = [island.score[BEST_TIME] for island in self.islands]
        return sum(island.objective for island in self.islands), -float(sum(times))

    def _note_best(self) -> None:
        if self._worth > self.worth:
            self.worth = self._worth
            self.best = self._joined([island.best_trails for island in self.islands])

    def _joined(self, trails: list[list[Trail]]) -> list[Route]:
        """The routes of the fleet out of those of the islands."""
        routes: list[Route] = [()] * len(self.network.limit)
        for island, auvs, found in zip(self.islands, self.auvs, trails, strict=True):
            for auv, trail in zip(auvs, found, strict=True):
                routes[auv] = tuple(island.network.nodes[list(trail)].tolist())
        return routes

    def _divide(self, routes: list[Route], count: int) -> None:
        """Islands of the regions of some routes."""
        trails = trails_in(self.network, Plan.of(routes))
        first = int(self.rng.integers(len(trails)))
        region, region_of_node = divide(self.network, trails, first, count)
        self.auvs = tuple(np.flatnonzero(region == number) for number in range(count))
        self.islands = tuple(
            self._island(np.flatnonzero(region_of_node == number), auvs, routes)
            for number, auvs in enumerate(self.auvs)
        )
        self.left = TRIALS_PER_NODE * len(self.network.nodes) // count

    def _island(self, nodes: Ints, auvs: Ints, routes: list[Route]) -> Island:
        network = part_of(self.network, nodes, auvs)
        trails = trails_in(network, Plan.of(routes[auv] for auv in auvs))
        return Island.settle(network, trails, self.price, random_state(self.rng))


def divide(network: Network, trails: list[Trail], first: int, count: int) -> tuple[Ints, Ints]:
    """The region of every AUV and of every node, neighbours together.

    Parameters
    ----------
    network
        The problem.
    trails
        The routes.
    first
        AUV to begin with.
    count
        Number of regions, at most one for every AUV.
    """
    size = len(network.nodes)
    middle = np.array(
        [trail[len(trail) // 2] if trail else size + auv for auv, trail in enumerate(trails)]
    )
    distance = network.leg[np.ix_(middle, middle)]
    np.fill_diagonal(distance, 0.0)
    region = np.full(len(trails), -1)
    centre = first
    for number in range(count):
        waiting = np.flatnonzero(region < 0)
        nearest = waiting[np.argsort(distance[centre, waiting], kind="stable")]
        region[nearest[: -(-len(waiting) // (count - number))]] = number
        if number + 1 < count:
            waiting = np.flatnonzero(region < 0)
            centre = int(waiting[distance[centre, waiting].argmax()])
    of_stop = np.full(len(network.leg), -1)
    for auv, trail in enumerate(trails):
        of_stop[list(trail)] = region[auv]
    near = of_stop[network.near]
    nearest_region = near[np.arange(size), (near >= 0).argmax(axis=1)]
    idle = np.flatnonzero(of_stop[:size] < 0)
    of_stop[idle] = nearest_region[idle]
    far = np.flatnonzero(of_stop[:size] < 0)  # no near node is on a route
    of_stop[far] = region[network.leg[np.ix_(far, middle)].argmin(axis=1)]
    return region, of_stop[:size]
