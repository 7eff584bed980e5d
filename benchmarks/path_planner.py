"""Differential evolution of paths against scipy's, on the same objective, side by side.

    python benchmarks/path_planner.py [--legs N] [--seed N] [--tolerance SHARE]

Both look for the control points of the same spline through the same vortices, and
ask the same compiled kernel for the score of a path: ours from within its own kernels, scipy's
`differential_evolution` from Python. Neither gets the descent that ends `evolve_path`. A row
a leg and a method: the processor time and the paths looked at until the score is within the
tolerance of the best that anyone found, which each method reaches with a budget of
its own, doubled until it does. At the end how much faster ours are, and what
`evolve_path` as a whole takes.
"""

import argparse
import math
import statistics
import time
from collections.abc import Callable

import numpy as np
from scipy.optimize import differential_evolution

from fiveroute.heuristics.randomness import random_state
from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import LambVortices
from fiveroute.paths.differential_evolution import (
    evaluate,
    evolve_adaptive,
    evolve_classic,
    new_population,
)
from fiveroute.paths.evolved_path import evolve_path, path_problem
from fiveroute.paths.legs import Waters
from fiveroute.paths.path_cost import PathProblem

SIDE, SPANS, BOUND, POPULATION = 5000.0, 5, 0.4, 30
LARGEST = 1_000_000  # paths looked at by a method that does not get there

Search = Callable[[PathProblem, int, int], tuple[float, int]]


def vortices(rng: np.random.Generator) -> Waters:
    """Eight vortices on a square of 5 km, and the vehicle of the paper, 1 m/s."""
    current = LambVortices(
        *rng.uniform(0.0, SIDE, (2, 8)), rng.normal(0.0, 900.0, 8), rng.uniform(300.0, 700.0, 8)
    )
    region = Region(-1000.0, -1000.0, SIDE + 1000.0, SIDE + 1000.0)
    return Waters(grid_current(current, region), no_barriers(), 1.0)


def ours(evolve: Callable[..., None]) -> Search:
    def search(problem: PathProblem, evaluations: int, seed: int) -> tuple[float, int]:
        rng = np.random.default_rng(seed)
        bound = np.full(2 * (SPANS + 1), BOUND)
        straight = np.zeros((1, len(bound)))
        population = new_population(straight, bound, POPULATION, evaluations, rng)
        random = random_state(rng)
        while not population.is_spent:
            evolve(problem, population, random, evaluations)
        return float(population.score[population.best]), population.spent

    return search


def theirs(strategy: str) -> Search:
    def search(problem: PathProblem, evaluations: int, seed: int) -> tuple[float, int]:
        size = 2 * (SPANS + 1)
        rng = np.random.default_rng(seed)
        first = rng.uniform(-BOUND, BOUND, (POPULATION, size))
        first[0] = 0.0
        found = differential_evolution(
            lambda genes: evaluate(problem, genes),
            [(-BOUND, BOUND)] * size,
            strategy=strategy,
            init=first,
            maxiter=max(evaluations // POPULATION - 1, 1),
            tol=0.0,
            polish=False,
            rng=rng,
        )
        return float(found.fun), int(found.nfev)

    return search


METHODS: dict[str, Search] = {
    "ours, L-SHADE": ours(evolve_adaptive),
    "ours, rand/1/bin": ours(evolve_classic),
    "scipy, best1bin": theirs("best1bin"),
    "scipy, rand1bin": theirs("rand1bin"),
}


def until(search: Search, problem: PathProblem, target: float, seed: int) -> tuple[float, int]:
    """Processor time and paths looked at with the first doubled budget that reaches the target."""
    evaluations = 500
    while True:
        begun = time.process_time()
        score, spent = search(problem, evaluations, seed)
        seconds = time.process_time() - begun
        if score <= target or evaluations > LARGEST:
            return (seconds if score <= target else math.nan), spent
        evaluations *= 2


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--legs", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tolerance", type=float, default=1e-3)
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    taken: dict[str, list[float]] = {name: [] for name in [*METHODS, "evolve_path"]}
    print(f"{'leg':>3s}  {'method':18s} {'ms':>9s} {'paths':>8s} {'us a path':>10s}  reached")
    for leg in range(-1, options.legs):
        waters = vortices(rng)
        start, goal = np.array([300.0, rng.uniform(500, 4500)]), np.array([4700.0, 2500.0])
        problem = path_problem(waters, start, goal, spans=SPANS)
        evolve_path(waters, start, goal)  # compiles, as does the leg that is not counted
        begun = time.process_time()
        evolve_path(waters, start, goal)
        seconds = time.process_time() - begun
        best = min(METHODS[name](problem, 20_000, 0)[0] for name in list(METHODS)[:2])
        for name, search in METHODS.items():
            if leg < 0 and name.startswith("scipy"):
                continue
            target = best * (1.0 + options.tolerance)
            needed, spent = until(search, problem, target, options.seed)
            if leg < 0:
                continue
            taken[name].append(needed)
            each = 1e6 * needed / spent
            print(f"{leg:3d}  {name:18s} {1e3 * needed:9.2f} {spent:8d} {each:10.2f}  {target:.1f}")
        if leg >= 0:
            taken["evolve_path"].append(seconds)
            print(f"{leg:3d}  {'evolve_path':18s} {1e3 * seconds:9.2f}   (with seeds and descent)")
    print("\nmethod             geometric mean ms   times ours, L-SHADE")
    first = statistics.geometric_mean(taken["ours, L-SHADE"])
    for name, seconds_taken in taken.items():
        mean = statistics.geometric_mean(seconds_taken)
        print(f"{name:18s} {1e3 * mean:17.2f} {mean / first:21.1f}")


if __name__ == "__main__":
    main()
