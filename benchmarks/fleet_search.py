"""What the fleet search costs as problems grow: a row a size, and a picture.

    python benchmarks/fleet_search.py [--sizes 60,200,1000,5000] [--nodes-per-auv 50]
        [--trials-per-node 200] [--seed N] [--table FILE.csv] [--figure FILE.png]

Nodes lie anywhere in the region, as in `fiveroute.generate.scenario`, with one AUV for so
many of them. Every size gets the same number of trials for each node, so that a search
whose time is linear in the nodes shows a level line of time per node. Time is processor
time, memory the most that the process had up to then, and the gap is to a bound that
holds for every plan.
"""

import argparse
import csv
import resource
import sys
import time
from pathlib import Path

import numpy as np

from fiveroute.generate import scenario
from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.models.bounds import quick_bound

HEADER = ("nodes", "auvs", "share", "gap", "seconds", "ms_per_node", "us_per_trial", "memory_mb")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", default="60,200,1000,5000")
    parser.add_argument("--nodes-per-auv", type=int, default=50)
    parser.add_argument("--trials-per-node", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--figure", type=Path)
    options = parser.parse_args()
    compile_kernels()
    print(" ".join(f"{name:>12s}" for name in HEADER))
    rows = []
    for nodes in map(int, options.sizes.split(",")):
        fleet_size = max(1, nodes // options.nodes_per_auv)
        rows.append(measure(nodes, fleet_size, options.trials_per_node * nodes, options.seed))
        print(" ".join(f"{value:12.5g}" for value in rows[-1]), flush=True)
    if options.table is not None:
        with options.table.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([HEADER, *rows])
    if options.figure is not None:
        draw(np.array(rows), options.figure)


def compile_kernels() -> None:
    """One search that recombines, so that the first row does not hold its compilation."""
    problem = scenario("uniform", 20, 1, 2).problem()
    fleet_search(problem, rng=np.random.default_rng(1), iterations=5_000)


def measure(nodes: int, fleet_size: int, trials: int, seed: int) -> tuple[float, ...]:
    problem = scenario("uniform", nodes, seed, fleet_size).problem()
    started = time.process_time()
    plan = fleet_search(problem, rng=np.random.default_rng(seed), iterations=trials)
    seconds = time.process_time() - started
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
    memory /= 2**10 if sys.platform == "darwin" else 1
    collected = plan.objective(problem)
    return (
        nodes,
        fleet_size,
        collected / problem.total_profit,
        quick_bound(problem).value / collected - 1.0,
        seconds,
        1e3 * seconds / nodes,
        1e6 * seconds / trials,
        memory,
    )


def draw(rows: np.ndarray, path: Path) -> None:
    from matplotlib.figure import Figure

    nodes, gap, seconds = rows[:, 0], 100.0 * rows[:, 3], rows[:, 4]
    figure = Figure(figsize=(7.0, 3.2), layout="constrained")
    times, gaps = figure.subplots(1, 2)
    times.loglog(nodes, seconds, "o-", color="tab:blue")
    times.loglog(nodes, seconds[0] * nodes / nodes[0], ":", color="grey", label="linear")
    times.set(xlabel="sensor nodes", ylabel="processor time (s)")
    times.legend(frameon=False)
    gaps.semilogx(nodes, gap, "o-", color="tab:orange")
    gaps.set(xlabel="sensor nodes", ylabel="gap to the bound (%)", ylim=(0.0, None))
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    main()
