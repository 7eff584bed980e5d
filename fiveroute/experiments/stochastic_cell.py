"""A cell of the stochastic experiment: one planner with one fleet on one scenario.

A cell is planned once and then sailed run by run, in any order and by anybody: a run is a
function of the cell, of what it sets out with, and of its own number alone. All three are small, so
that they travel to other processes and machines, where the scenario is made anew.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np

import fiveroute
from fiveroute.experiments.kept_rows import key_of
from fiveroute.generate import paper_scenario
from fiveroute.instance import Instance
from fiveroute.kernels import source_digest
from fiveroute.paths.voyage import Voyage
from fiveroute.routes import Plan
from fiveroute.sea.departure import departure_plan
from fiveroute.sea.run_result import RunResult, SimulationResult
from fiveroute.sea.sailed_luck import VehicleModel
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World
from fiveroute.tiers.preplanning import fleet_size_of
from fiveroute.vehicle.fit import Estimate, Fit

__all__ = ["Cell", "Departure", "Outcome", "depart", "sail_run"]


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
        """Names what a run depends on: the cell, and the source that it is computed by.

        How many runs there are makes no difference to any of them.
        """
        known = {**asdict(self), "runs": None, "version": fiveroute.__version__}
        return key_of(known | {"source": source_digest(__name__)})

    @property
    def label(self) -> str:
        """Words for people."""
        fleet = "m" if self.fleet_size is None else self.fleet_size
        return f"{self.scenario:02d}-{self.planner}-{fleet}"

    @property
    def luck(self) -> int:
        """Seed of the luck, the same for all planners and fleets."""
        return self.seed * 1000 + self.scenario


@dataclass(frozen=True, slots=True)
class Departure:
    """What the fleet of a cell sets out with.

    Parameters
    ----------
    plan
        Its routes.
    planned
        Completion rate of the plan.
    fit
        What is expected of a vehicle; None where legs take what (12) says.
    """

    plan: Plan
    planned: float
    fit: Fit | None = None

    @property
    def document(self) -> dict[str, Any]:
        """All of it, as JSON can hold it."""
        return asdict(self)

    @classmethod
    def of_document(cls, document: Mapping[str, Any]) -> Departure | None:
        """What a document holds; None if it holds something else."""
        try:
            plan, fit = Plan.of(document["plan"]["routes"]), document["fit"]
            return cls(plan, float(document["planned"]), fit and _fit_of(fit))
        except (KeyError, TypeError, ValueError):
            return None


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

    @classmethod
    def of(cls, cell: Cell, departure: Departure, runs: Sequence[RunResult]) -> Outcome:
        """Gather the runs of a cell."""
        fleet, planned = len(departure.plan.routes), departure.planned
        result = SimulationResult(cell.planner, fleet, planned, tuple(runs), 0.0)
        return cls(
            cell,
            fleet,
            planned,
            tuple(result.completions.tolist()),
            tuple(run.clairvoyant for run in runs if run.clairvoyant is not None),
            result.late_returns,
            result.double_visits,
            result.collisions,
            result.lost,
            result.min_clearance,
        )

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


def depart(cell: Cell) -> tuple[Cell, Departure]:
    """Plan a cell; it is told with its plan, as answers may come in any order."""
    instance = paper_scenario(cell.scenario)
    fleet = cell.fleet_size
    if fleet is None:
        rng = np.random.default_rng((cell.seed, cell.scenario))
        fleet = fleet_size_of(instance, rng=rng)
    fit = _fit(cell.scenario, cell.luck) if cell.actuation == "vehicle" else None
    world = _world(cell.scenario, fleet, fit)
    plan = departure_plan(world.by_law, cell.planner, reserve=cell.reserve, seed=cell.seed)
    planned = world.completion(plan.objective(world.problem))
    return cell, Departure(plan, planned, fit)


def sail_run(cell: Cell, departure: Departure, run: int) -> tuple[Cell, RunResult]:
    """Sail one run of a cell; it is told with its run."""
    result = simulate_fleet(
        _world(cell.scenario, len(departure.plan.routes), departure.fit),
        departure.plan,
        planner=cell.planner,
        runs=1,
        first_run=run,
        reserve=cell.reserve,
        seed=cell.luck,
        log=False,
        gap=cell.gap,
    )
    return cell, result.runs[0]


@lru_cache(maxsize=8)
def _world(scenario: int, fleet: int, fit: Fit | None) -> World:
    """A scenario as a fleet meets it."""
    instance = paper_scenario(scenario)
    world = World.of(instance, fleet)
    return world if fit is None else world.expecting(_vehicle(instance), fit)


@cache
def _fit(scenario: int, seed: int) -> Fit:
    """What is to be expected of a vehicle, whatever the fleet."""
    instance = paper_scenario(scenario)
    return World.of(instance, 1).fitted(_vehicle(instance), seed)


def _vehicle(instance: Instance) -> VehicleModel:
    return VehicleModel.of(Voyage.straight(instance))


def _fit_of(document: Mapping[str, Any]) -> Fit:
    estimates = {name: it for name, it in document.items() if isinstance(it, Mapping)}
    return Fit(**{**document, **{name: Estimate(**it) for name, it in estimates.items()}})
