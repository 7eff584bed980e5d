"""Differential evolution of paths: the classic scheme and L-SHADE, under feasibility first.

The genes of a path are the displacements of its interior control points from the straight line,
along and across it, in units of its length. A trial replaces its parent if it is no worse by
Deb's rules: a path that keeps all rules beats one that does not, of two that do the faster one
wins, of two that do not the one of less violation. One number orders paths so, their score.

Classic DE/rand/1/bin makes the trial v = x_a + F (x_b - x_c) of three others and takes each gene
from v with the probability CR, at least one.

L-SHADE makes v = x_i + F (x_p - x_i) + F (x_a - x_b), where x_p is one of the best, and x_b may
come from an archive of parents that lost; F and CR are drawn around values that led to
successes before; the population shrinks linearly to four.

References
----------
R. Storn and K. Price, "Differential evolution", Journal of Global Optimization 11 (1997),
doi 10.1023/A:1008202821328. K. Deb, "An efficient constraint handling method for genetic
algorithms", Computer Methods in Applied Mechanics and Engineering 186 (2000),
doi 10.1016/S0045-7825(99)00389-8. R. Tanabe and A. S. Fukunaga, "Improving the search
performance of SHADE using linear population size reduction", CEC 2014,
doi 10.1109/CEC.2014.6900380.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.limits import Clock
from fiveroute.paths.path_cost import PathProblem, path_cost
from fiveroute.randomness import RandomState, below, random_state, uniform

__all__ = [
    "INFEASIBLE",
    "Population",
    "Variant",
    "control_of",
    "evaluate",
    "evolve_adaptive",
    "evolve_classic",
    "evolved_population",
    "genes_of",
    "new_population",
]

Variant = Literal["l-shade", "rand/1/bin"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

INFEASIBLE = 1e9
"""Scores from here on are those of paths that break a rule."""

_FACTOR, _CROSSOVER = 0.5, 0.9  # F and CR of the classic scheme
_MEMORY = 6  # pairs of F and CR that L-SHADE remembers
_BEST = 0.11  # share of the population that counts as its best
_ARCHIVE = 2.6  # size of the archive in populations
_FEWEST = 4  # paths that L-SHADE ends with

_SLICE = 20_000  # paths looked at between two looks at the clock
_REACH = 0.4  # least bound of the genes, as a share of the line

_SPENT, _BUDGET, _ALIVE, _ARCHIVED, _NEXT = range(5)


class Population(NamedTuple):
    """A population on its way; kernels change it in place.

    Parameters
    ----------
    genes
        A path a row, shape (p, d).
    score
        Of each path, shape (p,).
    bound
        Largest size of each gene, shape (d,).
    archive
        Parents that lost, shape (a, d).
    memory
        F and CR that were successful, shape (h, 2).
    counts
        Paths looked at, their greatest number, paths alive, parents in the archive, and the
        memory's next place, shape (5,).
    """

    genes: Floats
    score: Floats
    bound: Floats
    archive: Floats
    memory: Floats
    counts: Integers

    @property
    def best(self) -> int:
        """Index of the best path alive."""
        return int(np.argmin(self.score[: self.counts[_ALIVE]]))

    @property
    def spent(self) -> int:
        """Paths looked at so far."""
        return int(self.counts[_SPENT])

    @property
    def is_spent(self) -> bool:
        """Whether as many paths were looked at as may be."""
        return bool(self.counts[_SPENT] >= self.counts[_BUDGET])


def new_population(
    seeds: Floats, bound: Floats, size: int, evaluations: int, rng: np.random.Generator
) -> Population:
    """The seeds, as far as they fit, and random paths of all sizes beside them.

    Parameters
    ----------
    seeds
        Genes of paths to begin with, shape (s, d).
    bound
        Largest size of each gene, shape (d,).
    size
        Paths in the population.
    evaluations
        Greatest number of paths looked at, the first ones included.
    rng
        Source of the random paths.
    """
    known, many = seeds[:size], max(size - len(seeds), 0)
    swing = rng.uniform(0.0, 1.0, (many, 1)) ** 2
    random = swing * rng.uniform(-1.0, 1.0, (many, len(bound))) * bound
    genes = np.clip(np.concatenate([known, random]), -bound, bound)
    archive = np.zeros((int(_ARCHIVE * size), len(bound)))
    counts = np.array([0, evaluations, size, 0, 0], dtype=np.int64)
    return Population(
        genes, np.full(size, np.inf), bound, archive, np.full((_MEMORY, 2), 0.5), counts
    )


@kernel
def control_of(problem: PathProblem, genes: Floats) -> Floats:
    """Control points by genes: first all displacements along the line, then those across."""
    control = problem.straight.copy()
    last, interior = len(control) - 1, len(control) - 2
    x, y = control[last] - control[0]
    for i in range(interior):
        along, across = genes[i], genes[interior + i]
        control[i + 1, 0] += along * x - across * y
        control[i + 1, 1] += along * y + across * x
    return control


def evolved_population(
    problem: PathProblem,
    first: Sequence[Floats],
    *,
    variant: Variant = "l-shade",
    size: int = 20,
    evaluations: int = 400,
    rng: np.random.Generator,
    clock: Clock,
) -> Population:
    """Let paths evolve from first ones, by their control points, and random ones beside them.

    All first paths are taken, and all of them looked at, whatever `size` and `evaluations` say.
    """
    seeds = np.stack([genes_of(problem, control) for control in first])
    reach = np.maximum(1.5 * np.abs(seeds).max(axis=0), _REACH)
    size = max(size, len(seeds))
    population = new_population(seeds, reach, size, max(evaluations, size), rng)
    evolve = evolve_adaptive if variant == "l-shade" else evolve_classic
    random = random_state(rng)
    while True:
        evolve(problem, population, random, _SLICE)
        if population.is_spent or clock.expired:
            return population


def genes_of(problem: PathProblem, control: Floats) -> Floats:
    """Genes by control points, the inverse of `control_of`."""
    x, y = line = problem.straight[-1] - problem.straight[0]
    moved = (control - problem.straight)[1:-1]
    frame = np.array([[x, -y], [y, x]]) / (line @ line)
    return np.asarray((moved @ frame).T.ravel())


@kernel
def evaluate(problem: PathProblem, genes: Floats) -> float:
    """Score of a path: its time, or `INFEASIBLE` and its violation."""
    time, violation = path_cost(problem, control_of(problem, genes))
    return time if violation == 0.0 else INFEASIBLE + violation


@kernel
def evolve_classic(
    problem: PathProblem, population: Population, random: RandomState, evaluations: int
) -> None:
    """Go on with DE/rand/1/bin for about so many evaluations, or until all are spent."""
    counts, genes, score = population.counts, population.genes, population.score
    until = min(counts[_SPENT] + evaluations, counts[_BUDGET])
    _evaluate_first(problem, population)
    while counts[_SPENT] < until:
        for i in range(len(genes)):
            a, b = below(random, len(genes)), below(random, len(genes))
            c = below(random, len(genes))
            mutant = genes[a] + _FACTOR * (genes[b] - genes[c])
            trial = _crossed(genes[i], mutant, _CROSSOVER, population.bound, random)
            value = evaluate(problem, trial)
            if value <= score[i]:
                genes[i], score[i] = trial, value
        counts[_SPENT] += len(genes)


@kernel
def evolve_adaptive(
    problem: PathProblem, population: Population, random: RandomState, evaluations: int
) -> None:
    """Go on with L-SHADE for about so many evaluations, or until all are spent."""
    counts = population.counts
    until = min(counts[_SPENT] + evaluations, counts[_BUDGET])
    _evaluate_first(problem, population)
    while counts[_SPENT] < until:
        alive = counts[_ALIVE]
        won = np.zeros((alive, 3))
        ranking = np.argsort(population.score[:alive])
        for i in range(alive):
            _one_trial(problem, population, i, ranking, won[i], random)
        counts[_SPENT] += alive
        _remember(population, won)
        _shrink(population)


@kernel
def _evaluate_first(problem: PathProblem, population: Population) -> None:
    """Score the first population."""
    if population.counts[_SPENT] == 0:
        for i in range(len(population.genes)):
            population.score[i] = evaluate(problem, population.genes[i])
        population.counts[_SPENT] = len(population.genes)


@kernel
def _crossed(
    parent: Floats, mutant: Floats, crossover: float, bound: Floats, random: RandomState
) -> Floats:
    """Binomial crossover; a gene out of bounds goes halfway from the parent to the bound."""
    sure = below(random, len(parent))
    trial = parent.copy()
    for g in range(len(parent)):
        if g == sure or uniform(random) < crossover:
            trial[g] = mutant[g]
            if abs(trial[g]) > bound[g]:
                trial[g] = 0.5 * (parent[g] + math.copysign(bound[g], trial[g]))
    return trial


@kernel
def _one_trial(
    problem: PathProblem,
    population: Population,
    i: int,
    ranking: Integers,
    won: Floats,
    random: RandomState,
) -> None:
    """Let a path compete with one trial; `won` takes F, CR and the gain of a success."""
    counts, genes, score = population.counts, population.genes, population.score
    alive, archived = counts[_ALIVE], counts[_ARCHIVED]
    factor, crossover = _drawn(population.memory, random)
    p = ranking[below(random, max(round(_BEST * alive), 2))]
    a, b = below(random, alive), below(random, alive + archived)
    other = genes[b] if b < alive else population.archive[b - alive]
    mutant = genes[i] + factor * (genes[p] - genes[i]) + factor * (genes[a] - other)
    trial = _crossed(genes[i], mutant, crossover, population.bound, random)
    value = evaluate(problem, trial)
    if value < score[i]:
        won[0], won[1], won[2] = factor, crossover, score[i] - value
        room = int(_ARCHIVE * alive)
        place = archived if archived < room else below(random, room)
        population.archive[place] = genes[i]
        counts[_ARCHIVED] = max(archived, place + 1)
    if value <= score[i]:
        genes[i], score[i] = trial, value


@kernel
def _drawn(memory: Floats, random: RandomState) -> tuple[float, float]:
    """F by a Cauchy, CR by a normal distribution around a remembered pair."""
    factor, crossover = memory[below(random, len(memory))]
    drawn = 0.0
    while drawn <= 0.0:
        drawn = factor + 0.1 * math.tan(math.pi * (uniform(random) - 0.5))
    radius = math.sqrt(-2.0 * math.log(1.0 - uniform(random)))
    normal = radius * math.cos(2.0 * math.pi * uniform(random))
    return min(drawn, 1.0), min(max(crossover + 0.1 * normal, 0.0), 1.0)


@kernel
def _remember(population: Population, won: Floats) -> None:
    """Lehmer means of the successful F and CR, weighted by what they gained."""
    gained = won[:, 2].sum()
    if gained <= 0.0:
        return
    place = population.counts[_NEXT]
    for column in range(2):
        mean = (won[:, 2] * won[:, column]).sum()
        square = (won[:, 2] * won[:, column] ** 2).sum()
        population.memory[place, column] = square / mean if mean > 0.0 else 0.0
    population.counts[_NEXT] = (place + 1) % len(population.memory)


@kernel
def _shrink(population: Population) -> None:
    """Leave as many of the best as the share of the evaluations that is left allows."""
    counts, genes, score = population.counts, population.genes, population.score
    share = min(counts[_SPENT] / counts[_BUDGET], 1.0)
    left = max(round(len(genes) - (len(genes) - _FEWEST) * share), _FEWEST)
    if left < counts[_ALIVE]:
        order = np.argsort(score[: counts[_ALIVE]])[:left]
        genes[:left], score[:left] = genes[order], score[order]
        counts[_ALIVE] = left
        counts[_ARCHIVED] = min(counts[_ARCHIVED], int(_ARCHIVE * left))
