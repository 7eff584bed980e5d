"""Campaigns: many runs on many cores or machines, with the same numbers wherever they run.

The runs of a simulation are split into chunks, and these shared out. Each run draws its luck from
the seed and its own number, so that it does not matter who sails it, or in which order. Runs can be
kept in a journal, with which a campaign that was killed goes on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Any

from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.routes import Plan
from fiveroute.sea.journal import Journal
from fiveroute.sea.simulation import SimulationResult, simulate_fleet
from fiveroute.sea.theatre import Theatre
from fiveroute.sharing import share_out

__all__ = ["Campaign", "sail_campaign"]

Chunks = list[tuple[int, int]]

_CHUNKS_A_WORKER = 4
"""So many that all workers end at about the same time, and progress is seen."""

_MOST = 10
"""Runs of a chunk at most, so that an end that is asked for is soon."""

_ON_CLUSTER = 8
"""Workers of a cluster that chunks are made for."""


@dataclass(frozen=True, slots=True, eq=False)
class Campaign:
    """What is to be simulated.

    Parameters
    ----------
    theatre, plan
        The mission, and the routes with which the fleet sets out.
    runs
        Number of runs.
    options
        Further arguments of `simulate_fleet`.
    """

    theatre: Theatre
    plan: Plan
    runs: int
    options: Mapping[str, Any]

    def part(self, first: int, runs: int) -> SimulationResult:
        """Some of the runs."""
        return simulate_fleet(self.theatre, self.plan, runs=runs, first_run=first, **self.options)


def sail_campaign(
    campaign: Campaign,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    journal: Journal | None = None,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> SimulationResult:
    """Simulate all runs; where the limits end it before, those that are done, one chunk at least.

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
    clock = (limits or Limits()).start()
    known = [] if journal is None else journal.runs()[: campaign.runs]
    missing = sorted({*range(campaign.runs)} - {run.run for run in known})
    chunks = _chunks(missing or [0], workers if scheduler is None else _ON_CLUSTER)
    runs = {run.run: run for run in known}
    with closing(share_out(campaign.part, chunks, workers=workers, scheduler=scheduler)) as parts:
        for part in parts:
            if journal is not None:
                journal.add(part.runs)
            runs |= {run.run: run for run in part.runs}
            if progress is not None:
                message = f"run {len(runs)} of {campaign.runs}"
                progress(Progress(clock.seconds, message=message))
            if clock.expired:
                break
    return replace(part, runs=tuple(runs[k] for k in sorted(runs)), seconds=clock.seconds)


def _chunks(runs: Sequence[int], workers: int) -> Chunks:
    """First run and number of runs of every chunk, whose runs follow each other."""
    size = min(max(len(runs) // (workers * _CHUNKS_A_WORKER), 1), _MOST)
    chunks: Chunks = []
    for run in runs:
        first, length = chunks[-1] if chunks else (run, 0)
        if length in (0, size) or run != first + length:
            chunks.append((run, 1))
        else:
            chunks[-1] = first, length + 1
    return chunks
