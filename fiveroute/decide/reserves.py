"""How cautiously? Completion and late returns at sea against the reserve that AUVs keep.

A reserve of Z standard deviations of the remaining time costs data and saves vehicles. Every
reserve is sailed in the same oceans with the same luck.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fiveroute.decide.sweep import Row, Sweep, vary
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.paths.voyage import Voyage
from fiveroute.sea.campaign import Campaign, sail_campaign
from fiveroute.sea.departure import departure_plan
from fiveroute.sea.world import World
from fiveroute.tiers.preplanning import fleet_size_of

__all__ = ["sweep_reserves"]


def sweep_reserves(
    voyage: Voyage,
    reserves: Sequence[float],
    *,
    accepted_late: float = 0.01,
    planner: str = "five-tier",
    fleet_size: int | None = None,
    runs: int = 50,
    workers: int = 1,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Sweep:
    """Sail a mission with different reserves.

    Parameters
    ----------
    voyage
        The mission and its leg times.
    reserves
        Standard deviations of the remaining time that are kept in hand.
    accepted_late
        Share of AUVs that may come home late; the best reserve within it is pointed out.
    planner
        Who steers, see `fiveroute.sea.simulation.PLANNERS`.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it.
    runs
        Oceans to sail in.
    workers
        Processes on this machine.
    limits
        When to stop, shared among the reserves.
    seed
        Seed of the random numbers.
    progress
        Told what is at work.
    """
    rng = np.random.default_rng(seed)
    size = fleet_size or fleet_size_of(voyage.instance, voyage.travel, rng=rng)
    world = World.of(voyage.instance, size, travel=voyage.travel, out_of_reach=voyage.out_of_reach)

    def row(reserve: float, limits: Limits) -> Row:
        spent = limits.start()
        routes = departure_plan(world, planner, reserve=reserve, seed=seed, limits=limits)
        how = {"planner": planner, "reserve": reserve, "seed": seed}
        campaign = Campaign(world, routes, runs, how)
        result = sail_campaign(campaign, workers=workers, limits=spent.rest())
        theta = np.array([run.completion for run in result.runs])
        late = sum(run.late_returns for run in result.runs)
        return {
            "completion_rate": float(theta.mean()),
            "p5": float(np.quantile(theta, 0.05)),
            "p95": float(np.quantile(theta, 0.95)),
            "late_share": late / (len(result.runs) * size),
            "runs": len(result.runs),
        }

    clock = (limits or Limits()).start()
    name = voyage.mission.name
    sweep = vary(name, "reserve", "", reserves, row, clock=clock, progress=progress)
    in_time = [row for row in sweep.rows if float(row["late_share"] or 0.0) <= accepted_late]
    rule = f"with at most {100.0 * accepted_late:g} % late"
    if not in_time:
        return sweep.marking(None, f"no reserve {rule}")
    best = max(in_time, key=lambda row: float(row["completion_rate"] or 0.0))
    return sweep.marking(best["reserve"], f"best {rule}")
