"""Runs of a fleet at sea, for people who call fiveroute from Python: what tiers 4 and 5 came to.

They know the plan that the fleet set out with, what it collected in every ocean, and who came home
late; they can be saved as a table, a log of events or CF trajectories, and played on a page.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.fleet_plan import FleetPlan
from fiveroute.routes import Plan
from fiveroute.sea.run_result import RunResult, SimulationResult
from fiveroute.words import printable

if TYPE_CHECKING:
    from fiveroute.formats.plan_file import PlanFile
    from fiveroute.sea.world import World
    from fiveroute.view.event_log import RunLog

__all__ = ["FleetRuns", "Pier"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Pier:
    """A fleet about to leave.

    Parameters
    ----------
    plan
        The routes that it sets out with, on its planned legs.
    world
        What the simulation knows of the mission.
    """

    plan: FleetPlan
    world: World

    @property
    def routes(self) -> Plan:
        """The routes as the simulation knows them."""
        assert self.plan.result.plan is not None
        return self.plan.result.plan


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FleetRuns:
    """What became of a fleet in many oceans.

    Parameters
    ----------
    pier
        The fleet as it left.
    result
        What the simulation answered.
    seed
        Seed of the oceans.
    """

    pier: Pier
    result: SimulationResult
    seed: int

    @property
    def plan(self) -> FleetPlan:
        """The plan that the fleet set out with."""
        return self.pier.plan

    @property
    def runs(self) -> tuple[RunResult, ...]:
        """What became of the fleet in every ocean."""
        return self.result.runs

    @property
    def fleet_size(self) -> int:
        """Number of AUVs."""
        return self.result.fleet_size

    @property
    def completions(self) -> Floats:
        """Completion rate theta, (31), of every run, shape (runs,)."""
        return self.result.completions

    @property
    def late_returns(self) -> int:
        """Number of AUVs that came home late, over all runs."""
        return self.result.late_returns

    @property
    def online_gap(self) -> float | None:
        """Mean of (clairvoyant - completion) / clairvoyant; None where it was not asked for."""
        return self.result.online_gap

    def tracks(self, run: RunResult) -> tuple[Floats, ...]:
        """Where every AUV was in a run: seconds, x and y in metres, each of shape (any, 3)."""
        from fiveroute.sea.tracks import tracks_of

        return tracks_of(self.pier.world, self.plan.voyage.legs, run, self.seed)

    def save(self, path: str | PathLike[str], *, force: bool = False) -> None:
        """Write a table, a row a run, whole or not at all.

        Parameters
        ----------
        path
            The file, .csv, .md or .parquet.
        force
            Overwrite an existing file.
        """
        from fiveroute.formats.run_files import write_table

        write_table(self.result, Path(path), force)

    def save_events(self, path: str | PathLike[str], *, force: bool = False) -> None:
        """Write what happened, a JSON document a line, whole or not at all.

        Parameters
        ----------
        path
            The file.
        force
            Overwrite an existing file.
        """
        from fiveroute.formats.files import write_text_atomically

        write_text_atomically(Path(path), self._log(), force)

    def save_tracks(self, path: str | PathLike[str], *, force: bool = False) -> None:
        """Write the track of every AUV in every run as CF trajectories, whole or not at all.

        Parameters
        ----------
        path
            The file, .nc.
        force
            Overwrite an existing file.
        """
        from fiveroute.formats.track_file import require_tracks, write_tracks

        file = Path(path)
        require_tracks(file, force)
        where = [(run.run, self.tracks(run)) for run in self.runs]
        write_tracks(self.plan.voyage.instance, where, file, force)

    def view(
        self,
        path: str | PathLike[str] | None = None,
        *,
        run: int | None = None,
        force: bool = False,
        folder: Path | None = None,
    ) -> Path:
        """Write a page that plays the runs, a picture, or a film, and return its file.

        Parameters
        ----------
        path
            The file, .html, .png, .svg, .pdf or .gif; None opens a page in the browser.
        run
            Number of the run that a picture or film shows; a page has them all.
        force
            Overwrite an existing file.
        folder
            Folder that the name of the instance's file of currents is relative to.
        """
        from fiveroute.view.looks import show_look
        from fiveroute.view.scene import scene_of

        filed = self.plan.filed()
        scene = scene_of(filed, folder, runs=self._played(filed))
        return show_look([scene], path, run=run, force=force)

    def _played(self, filed: PlanFile) -> tuple[RunLog, ...]:
        """The runs as a page plays them."""
        from fiveroute.view.event_log import run_logs

        logs = {log.run: log for log in run_logs(self._log(), filed)}
        tracks = {
            run.run: tuple(track[:, [1, 2, 0]] for track in self.tracks(run)) for run in self.runs
        }
        return tuple(replace(log, tracks=tracks[number]) for number, log in logs.items())

    def _log(self) -> str:
        from fiveroute.formats.run_files import event_lines

        return event_lines(self.plan.voyage.instance, self.result)

    def _repr_html_(self) -> str:
        """The plan's map under what became of it, for notebooks."""
        from fiveroute.view.notebook import runs_html

        return runs_html(self.plan.filed(), str(self).splitlines())

    def __repr__(self) -> str:
        """Its first line: the runs alone have thousands of numbers."""
        return f"<{type(self).__name__} {self._headline()}>"

    def __str__(self) -> str:
        """The figures that matter, one a line."""
        return "\n".join([self._headline(), *(f"{name:<16}{text}" for name, text in self._told())])

    def _headline(self) -> str:
        name, result = printable(self.plan.instance.name), self.result
        return f"{name}: {len(self.runs)} runs of {result.fleet_size} AUVs, {result.planner}"

    def _told(self) -> list[tuple[str, str]]:
        result, rates = self.result, 100.0 * self.completions
        sent, delivered = result.messages
        spread = rates.std(ddof=1) if len(rates) > 1 else 0.0
        told = [
            ("collected", f"{rates.mean():.1f} % of all data (std {spread:.1f})"),
            ("range", f"{rates.min():.1f} to {rates.max():.1f} %"),
            ("planned", f"{100.0 * result.planned_completion:.1f} %"),
            ("late returns", f"{result.late_returns} of {len(rates) * result.fleet_size}"),
            ("double visits", str(result.double_visits)),
            ("messages", f"{sent} sent, {delivered} received"),
        ]
        if result.min_clearance is not None:
            told += [
                ("clearance", f"{result.min_clearance:.1f} m at the least"),
                ("collisions", str(result.collisions)),
            ]
        if result.lost:
            told.append(("lost", f"{result.lost} AUVs, by the current or obstacles"))
        if result.online_gap is not None:
            told.append(("online gap", f"{100.0 * result.online_gap:.1f} % to the clairvoyant"))
        return told
