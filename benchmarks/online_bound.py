"""How far any online policy stays behind the clairvoyant plan, scenario by scenario.

    python benchmarks/online_bound.py [--scenarios 1-20] [--runs N] [--late 0.01] [--price 0.3]
        [--steps K] [--memory Q]

Fleets and oceans are those of `fiveroute experiment stochastic`. Of the bounds on mean completion
with a share of late AUVs, `expected` takes no luck, and `bound` is the mean over the runs;
`clairvoyant` is the mean of the best plans found for the same oceans, the gap that of `bound`. The
last line has the means and, after +-, half of the 95 % interval of `bound - expected`.
"""

import argparse

import numpy as np

from fiveroute.generate import paper_scenario
from fiveroute.routes import Plan
from fiveroute.sea.bounds.clairvoyant import clairvoyant_plan
from fiveroute.sea.bounds.online_bound import online_bound
from fiveroute.sea.luck import Luck
from fiveroute.sea.world import World
from fiveroute.tiers.preplanning import fleet_size_of

HEADER = ("scenario", "auvs", "expected", "bound", "clairvoyant", "gap")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenarios", default="1-20")
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--late", type=float, default=0.01)
    parser.add_argument("--price", type=float, default=0.3)
    parser.add_argument("--steps", type=int, default=1200)
    parser.add_argument("--memory", type=int, default=5)
    options = parser.parse_args()
    first, _, last = options.scenarios.partition("-")
    print(" ".join(f"{name:>11s}" for name in HEADER))
    rows = []
    for scenario in range(int(first), int(last or first) + 1):
        rows.append(measure(scenario, options))
        print(" ".join(f"{value:11.4g}" for value in rows[-1]), flush=True)
    _, _, expected, bound, best, _ = columns = np.array(rows).T
    mean = columns.mean(axis=1)
    mean[-1] = 1.0 - bound.mean() / best.mean()
    half = 1.96 * float(np.std(bound - expected)) / max(len(rows) - 1, 1) ** 0.5
    print(" ".join(f"{value:11.4g}" for value in mean), f"+- {half:.2g}")


def measure(scenario: int, options: argparse.Namespace) -> tuple[float, ...]:
    instance = paper_scenario(scenario)
    fleet = fleet_size_of(instance, rng=np.random.default_rng((0, scenario)))
    world = World.of(instance, fleet)
    bound = online_bound(
        world, price=options.price, runs=options.runs, seed=scenario, steps=options.steps,
        memory=options.memory,
    )  # fmt: skip
    most = bound.completion(options.late)
    expected = most + bound.expected - float(np.mean(bound.runs))
    lucks = (Luck(world.law, scenario, run) for run in range(options.runs))
    plans = [clairvoyant_plan(world.problem, luck, Plan.empty(fleet)) for luck in lucks]
    best = float(np.mean([world.completion(plan.objective(real)) for real, plan in plans]))
    return scenario, fleet, expected, most, best, 1.0 - most / best


if __name__ == "__main__":
    main()
