"""Campaigns: many runs on many cores or machines, with the same numbers wherever they run.

The runs of a simulation are shared out one by one. Each draws its luck from the seed and its own
number, so that it does not matter who sails it, or in which order. Runs can be kept in a journal
as they are done, with which a campaign that was killed goes on.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from typing import Any

from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.routes import Plan
from fiveroute.sea.journal import Journal
from fiveroute.sea.run_result import RunResult, SimulationResult
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World
from fiveroute.sharing import share_out

__all__ = ["Campaign", "sail_campaign"]


@dataclass(frozen=True, slots=True, eq=False)
class Campaign:
    """What is to be simulated.

    Parameters
    ----------
    world, plan
        The mission, and the routes with which the fleet sets out.
    runs
        Number of runs.
    options
        Further arguments of `simulate_fleet`.
    """

    world: World
    plan: Plan
    runs: int
    options: Mapping[str, Any]

    @property
    def planner(self) -> str:
        """Who steers."""
        return str(self.options.get("planner", "five-tier"))

    def sail(self, run: int) -> RunResult:
        """One of the runs."""
        result = simulate_fleet(self.world, self.plan, runs=1, first_run=run, **self.options)
        return result.runs[0]


def sail_campaign(
    campaign: Campaign,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    journal: Journal | None = None,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> SimulationResult:
    """Simulate all runs; where the limits end it before, those that are done, one at least.

    Parameters
    ----------
    campaign
        What is to be simulated.
    workers
        Processes on this machine.
    scheduler
        Address of a Dask scheduler, as ``tcp://host:8786``; None stays on this machine.
    journal
        Keeps the runs as they are done, and has those that were; None keeps none.
    limits
        When to stop.
    progress
        Told how many runs are done.
    """
    clock, world = (limits or Limits()).start(), campaign.world
    runs = {} if journal is None else {run.run: run for run in journal.runs()}
    missing = [(run,) for run in range(campaign.runs) if run not in runs]
    with closing(share_out(campaign.sail, missing, workers=workers, scheduler=scheduler)) as sailed:
        for run in sailed:
            runs[run.run] = run
            if journal is not None:
                journal.add([run])
            if progress is not None:
                message = f"run {len(runs)} of {campaign.runs}"
                progress(Progress(clock.seconds, message=message))
            if clock.expired:
                break
    return SimulationResult(
        campaign.planner,
        world.problem.fleet_size,
        world.completion(campaign.plan.objective(world.problem)),
        tuple(runs[number] for number in sorted(runs)),
        clock.seconds,
    )
