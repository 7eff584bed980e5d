import math

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import Current, LambVortices, UniformCurrent
from fiveroute.paths.differential_evolution import (
    INFEASIBLE,
    Population,
    Variant,
    control_of,
    evaluate,
    evolve_adaptive,
    evolve_classic,
    evolved_population,
    genes_of,
    new_population,
)
from fiveroute.paths.path_cost import PathProblem, path_cost, path_problem
from fiveroute.paths.waters import Waters
from fiveroute.randomness import random_state

REGION = Region(-500.0, -2000.0, 4500.0, 2000.0)
START, GOAL = np.array([0.0, 0.0]), np.array([3600.0, 1500.0])
VORTEX = LambVortices(np.array([1800.0]), np.array([400.0]), np.array([1500.0]), np.array([600.0]))
EVOLVE = [evolve_classic, evolve_adaptive]


def problem(current: Current, *circles: tuple[float, float, float]) -> PathProblem:
    barriers = no_barriers()._replace(circles=np.array(circles).reshape(-1, 3))
    waters = Waters(grid_current(current, REGION), barriers, 1.0)
    return path_problem(waters, START, GOAL, spans=3)


def evolved(
    of: PathProblem, evolve: object, *, evaluations: int = 4000, seed: int = 1
) -> Population:
    rng = np.random.default_rng(seed)
    bound = np.full(8, 0.4)
    population = new_population(np.zeros((0, 8)), bound, 30, evaluations, rng)
    random = random_state(rng)
    while not population.is_spent:
        evolve(of, population, random, 500)  # type: ignore[operator]
    return population


def test_genes_are_displacements_in_the_frame_of_the_line() -> None:
    of = problem(VORTEX)
    genes = np.random.default_rng(0).normal(0.0, 0.2, 8)
    assert genes_of(of, control_of(of, genes)) == pytest.approx(genes, abs=1e-14)
    assert np.array_equal(control_of(of, np.zeros(8)), of.straight)
    across = control_of(of, np.array([0, 0, 0, 0, 0.1, 0.1, 0.1, 0.1])) - of.straight
    assert (across[1:-1] @ (GOAL - START)) == pytest.approx(0.0, abs=1e-6)
    assert np.hypot(*across[1:-1].T) == pytest.approx(0.1 * math.hypot(3600.0, 1500.0))


def test_any_path_that_keeps_the_rules_beats_any_that_does_not() -> None:
    of = problem(UniformCurrent(0.0, 0.0), (1800.0, 750.0, 300.0))
    around = np.array([0.0, 0, 0, 0, 0.9, 0.9, 0.9, 0.9])
    through = np.zeros(8)
    assert path_cost(of, control_of(of, through))[0] < path_cost(of, control_of(of, around))[0]
    assert evaluate(of, around) < INFEASIBLE < evaluate(of, through)
    assert evaluate(of, around / 20.0) < evaluate(of, through)  # less deep inside


@pytest.mark.parametrize("evolve", EVOLVE)
def test_evolution_straightens_paths_in_still_water(evolve: object) -> None:
    population = evolved(problem(UniformCurrent(0.0, 0.0)), evolve, evaluations=8000)
    best = population.score[population.best]
    length = float(np.hypot(*(GOAL - START)))
    assert length * (1.0 - 1e-12) <= best < length * 1.0005


@pytest.mark.parametrize("evolve", EVOLVE)
def test_evolution_finds_the_favourable_side_of_a_vortex(evolve: object) -> None:
    of = problem(VORTEX)
    population = evolved(of, evolve)
    assert population.score[population.best] < 0.97 * path_cost(of, of.straight)[0]


@pytest.mark.parametrize("evolve", EVOLVE)
def test_the_same_seed_gives_the_same_population(evolve: object) -> None:
    of = problem(VORTEX, (1800.0, 750.0, 300.0))
    one, two = (evolved(of, evolve, evaluations=900) for _ in range(2))
    other = evolved(of, evolve, evaluations=900, seed=2)
    assert np.array_equal(one.genes, two.genes)
    assert not np.array_equal(one.genes, other.genes)


@pytest.mark.parametrize("evolve", EVOLVE)
def test_evolution_never_loses_its_best_and_stays_in_bounds(evolve: object) -> None:
    of = problem(VORTEX, (1800.0, 750.0, 300.0))
    rng = np.random.default_rng(4)
    population = new_population(np.zeros((1, 8)), np.full(8, 0.3), 20, 600, rng)
    random, best = random_state(rng), math.inf
    while not population.is_spent:
        evolve(of, population, random, 1)  # type: ignore[operator]
        now = population.score[population.best]
        assert now <= best
        best = now
        assert np.abs(population.genes).max() <= 0.3
    assert best < INFEASIBLE
    assert evaluate(of, population.genes[population.best]) == best
    assert population.spent < 600 + 20


def test_the_adaptive_population_shrinks_to_four() -> None:
    population = evolved(problem(VORTEX), evolve_adaptive, evaluations=2000)
    assert population.counts[2] == 4
    assert ((population.memory > 0.0) & (population.memory <= 1.0)).any()


def test_seeds_come_first_and_are_kept_within_bounds() -> None:
    seeds = np.array([[0.1] * 8, [9.0] * 8])
    population = new_population(seeds, np.full(8, 0.5), 10, 100, np.random.default_rng(0))
    assert population.genes[0] == pytest.approx(0.1)
    assert population.genes[1] == pytest.approx(0.5)
    assert population.genes.shape == (10, 8)


@pytest.mark.parametrize("variant", ["l-shade", "rand/1/bin"])
def test_a_population_evolves_from_all_first_paths(variant: Variant) -> None:
    of = problem(VORTEX)
    first = [control_of(of, np.full(8, 0.01 * k)) for k in range(9)]
    times = [path_cost(of, control)[0] for control in first]
    for evaluations in (0, 500):
        population = evolved_population(
            of,
            first,
            variant=variant,
            size=4,
            evaluations=evaluations,
            rng=np.random.default_rng(0),
            clock=Limits().start(),
        )
        best = population.score[population.best]
        if evaluations:
            assert best < min(times)
        else:
            assert best == pytest.approx(min(times), rel=1e-12)
