"""What became of a plan at sea: in one run, and in many."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.sea.events import Event

__all__ = ["RunResult", "SimulationResult"]


@dataclass(frozen=True, slots=True)
class RunResult:
    """What became of the fleet in one run.

    Parameters
    ----------
    run
        Number of the run, counted from 0.
    completion
        Completion rate theta, (31), every node counted once.
    arrivals
        Time in seconds at which each AUV reached the destination; infinite if it failed.
    late_returns
        Number of AUVs that arrived after their T_max.
    double_visits
        Number of collections of nodes whose data had been collected before.
    sent, delivered
        Messages sent, and messages that reached somebody, each receiver counted.
    false_takeovers
        Nodes taken over from an AUV that still had them, or had collected them.
    clairvoyant
        Completion rate of the best plan found for the leg times that really came; None where
        it was not asked for.
    events
        What happened, in the order of time; empty if no log was asked for.
    legs
        Tail, head and beginning in seconds of the legs of each AUV; empty likewise.
    min_clearance
        Least clearance of all tracks in metres; None where no vehicle sailed, or in open water.
    collisions
        Number of tracks that met a barrier.
    lost
        Number of AUVs that a current or obstacles kept from arriving.
    """

    run: int
    completion: float
    arrivals: tuple[float, ...]
    late_returns: int
    double_visits: int = 0
    sent: int = 0
    delivered: int = 0
    false_takeovers: int = 0
    clairvoyant: float | None = None
    events: tuple[Event, ...] = ()
    legs: tuple[tuple[tuple[int, int, float], ...], ...] = ()
    min_clearance: float | None = None
    collisions: int = 0
    lost: int = 0


@dataclass(frozen=True, slots=True)
class SimulationResult:
    """What became of a plan in many runs.

    Parameters
    ----------
    planner
        Who steered.
    fleet_size
        Number of AUVs.
    planned_completion
        Completion rate of the plan that the fleet set out with.
    runs
        The runs, in their order.
    seconds
        Time that the simulation took.
    """

    planner: str
    fleet_size: int
    planned_completion: float
    runs: tuple[RunResult, ...]
    seconds: float

    @property
    def completions(self) -> NDArray[np.float64]:
        """Completion rate of every run, shape (runs,)."""
        return np.array([run.completion for run in self.runs])

    @property
    def late_returns(self) -> int:
        """Number of AUVs that came home late, over all runs."""
        return sum(run.late_returns for run in self.runs)

    @property
    def double_visits(self) -> int:
        """Number of collections in vain, over all runs."""
        return sum(run.double_visits for run in self.runs)

    @property
    def min_clearance(self) -> float | None:
        """Least clearance in metres of all tracks of all runs; None where there is none."""
        known = [run.min_clearance for run in self.runs if run.min_clearance is not None]
        return min(known, default=None)

    @property
    def collisions(self) -> int:
        """Number of tracks that met a barrier, over all runs."""
        return sum(run.collisions for run in self.runs)

    @property
    def lost(self) -> int:
        """Number of AUVs that a current or obstacles kept from arriving, over all runs."""
        return sum(run.lost for run in self.runs)

    @property
    def messages(self) -> tuple[int, int]:
        """Messages sent and delivered, over all runs."""
        return sum(run.sent for run in self.runs), sum(run.delivered for run in self.runs)

    @property
    def online_gap(self) -> float | None:
        """Mean of (clairvoyant - completion) / clairvoyant; None where it was not asked for."""
        pairs = [(run.clairvoyant, run.completion) for run in self.runs]
        gaps = [(best - got) / best if best else 0.0 for best, got in pairs if best is not None]
        return sum(gaps) / len(gaps) if gaps else None
