"""S-GGARP, the operator T of (20): the best route of one AUV over its candidate nodes.

A genetic algorithm with a greedy strategy for the orienteering problem (19) under the time
limit (6). An individual is a route. Every new one, however it came about, goes through
the rebirth operator, which makes it feasible and full (`fiveroute.heuristics.rebirth`).
S-GGARP judges a route by a statistic of K sampled durations; GGA is its special case with
the planned times. More data is better, and of equal data less time.

References
----------
J. Zhang, M. Liu, S. Zhang, R. Zheng, S. Dong, "Robust global route planning for an
autonomous underwater vehicle in a stochastic environment", Frontiers of Information
Technology & Electronic Engineering 23(11), 2022, doi 10.1631/FITEE.2200026.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.heuristics.rebirth import rebirth
from fiveroute.heuristics.route_kernels import Case, collected, duration, in_time
from fiveroute.heuristics.variation import crossover, mutate, random_route
from fiveroute.kernels import kernel
from fiveroute.limits import Clock, Limits
from fiveroute.problem import TeamOrienteering
from fiveroute.randomness import RandomState, below, random_state, uniform
from fiveroute.routes import Route
from fiveroute.sampling import SampledLegs
from fiveroute.stops import Stops

__all__ = ["Genetics", "optimise_route"]


@dataclass(frozen=True, slots=True)
class Genetics:
    """Parameters of the genetic algorithm.

    Parameters
    ----------
    population
        Number of individuals, and of children in a generation.
    generations
        Largest number of generations.
    patience
        Generations without a better route after which to stop.
    mutation
        Probability that a child mutates; the child of a single parent always does.
    noise
        Largest share by which chance lowers the data of a node in the rebirth of a child.
    """

    population: int = 20
    generations: int = 120
    patience: int = 20
    mutation: float = 0.9
    noise: float = 0.6


def optimise_route(
    problem: TeamOrienteering,
    auv: int,
    route: Sequence[int],
    idle: Iterable[int],
    *,
    rng: np.random.Generator,
    sampled: SampledLegs | None = None,
    genetics: Genetics = Genetics(),
    clock: Clock | None = None,
) -> Route:
    """Improve the route of one AUV over its own and some idle nodes.

    Parameters
    ----------
    problem
        The problem; only the budget of this AUV counts.
    auv
        The AUV, counted from 0.
    route
        Its present route; it may be too long.
    idle
        Nodes that it may visit besides those of the present route.
    rng
        Random numbers.
    sampled
        Sampled leg times for S-GGARP; None plans with the planned ones, which is GGA.
    genetics
        Parameters of the search.
    clock
        Ends the search early; no limit without one.

    Returns
    -------
    Route
        The best route found; `route` itself where no better one is in time.
    """
    clock = clock or Limits().start()
    if clock.expired:
        return tuple(route)
    nodes = np.array([0, *sorted({*route, *idle}), problem.destination])
    case = _case(problem, auv, nodes, sampled)
    state = random_state(rng)
    population = _founders(case, np.searchsorted(nodes, route), genetics, state, clock)
    leader, stale = _leader(population), 0
    for _ in range(genetics.generations):
        if stale >= genetics.patience or clock.expired:
            break
        before = population.profit[leader], population.time[leader]
        _breed(case, population, genetics.mutation, genetics.noise, state)
        leader = _leader(population)
        after = population.profit[leader], population.time[leader]
        stale = stale + 1 if before == after else 0
    if population.profit[leader] < 0.0:
        return tuple(route)
    inner = population.stops[leader, 1 : population.length[leader] - 1]
    return tuple(nodes[inner].tolist())


def _case(
    problem: TeamOrienteering,
    auv: int,
    nodes: NDArray[np.int64],
    sampled: SampledLegs | None,
) -> Case:
    """Cut the candidate nodes out of the problem."""
    rows, columns = np.ix_(nodes, nodes)
    travel = problem.travel[rows, columns]
    service = problem.service[nodes]
    needed, samples = 0, np.empty((1, 1, 0))
    if sampled is not None:
        drawn = sampled.legs[:, rows, columns]
        travel = drawn.mean(axis=0)
        needed = sampled.statistic.needed(len(drawn))
        if needed:
            samples = np.ascontiguousarray(np.moveaxis(drawn + service, 0, -1))
    allowed = float(problem.allowed[auv]) * (1.0 - 1e-12)  # the judge may add up otherwise
    return Case(travel + service, problem.profit[nodes], allowed, samples, needed)


class _Population(NamedTuple):
    """Individuals in no order; an empty place holds an empty route of profit -1."""

    stops: Stops  # shape (population, k + 2)
    length: NDArray[np.int64]
    profit: NDArray[np.float64]
    time: NDArray[np.float64]


def _founders(
    case: Case, route: NDArray[np.int64], genetics: Genetics, state: RandomState, clock: Clock
) -> _Population:
    """The present route as it is and reborn, and random routes reborn."""
    size, end = genetics.population, len(case.profit) - 1
    population = _Population(
        np.zeros((size, end + 1), np.int64), np.full(size, 2), np.full(size, -1.0), np.zeros(size)
    )
    population.stops[:, 1] = end
    stops = np.full(end + 1, end)
    stops[: len(route) + 1] = 0, *route
    _admit(case, population, stops, len(route) + 2)
    length = rebirth(case, stops, len(route) + 2, 0.0, state)
    _admit(case, population, stops, length)
    for _ in range(2, size):
        if clock.expired:
            break
        length = rebirth(case, stops, random_route(case.legs, stops, state), genetics.noise, state)
        _admit(case, population, stops, length)
    return population


@kernel
def _breed(
    case: Case, population: _Population, mutation: float, noise: float, state: RandomState
) -> None:
    """One generation: as many children as individuals, each admitted if it is good enough."""
    stops, lengths = population.stops, population.length
    child = np.empty(len(case.profit), np.int64)
    for _ in range(len(lengths)):
        one, two = _tournament(population, state), _tournament(population, state)
        length = crossover(stops[one], lengths[one], stops[two], lengths[two], child, state)
        if one == two or uniform(state) < mutation:
            length = mutate(case.legs, child, length, state)
        length = rebirth(case, child, length, noise, state)
        _admit(case, population, child, length)


@kernel
def _admit(case: Case, population: _Population, stops: Stops, length: int) -> None:
    """Let a route that is in time replace the worst individual, unless it has a twin."""
    if not in_time(case, stops, length):
        return
    profit = collected(case.profit, stops, length)
    time = duration(case.legs, stops, length)
    worst = 0
    for i in range(len(population.length)):
        alike = abs(population.profit[i] - profit) <= 1e-9 * profit
        if alike and abs(population.time[i] - time) <= 1e-9 * time:
            return
        if _is_better(population, worst, population.profit[i], population.time[i]):
            worst = i
    if not _is_better(population, worst, profit, time):
        population.stops[worst] = stops
        population.length[worst] = length
        population.profit[worst] = profit
        population.time[worst] = time


@kernel
def _tournament(population: _Population, state: RandomState) -> int:
    one = below(state, len(population.length))
    two = below(state, len(population.length))
    return one if _is_better(population, one, population.profit[two], population.time[two]) else two


@kernel
def _leader(population: _Population) -> int:
    leader = 0
    for i in range(1, len(population.length)):
        if _is_better(population, i, population.profit[leader], population.time[leader]):
            leader = i
    return leader


@kernel
def _is_better(population: _Population, one: int, profit: float, time: float) -> bool:
    """Whether individual `one` collects more, or as much in less time."""
    ahead = population.profit[one] - profit
    if abs(ahead) > 1e-9 * profit:
        return bool(ahead > 0.0)
    return bool(population.time[one] < time)
