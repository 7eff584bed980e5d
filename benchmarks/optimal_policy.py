"""How near five-tier comes to the best that one AUV can do online, and both to the clairvoyant.

    python benchmarks/optimal_policy.py [--missions 20] [--nodes 12] [--share 0.8] [--runs 100]

A mission takes start, destination and law of a scenario of the paper, some nodes that lie together,
one AUV and a share of its T_max. The exact policy (`fiveroute.sea.bounds.optimal_policy`) and
five-tier have the same luck, expectations and price of a late return. `worth` is data less price by
the policy's own reckoning, both in shares of all data; the gaps are those to the clairvoyant plans
of the same runs. The last line has the means.
"""

import argparse
from dataclasses import replace

import numpy as np

from fiveroute.generate import paper_scenario
from fiveroute.sea.bounds.optimal_policy import OptimalPolicy, Steersman
from fiveroute.sea.courses.recourse import with_recourse
from fiveroute.sea.departure import departure_plan
from fiveroute.sea.luck import Luck
from fiveroute.sea.run import Run
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World

HEADER = ("mission", "worth", "optimal", "late", "five-tier", "late", "gap", "gap")
RESERVE = 1.645


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--missions", type=int, default=20)
    parser.add_argument("--nodes", type=int, default=12)
    parser.add_argument("--share", type=float, default=0.8)
    parser.add_argument("--runs", type=int, default=100)
    options = parser.parse_args()
    print(" ".join(f"{name:>9s}" for name in HEADER))
    rows = []
    for number in range(1, options.missions + 1):
        rows.append(measure(number, options))
        print(" ".join(f"{value:9.4f}" for value in rows[-1]), flush=True)
    print(" ".join(f"{value:9.4f}" for value in np.mean(rows, axis=0)))


def measure(number: int, options: argparse.Namespace) -> tuple[float, ...]:
    world = mission(number, options.nodes, options.share)
    problem = world.problem
    policy = OptimalPolicy(with_recourse(world.outlook(RESERVE)))
    worth = policy.worth(float(problem.budgets[0])) / problem.total_profit
    best, late = [], 0
    for k in range(options.runs):
        run = Run(problem, Luck(world.law, number, k), (np.inf,))
        run.sail(Steersman(policy, run))
        nodes = [event.node for event in run.log if event.kind == "collect"]
        best.append(world.completion(sum(problem.profit[node] for node in nodes if node)))
        late += run.log[-1].t > problem.budgets[0]
    plan = departure_plan(world, reserve=RESERVE)
    ours = simulate_fleet(world, plan, runs=options.runs, seed=number, gap=True)
    known = np.mean([run.clairvoyant for run in ours.runs])
    theirs, mine = float(np.mean(best)), float(ours.completions.mean())
    return (
        number, worth, theirs, late / options.runs, mine, ours.late_returns / options.runs,
        1.0 - theirs / known, 1.0 - mine / known,
    )  # fmt: skip


def mission(number: int, nodes: int, share: float) -> World:
    """One AUV, and nodes that lie around one of a scenario."""
    scenario = paper_scenario(number)
    rng = np.random.default_rng(number)
    spots = scenario.points[1:-1]
    centre = spots[rng.integers(len(spots))]
    near = np.argsort(np.hypot(*(spots - centre).T))[: 2 * nodes]
    chosen = [scenario.nodes[k] for k in np.sort(rng.permutation(near)[:nodes])]
    world = World.of(replace(scenario, nodes=tuple(chosen)), 1)
    problem = world.problem
    return replace(world, problem=problem.with_budgets(share * problem.budgets))


if __name__ == "__main__":
    main()
