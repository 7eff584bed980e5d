"""Differential evolution of paths against scipy's, on the same objective, side by side.

    python benchmarks/path_planner.py [--legs N] [--seed N]

Both look for the control points of the same spline through the same eight vortices, and both
ask the same compiled kernel for the score of a path: ours from within its own kernels, scipy's
`differential_evolution` from Python. Scipy goes first, as it comes but for the strategy, and with
the straight line to begin with; what it reaches, to 0.01 %, is the quality asked of ours, whose
budget is doubled from a small one until a run reaches it, and that run is timed. Ours is the
planner as it is (seeds, L-SHADE, descent), and for comparison each scheme of evolution alone.
All times are processor time.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

from fiveroute.limits import Limits
from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import LambVortices
from fiveroute.paths.differential_evolution import (
    Variant,
    control_of,
    evaluate,
    evolved_population,
    genes_of,
)
from fiveroute.paths.first_paths import first_controls
from fiveroute.paths.path_cost import PathProblem, path_problem
from fiveroute.paths.polish import polish
from fiveroute.paths.waters import Waters

SIDE, SPANS, BOUND, WEIGHT = 5000.0, 5, 0.4, 0.02
SAME = 1.0 + 1e-4  # times scipy's score: as good
FEWEST, MOST = 100, 500_000  # paths looked at

Search = Callable[[PathProblem, int, int], float]


def vortices(rng: np.random.Generator) -> Waters:
    """Eight vortices on a square of 5 km, and an AUV at 1 m/s."""
    current = LambVortices(
        *rng.uniform(0.0, SIDE, (2, 8)), rng.normal(0.0, 900.0, 8), rng.uniform(300.0, 700.0, 8)
    )
    region = Region(-1000.0, -1000.0, SIDE + 1000.0, SIDE + 1000.0)
    return Waters(grid_current(current, region), no_barriers(), 1.0)


def evolution(problem: PathProblem, evaluations: int, seed: int, *, variant: Variant) -> float:
    """Evolution alone, from the straight line and random paths."""
    population = evolved_population(
        problem,
        [problem.straight],
        variant=variant,
        size=20,
        evaluations=evaluations,
        rng=np.random.default_rng(seed),
        clock=Limits().start(),
    )
    return float(population.score[population.best])


def planner(problem: PathProblem, evaluations: int, seed: int) -> float:
    """First paths, evolution and descent, as `evolve_path` puts them together."""
    first = first_controls(problem, (), WEIGHT, 4)
    population = evolved_population(
        problem,
        first,
        evaluations=evaluations,
        rng=np.random.default_rng(seed),
        clock=Limits().start(),
    )
    control = control_of(problem, population.genes[population.best])
    polish(problem, control, WEIGHT, 30)
    return evaluate(problem, genes_of(problem, control))


def scipy(problem: PathProblem, seed: int, strategy: str) -> tuple[float, int]:
    """Score and paths looked at by scipy's evolution, and its own polish, as they come."""

    def score(genes: NDArray[np.float64]) -> float:
        return evaluate(problem, genes)

    size = 2 * (SPANS + 1)
    found = differential_evolution(
        score, [(-BOUND, BOUND)] * size, strategy=strategy, x0=np.zeros(size), rng=seed
    )
    return float(found.fun), int(found.nfev)


OURS: dict[str, Search] = {
    "ours": planner,
    "ours, L-SHADE alone": partial(evolution, variant="l-shade"),
    "ours, rand/1/bin alone": partial(evolution, variant="rand/1/bin"),
}


def until(search: Search, problem: PathProblem, target: float, seed: int) -> tuple[float, int]:
    """Processor time and budget of the first budget, doubled again and again, that gets there."""
    evaluations = FEWEST
    while True:
        begun = time.process_time()
        score = search(problem, evaluations, seed)
        seconds = time.process_time() - begun
        if score <= target:
            return seconds, evaluations
        if evaluations > MOST:
            return float("inf"), evaluations
        evaluations *= 2


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--legs", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = np.random.default_rng(options.seed)
    print(f"{'leg':>3s}  {'scipy':9s} {'reached s':>10s} {'paths':>7s} {'ms':>8s}", end="")
    print("".join(f"  {name:>24s}" for name in OURS), "  (budget, ms, times faster)")
    theirs: dict[str, float] = {}
    spent: dict[tuple[str, str], float] = {}
    ratios: dict[str, list[float]] = {name: [] for name in OURS}
    for leg in range(options.legs):
        ends = np.array([[300.0, 4700.0], rng.uniform(500.0, 4500.0, 2)]).T
        problem = path_problem(vortices(rng), *np.ascontiguousarray(ends), spans=SPANS)
        for search in OURS.values():
            search(problem, FEWEST, 0)  # compiles, the first time
        for strategy in ("best1bin", "rand1bin"):
            begun = time.process_time()
            reached, paths = scipy(problem, options.seed, strategy)
            seconds = time.process_time() - begun
            theirs[strategy] = theirs.get(strategy, 0.0) + seconds
            print(
                f"{leg:3d}  {strategy:9s} {reached:10.3f} {paths:7d} {1e3 * seconds:8.1f}", end=""
            )
            for name, search in OURS.items():
                needed, budget = until(search, problem, SAME * reached, options.seed)
                ratios[name].append(seconds / needed)
                spent[name, strategy] = spent.get((name, strategy), 0.0) + needed
                print(f"  {budget:7d} {1e3 * needed:8.2f} {seconds / needed:7.1f}", end="")
            print()
    for name, faster in ratios.items():
        middle = statistics.median(faster)
        print(f"{name:24s} {middle:7.1f} times faster in the median, at least {min(faster):.1f}")
        for strategy, seconds in theirs.items():
            ratio = seconds / spent[name, strategy]
            print(f"{'':24s} {ratio:7.1f} times in total against {strategy}")


if __name__ == "__main__":
    main()
