"""The paper's Section IV-C and D: fleets in an uncertain ocean, planner against planner.

On every scenario tier 1 estimates the number of AUVs M. The five-tiered planner sails with M;
the planners that the paper compares with sail with M (equal fleets) and with 4. Every planner
meets the same luck: the real leg times depend on scenario, run and leg alone, and come from (12) or
from a vehicle that sails every leg. Legs are planned as straight lines in still water, because
(12) already stands for the current, and so does the vehicle's true ocean.

A cell is one planner with one fleet on one scenario. Cells are kept as files as soon as they are
done, each under a key of all that it depends on: a campaign that is killed at any moment goes on
where it was.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import fiveroute
from fiveroute.experiments.registry import Registry
from fiveroute.formats.files import write_text_atomically
from fiveroute.formats.native import instance_hash
from fiveroute.generate import paper_scenario
from fiveroute.kernels import source_digest
from fiveroute.paths.voyage import Voyage
from fiveroute.sea.departure import departure_plan
from fiveroute.sea.sailed_luck import VehicleModel
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.theatre import Theatre
from fiveroute.sharing import share_out
from fiveroute.tiers.preplanning import fleet_size_of

__all__ = [
    "COMPETITORS",
    "FIXED_FLEET",
    "Cell",
    "Outcome",
    "cells_of",
    "registered",
    "sail_cell",
    "sail_cells",
]

COMPETITORS = ("ftcmp", "rmmp")
"""The planners that the paper compares with."""

FIXED_FLEET = 4
"""AUVs that they have in the paper's first comparison, (33)."""

_PLANNERS = ("five-tier", "no-coordination", *COMPETITORS)


@dataclass(frozen=True, slots=True)
class Cell:
    """One planner with one fleet on one scenario.

    Parameters
    ----------
    scenario
        Number of the paper scenario.
    planner
        Who steers.
    fleet_size
        Number of AUVs; None for the estimate of tier 1.
    runs
        Number of oceans.
    seed
        Seed of plans and luck.
    reserve
        Standard deviations of the remaining time kept in hand.
    gap
        Whether every run is compared with a clairvoyant plan.
    actuation
        What legs take: "abstraction" for (12), "vehicle" for what a vehicle takes that sails them.
    """

    scenario: int
    planner: str
    fleet_size: int | None
    runs: int
    seed: int = 0
    reserve: float = 1.645
    gap: bool = False
    actuation: str = "abstraction"

    @property
    def key(self) -> str:
        """Names what the outcome depends on: the cell, and the source that it is computed by."""
        source = source_digest(__name__)
        text = json.dumps({**asdict(self), "source": source, "version": fiveroute.__version__})
        return hashlib.sha256(text.encode()).hexdigest()[:24]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a cell.

    Parameters
    ----------
    cell
        The cell.
    fleet_size
        AUVs that sailed.
    planned
        Completion rate of the plan.
    completions
        Completion rate of every run.
    clairvoyant
        Completion rate of the clairvoyant plan of every run; empty where not asked for.
    late_returns, double_visits, collisions, lost
        Over all runs; an AUV is lost that a current or obstacles keep from arriving.
    min_clearance
        Least clearance of all tracks in metres; None where no vehicle sailed.
    """

    cell: Cell
    fleet_size: int
    planned: float
    completions: tuple[float, ...]
    clairvoyant: tuple[float, ...]
    late_returns: int
    double_visits: int
    collisions: int = 0
    lost: int = 0
    min_clearance: float | None = None

    @property
    def mean(self) -> float:
        """Mean completion rate."""
        return float(np.mean(self.completions))

    @property
    def online_gap(self) -> float | None:
        """Mean of (clairvoyant - completion) / clairvoyant."""
        if not self.clairvoyant:
            return None
        best, got = np.array(self.clairvoyant), np.array(self.completions)
        return float(np.mean((best - got) / np.maximum(best, 1e-12)))


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


def sail_cell(cell: Cell) -> Outcome:
    """Plan, and sail all runs of a cell."""
    instance = paper_scenario(cell.scenario)
    fleet = cell.fleet_size
    if fleet is None:
        rng = np.random.default_rng((cell.seed, cell.scenario))
        fleet = fleet_size_of(instance, rng=rng)
    seed = cell.seed * 1000 + cell.scenario
    if cell.actuation == "vehicle":
        theatre = replace(_sailed(cell.scenario, seed), problem=instance.problem(fleet))
    else:
        theatre = Theatre.of(instance, fleet)
    plan = departure_plan(theatre.by_law, cell.planner, reserve=cell.reserve, seed=cell.seed)
    result = simulate_fleet(
        theatre,
        plan,
        planner=cell.planner,
        runs=cell.runs,
        reserve=cell.reserve,
        seed=seed,
        log=False,
        gap=cell.gap,
    )
    return Outcome(
        cell,
        fleet,
        result.planned_completion,
        tuple(result.completions.tolist()),
        tuple(run.clairvoyant for run in result.runs if run.clairvoyant is not None),
        result.late_returns,
        result.double_visits,
        result.collisions,
        result.lost,
        result.min_clearance,
    )


@cache
def _sailed(scenario: int, seed: int) -> Theatre:
    """A scenario whose legs a vehicle sails; the law that is fitted to it knows no fleet."""
    instance = paper_scenario(scenario)
    return Theatre.of(instance, 1).sailed_by(VehicleModel.of(Voyage.straight(instance)), seed)


def sail_cells(
    cells: Sequence[Cell],
    folder: Path | None = None,
    *,
    workers: int = 1,
    scheduler: str | None = None,
) -> Generator[Outcome]:
    """Outcomes of cells as they are done, those that the folder has first.

    Parameters
    ----------
    cells
        What is to be sailed.
    folder
        Where outcomes are kept; None keeps none.
    workers
        Processes.
    scheduler
        Address of a Dask scheduler to sail on instead; None stays on this machine.
    """
    missing = []
    for cell in cells:
        kept = None if folder is None else _kept(folder, cell)
        if kept is None:
            missing.append((cell,))
        else:
            yield kept
    with closing(share_out(sail_cell, missing, workers=workers, scheduler=scheduler)) as outcomes:
        for outcome in outcomes:
            if folder is not None:
                _keep(folder, outcome)
            yield outcome


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


def _file(folder: Path, cell: Cell) -> Path:
    fleet = "m" if cell.fleet_size is None else str(cell.fleet_size)
    return folder / f"{cell.scenario:02d}-{cell.planner}-{fleet}-{cell.key}.json"


def _keep(folder: Path, outcome: Outcome) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(asdict(outcome), allow_nan=False)
    write_text_atomically(_file(folder, outcome.cell), text + "\n", force=True)


def _kept(folder: Path, cell: Cell) -> Outcome | None:
    """The outcome of a cell, if the folder has it whole."""
    try:
        document: dict[str, Any] = json.loads(_file(folder, cell).read_text(encoding="utf-8"))
        rest = {name: document[name] for name in Outcome.__slots__ if name != "cell"}
    except (OSError, ValueError, KeyError):
        return None
    rest |= {name: tuple(rest[name]) for name in ("completions", "clairvoyant")}
    return Outcome(cell, **rest)
