"""The paper's Section IV-C and D: fleets in an uncertain ocean, planner against planner.

On every scenario tier 1 estimates the number of AUVs M. The five-tiered planner sails with M;
the planners that the paper compares with sail with M (equal fleets) and with 4. Every planner
meets the same luck: the real leg times depend on scenario, run and leg alone, and come from (12) or
from a vehicle that sails every leg. Legs are planned as straight lines in still water, because
(12) already stands for the current, and so does the vehicle's true ocean.

A cell is one planner with one fleet on one scenario (`fiveroute.experiments.stochastic_cell`). All
cells are planned first, then all runs of all cells shared out, one by one. Plans are kept as
rows, runs in a journal a cell, as soon as they are done and under a key of all that they depend
on: a campaign that is killed at any moment goes on where it was.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fiveroute.experiments.kept_rows import KeptRows
from fiveroute.experiments.registry import Registry
from fiveroute.experiments.stochastic_cell import Cell, Departure, Outcome, depart, sail_run
from fiveroute.formats.native import instance_hash
from fiveroute.generate import paper_scenario
from fiveroute.limits import Limits, Progress, ProgressCallback
from fiveroute.sea.journal import Journal
from fiveroute.sea.run_result import RunResult
from fiveroute.sharing import share_out

__all__ = ["COMPETITORS", "FIXED_FLEET", "cells_of", "registered", "sail_cells"]

COMPETITORS = ("ftcmp", "rmmp")
"""The planners that the paper compares with."""

FIXED_FLEET = 4
"""AUVs that they have in the paper's first comparison, (33)."""

_PLANNERS = ("five-tier", "no-coordination", *COMPETITORS)


def cells_of(
    scenarios: int,
    runs: int,
    *,
    seed: int = 0,
    reserve: float = 1.645,
    actuation: str = "abstraction",
) -> list[Cell]:
    """All cells of the paper's comparisons, scenario by scenario.

    The five-tiered planner is compared with the clairvoyant where legs take what (12) says; to sail
    all 3,661 legs of a run, as that takes with a vehicle, would be two hundred times the work.
    """
    cells = []
    for scenario in range(1, scenarios + 1):
        for planner in _PLANNERS:
            gap = planner not in COMPETITORS and actuation == "abstraction"
            cells.append(Cell(scenario, planner, None, runs, seed, reserve, gap, actuation))
        cells += [
            Cell(scenario, planner, FIXED_FLEET, runs, seed, reserve, actuation=actuation)
            for planner in COMPETITORS
        ]
    return cells


def sail_cells(
    cells: Sequence[Cell],
    folder: Path | None = None,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    limits: Limits | None = None,
    progress: ProgressCallback | None = None,
) -> list[Outcome]:
    """Outcomes of cells in their order; where the limits end it before, of those that are whole.

    Parameters
    ----------
    cells
        What is to be sailed.
    folder
        Where plans and runs are kept, and taken from; None keeps none.
    workers
        Processes.
    scheduler
        Address of a Dask scheduler to sail on instead; None stays on this machine.
    limits
        When to stop.
    progress
        Told how many plans, and then how many runs are done of those that were missing.
    """
    clock = (limits or Limits()).start()
    books = {cell: _Book.of(cell, folder) for cell in cells}

    def share(
        work: Callable[..., tuple[Cell, Any]],
        tasks: Sequence[tuple[Any, ...]],
        enter: Callable[[_Book, Any], None],
        what: str,
    ) -> None:
        with closing(share_out(work, tasks, workers=workers, scheduler=scheduler)) as answers:
            for done, (cell, answer) in enumerate(answers, start=1):
                enter(books[cell], answer)
                if progress is not None:
                    message = f"{what} {done} of {len(tasks)}"
                    progress(Progress(clock.seconds, message=message))
                if clock.expired:
                    break

    share(depart, [(c,) for c in cells if books[c].departure is None], _Book.set_out, "plan")
    if not clock.expired:
        share(sail_run, [task for c in cells for task in books[c].missing], _Book.add, "run")
    return [outcome for book in books.values() if (outcome := book.outcome) is not None]


@dataclass(slots=True)
class _Book:
    """What is known of a cell, and kept in a folder, if there is one."""

    cell: Cell
    rows: KeptRows | None = None
    journal: Journal | None = None
    departure: Departure | None = None
    runs: dict[int, RunResult] = field(default_factory=dict)

    @classmethod
    def of(cls, cell: Cell, folder: Path | None) -> _Book:
        """The book of a cell, as far as it is written."""
        if folder is None:
            return cls(cell)
        rows, journal = KeptRows(folder), Journal(folder / f"{cell.label}-{cell.key}.jsonl")
        row = rows.get(cell.label, cell.key)
        departure = None if row is None else Departure.of_document(row)
        return cls(cell, rows, journal, departure, {run.run: run for run in journal.runs()})

    @property
    def missing(self) -> list[tuple[Cell, Departure | None, int]]:
        """Arguments of `sail_run` for the runs that nobody has sailed."""
        runs = sorted({*range(self.cell.runs)} - self.runs.keys())
        return [(self.cell, self.departure, run) for run in runs]

    def set_out(self, departure: Departure) -> None:
        """Enter what the fleet sets out with."""
        self.departure = departure
        if self.rows is not None:
            self.rows.put(self.cell.label, self.cell.key, departure.document)

    def add(self, run: RunResult) -> None:
        """Enter a run."""
        self.runs[run.run] = run
        if self.journal is not None:
            self.journal.add([run])

    @property
    def outcome(self) -> Outcome | None:
        """What became of the cell, if all of its runs are sailed."""
        if self.departure is None or self.missing:
            return None
        return Outcome.of(self.cell, self.departure, [self.runs[k] for k in range(self.cell.runs)])


def registered(folder: Path, config: Mapping[str, Any], *, force: bool = False) -> Registry:
    """Enter a campaign in the registry of its folder.

    Parameters
    ----------
    folder
        Folder of the results.
    config
        The arguments of `cells_of`.
    force
        Whether to begin anew whatever was there; cells that are the same are kept all the same.
    """
    scenarios = map(paper_scenario, range(1, config["scenarios"] + 1))
    inputs = {scenario.name: instance_hash(scenario) for scenario in scenarios}
    return Registry.begin(folder / "run.json", config, inputs, __name__, force=force)
