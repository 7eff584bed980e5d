"""The giant route: one route through every node, equations (13) and (14) of the paper.

A genetic algorithm on the symmetric travelling salesman problem of
`fiveroute.heuristics.tour.graph`. One *epoch* is the whole of it:

1. a population of greedy tours with noise, each improved by Lin-Kernighan moves;
2. edge assembly crossover with single AB-cycles: in every generation each tour gives way to
   its best child with the next one of a random ring;
3. the same with blocks of AB-cycles, once single ones no longer shorten any tour.

Then the best tours of all epochs so far are crossed with each other. The search ends when
several independent epochs agree on the best length, or the limits say so.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import dataclass, field
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.tour.crossover import Population, crossover, start_population
from fiveroute.heuristics.tour.graph import Graph, giant_graph, route_of, tour_cost
from fiveroute.heuristics.tour.greedy import greedy_tour
from fiveroute.heuristics.tour.local_search import improve, start_search
from fiveroute.limits import Clock, Limits, Progress, ProgressCallback
from fiveroute.problem import TeamOrienteering
from fiveroute.randomness import RandomState, random_state
from fiveroute.routes import Route

__all__ = ["ROUTES", "giant_routes"]

ROUTES = 16
"""Most routes that are returned."""

_TINY = 5
"""Up to this many nodes all routes are enumerated."""

_AGREEMENT = 4
"""Independent epochs that must end at the best length for an early stop."""

_STALL = 30
"""Generations without a shorter best tour that end a stage of an epoch."""

_NOISE = 2.0
"""Greedy edges count up to this share more than their length, at random."""

_ELITE = 4
"""Tours that an epoch contributes to the crossing of the best."""

_BUILDING = 0.2
"""Share of the time left that building a population may take."""

_LEAST = 8
"""Tours in the smallest population."""

_WORK = 8_000
"""Vertices that one call of the local search looks at: about 0.1 s."""

_ROUNDING = 1e-12
"""Relative difference of tour lengths that is put down to rounding."""


def giant_routes(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    rng: np.random.Generator,
    population: int | None = None,
    progress: ProgressCallback | None = None,
) -> tuple[Route, ...]:
    """Short routes from start to destination through all nodes.

    Parameters
    ----------
    problem
        The problem; its budgets are ignored.
    limits
        When to stop; without a time limit the search ends by itself.
    rng
        Source of randomness. The same seed gives the same routes unless a limit cuts in.
    population
        Tours in one population, at least 2; None chooses by the size of the problem.
    progress
        Told the duration of the best route after every generation.

    Returns
    -------
    tuple of Route
        Up to `ROUTES` different routes, the best first; at least one.
    """
    clock = (limits or Limits()).start()
    if problem.n <= _TINY:
        return _ranked(problem, list(permutations(range(1, problem.n + 1))))
    graph = giant_graph(problem, clock)
    if graph is None:
        return (_nearest_neighbour(problem),)
    search = _Search.of(problem, graph, clock, rng, progress)
    tours = wanted = max(population or _population_size(graph), 2)
    epochs = math.inf if math.isfinite(clock.limits.time) else _most_epochs(graph)
    bests: list[float] = []
    elite: list[NDArray[np.int64]] = []
    while not bests or not (clock.expired or len(bests) >= epochs or search.agrees(bests)):
        began = clock.seconds
        last = search.epoch(tours)
        bests.append(float(last.lengths.min()))
        elite += _shortest(last)
        if len(bests) > 1:
            search.evolve(start_population(graph, np.array(elite)))
        tours = _fitting(wanted, (clock.seconds - began) / tours, clock.left)
    return _ranked(problem, [route_of(graph, order) for order in search.hall.orders])


def _population_size(graph: Graph) -> int:
    """Three tours for every five nodes, but 30 to 100, and 30 for thousands of vertices."""
    return max(30, min(3 * graph.nodes // 5, 100, 150_000 // graph.size))


def _most_epochs(graph: Graph) -> int:
    """Epochs after which a run without a time limit ends, agreed or not."""
    return 12 if graph.size <= 300 else 3 if graph.size <= 1_500 else 1


def _fitting(tours: int, seconds_each: float, left: float) -> int:
    """Population for which a whole number of epochs fills the time left."""
    if math.isinf(left):
        return tours
    epochs = max(1, round(left / (tours * seconds_each)))
    return max(_LEAST, min(2 * tours, int(0.9 * left / (epochs * seconds_each))))


@dataclass(slots=True)
class _Hall:
    """The shortest tours seen, of pairwise different lengths, shortest first."""

    lengths: list[float] = field(default_factory=list)
    orders: list[NDArray[np.int64]] = field(default_factory=list)

    def admit_all(self, population: Population) -> None:
        """Keep the shortest tours of a population."""
        for order, length in zip(population.orders, population.lengths.tolist(), strict=True):
            self.admit(order, length)

    def admit(self, order: NDArray[np.int64], length: float) -> None:
        """Keep a copy of one tour, if it is among the shortest and its length is new."""
        if len(self.lengths) == ROUTES and length >= self.lengths[-1]:
            return
        at = bisect_left(self.lengths, length)
        for rival in self.lengths[max(at - 1, 0) : at + 1]:
            if abs(rival - length) <= 1e3 * _ROUNDING * length:
                return
        self.lengths.insert(at, length)
        self.orders.insert(at, order.copy())
        del self.lengths[ROUTES:], self.orders[ROUTES:]


@dataclass(frozen=True, slots=True)
class _Search:
    """One run: what it works on, and the best that it has seen."""

    graph: Graph
    clock: Clock
    rng: np.random.Generator
    state: RandomState
    offset: float
    progress: ProgressCallback | None
    hall: _Hall = field(default_factory=_Hall)

    @classmethod
    def of(
        cls,
        problem: TeamOrienteering,
        graph: Graph,
        clock: Clock,
        rng: np.random.Generator,
        progress: ProgressCallback | None,
    ) -> _Search:
        """`offset` turns the length of a tour into the duration of its route."""
        offset = float(problem.service.sum() - problem.travel[0, -1])
        return cls(graph, clock, rng, random_state(rng), offset, progress)

    def agrees(self, bests: list[float]) -> bool:
        """Whether enough epochs ended at the best length of all."""
        if not bests:
            return False
        best = self.hall.lengths[0]
        return sum(b <= best * (1.0 + 1e3 * _ROUNDING) for b in bests) >= _AGREEMENT

    def epoch(self, tours: int) -> Population:
        """Breed a fresh population."""
        population = start_population(self.graph, np.array(self.local_optima(tours)))
        self.evolve(population)
        return population

    def local_optima(self, tours: int) -> list[NDArray[np.int64]]:
        """Start tours, fewer where time is short, but at least one."""
        until = self.clock.seconds + _BUILDING * self.clock.left
        orders: list[NDArray[np.int64]] = []
        while len(orders) < tours:
            if self.clock.expired or (self.clock.seconds > until and len(orders) >= _LEAST):
                break
            start = greedy_tour(self.graph, _NOISE, self.rng)
            tolerance = _ROUNDING * tour_cost(self.graph, start)
            local = start_search(start)
            while not improve(self.graph, local, _WORK, tolerance) and not self.clock.expired:
                pass
            orders.append(local.tour.order)
        return orders or [greedy_tour(self.graph, _NOISE, self.rng)]

    def evolve(self, population: Population) -> None:
        """Breed single AB-cycles, then blocks, each until nothing more is gained."""
        self.note(population)
        for block in (False, True):
            best, stalled = float(population.lengths.min()), 0
            while stalled < _STALL and not self.clock.expired:
                gained = self.generation(population, block)
                self.note(population)
                shortest = float(population.lengths.min())
                stalled = 0 if shortest < best else stalled + 1
                best = shortest
                if gained == 0.0:
                    break

    def generation(self, population: Population, block: bool) -> float:
        """Each tour in turn is crossed with the next one of a random ring."""
        tolerance = _ROUNDING * float(population.lengths.max())
        ring = self.rng.permutation(len(population.lengths))
        gained = 0.0
        for a, b in zip(ring, np.roll(ring, -1), strict=True):
            if self.clock.expired:
                break
            gained += crossover(
                self.graph, population, int(a), int(b), block, tolerance, self.state
            )
        return gained

    def note(self, population: Population) -> None:
        """Remember the shortest tours and report the best."""
        self.hall.admit_all(population)
        if self.progress is not None:
            duration = self.hall.lengths[0] + self.offset
            self.progress(Progress(self.clock.seconds, objective=duration))


def _shortest(population: Population) -> list[NDArray[np.int64]]:
    """The shortest tours of pairwise different lengths."""
    hall = _Hall()
    hall.admit_all(population)
    return hall.orders[:_ELITE]


def _ranked(problem: TeamOrienteering, routes: list[Route]) -> tuple[Route, ...]:
    """The best of the different routes by their true durations, best first."""
    return tuple(sorted(set(routes), key=lambda route: (problem.duration(route), route))[:ROUTES])


def _nearest_neighbour(problem: TeamOrienteering) -> Route:
    """A route for runs without time: always on to the nearest node left."""
    left = np.ones(problem.n + 2, dtype=np.bool_)
    left[[0, -1]] = False
    route: list[int] = []
    while left.any():
        nodes = np.flatnonzero(left)
        nearest = int(nodes[problem.travel[route[-1] if route else 0, nodes].argmin()])
        route.append(nearest)
        left[nearest] = False
    return tuple(route)
