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

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from fiveroute.heuristics.fleet.chains import build_chains
from fiveroute.heuristics.fleet.island import Island
from fiveroute.heuristics.fleet.network import build_network
from fiveroute.heuristics.fleet.route_pool import Pool
from fiveroute.heuristics.randomness import random_state
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["ISLANDS", "Archipelago", "ForEach", "crew", "stage"]

ISLANDS = 4
"""Number of islands."""

ROUNDS = 5
"""Number of times that the islands anneal."""

FIRST = 0.4
"""Share of the work that the first round takes; the others share the rest equally."""

HOT, REHEATED, COLD = 1.0, 0.4, 0.1
"""Temperatures at the start of the first and the other rounds, and at the end of each of
them, in mean data of a node."""

PRICE = 0.1
"""Price of a second, in data per second were all data collected in all the time."""

REACH = 60
"""Near nodes that are listed for every node."""

ForEach = Callable[[Callable[[Island], None], Iterable[Island]], None]
"""Calls a function with every island, at the same time or one after the other."""


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
    def around(cls, plan: Plan, problem: TeamOrienteering, rng: np.random.Generator) -> Archipelago:
        """Islands that all start from a plan; nodes that no AUV has time for are left out."""
        network = build_network(problem, REACH)
        stop_of = {int(vertex): stop for stop, vertex in enumerate(network.nodes)}
        trails = [
            tuple(stop_of[vertex] for vertex in route if vertex in stop_of) for route in plan.routes
        ]
        duration = build_chains(network, trails).time
        network = network._replace(limit=np.maximum(network.limit, duration))  # at the very edge
        price = PRICE * problem.total_profit / (float(problem.budgets.sum()) or 1.0)
        return cls(
            tuple(Island.settle(network, trails, price, random_state(rng)) for _ in range(ISLANDS)),
            Pool(network, least=2 * ISLANDS * problem.fleet_size),
        )

    @property
    def leader(self) -> Island:
        """The island with the best routes, the first of equals."""
        return max(self.islands, key=lambda island: island.worth)

    @property
    def objective(self) -> float:
        """Data that the best routes collect."""
        return self.leader.objective

    @property
    def most(self) -> float:
        """Data of all nodes that some AUV has time for."""
        return float(self.leader.network.profit.sum())

    @property
    def plan(self) -> Plan:
        """The best routes."""
        nodes = self.leader.network.nodes
        return Plan.of(nodes[list(trail)] for trail in self.leader.best_trails)

    def run(self, trials: int, part: float, for_each: ForEach) -> None:
        """Make trials on every island, a share `part` of all the work being done."""
        entered, temperature, is_cold = stage(part)
        if entered > self.round:
            self.round = entered
            self._recombine(for_each)
        for_each(lambda island: island.run(trials, temperature), self.islands)
        if is_cold:
            for island in self.islands:
                self.pool.add(island.trails)

    def _recombine(self, for_each: ForEach) -> None:
        for island in self.islands:
            self.pool.add(island.best_trails)
        routes = self.pool.routes()
        explorer = self.islands[-1]
        for_each(
            lambda island: island.recombine(
                routes, self.pool.places(island.best_trails), explore=island is explorer
            ),
            self.islands,
        )


def stage(part: float) -> tuple[int, float, bool]:
    """Round, temperature, and whether it is cold, after a share of all the work.

    In a round the temperature falls geometrically; its second half is cold, where the
    routes are worth remembering.
    """
    if part < FIRST:
        number, within, hot = 0, part / FIRST, HOT
    else:
        later = (ROUNDS - 1) * (part - FIRST) / (1.0 - FIRST)
        number = min(int(later), ROUNDS - 2)
        within, hot = min(later - number, 1.0), REHEATED
        number += 1
    return number, hot * (COLD / hot) ** within, within > 0.5


@contextmanager
def crew(workers: int) -> Iterator[ForEach]:
    """Some threads for the islands; kernels do not hold Python's lock."""

    def in_turn(work: Callable[[Island], Any], islands: Iterable[Island]) -> None:
        for island in islands:
            work(island)

    if workers == 1:
        yield in_turn
        return
    with ThreadPoolExecutor(workers) as threads:

        def at_once(work: Callable[[Island], Any], islands: Iterable[Island]) -> None:
            list(threads.map(work, islands))

        yield at_once
