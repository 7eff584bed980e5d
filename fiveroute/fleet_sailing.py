"""Sailing a fleet, for people who call fiveroute from Python: tiers 4 and 5.

    import fiveroute as fr

    sea = fr.read("sea.json")
    runs = fr.simulate(sea, fr.plan(sea), runs=50)
    print(runs)
    runs.view("runs.html")

`prepare` brings a mission as far as the pier: legs planned, the law of what they really take or the
vehicle that sails them, and the routes to set out with. `simulate` sails it again and again.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from fiveroute.errors import InputError
from fiveroute.fleet_plan import FleetPlan
from fiveroute.fleet_planning import sail
from fiveroute.fleet_runs import FleetRuns, Pier
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.reading import on_voyage
from fiveroute.result import Result, Status

if TYPE_CHECKING:
    from fiveroute.formats.plan_file import PlanFile
    from fiveroute.paths.voyage import Voyage
    from fiveroute.problem import TeamOrienteering
    from fiveroute.routes import Plan

__all__ = ["Actuation", "prepare", "simulate"]

Actuation = Literal["abstraction", "vehicle"]
"""What a leg takes: equation (12), or what a vehicle needs for it in a true current."""


def prepare(
    instance: Instance,
    filed: PlanFile | None = None,
    *,
    planner: str = "five-tier",
    fleet_size: int | None = None,
    reserve: float = 1.645,
    actuation: Actuation = "abstraction",
    straight_lines: bool = False,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> Pier:
    """Plan the legs, and the routes where no plan is given: the one that does best in rehearsals.

    Parameters
    ----------
    instance
        The mission.
    filed
        A plan for it.
    planner
        Who will steer, see `fiveroute.sea.simulation.PLANNERS`.
    fleet_size
        Number of AUVs; None takes that of the plan, of the instance, or else estimates it.
    reserve
        Standard deviations of the remaining time that AUVs keep in hand.
    actuation
        What a leg takes.
    straight_lines
        Whether to ignore the ocean.
    limits
        When to stop.
    seed
        Seed of the random numbers.
    progress
        Told what is at work.
    folder
        Folder that the name of the instance's file of currents is relative to.
    """
    from fiveroute.sea.departure import departure_plan
    from fiveroute.sea.sailed_luck import VehicleModel
    from fiveroute.sea.world import World
    from fiveroute.tiers.preplanning import fleet_size_of

    if actuation not in get_args(Actuation):
        known = ", ".join(get_args(Actuation))
        raise InputError(f"take one of {known}", field="actuation", value=actuation)
    clock = (limits or Limits()).start()
    voyage = sail(
        instance,
        folder=folder,
        straight_lines=straight_lines,
        limits=clock.limits,
        seed=seed,
        progress=progress,
    )
    given = None if filed is None else on_voyage(filed, voyage)
    if given is None:
        rng = np.random.default_rng(seed)
        size = fleet_size or fleet_size_of(voyage.instance, voyage.travel, rng=rng)
    elif fleet_size in (None, given.fleet_size):
        size = given.fleet_size
    else:
        raise InputError(
            f"the plan has {given.fleet_size} AUVs; leave the size out, or plan anew",
            field="fleet_size",
            value=fleet_size,
        )
    world = World.of(voyage.instance, size, travel=voyage.travel, out_of_reach=voyage.out_of_reach)
    if actuation == "vehicle":
        model = VehicleModel.of(voyage, folder or Path())
        world = world.sailed_by(model, seed, limits=clock.rest())
    if given is None:
        # Who plans anew at once, and slowly, need not rehearse what it sets out with itself.
        rehearsing = "of-one-mind" if planner == "re-optimising" else planner
        routes = departure_plan(
            world.by_law, rehearsing, reserve=reserve, seed=seed, limits=clock.rest()
        )
        given = _rehearsed(voyage, world.problem, routes, clock.seconds, seed)
    return Pier(given, world)


def _rehearsed(
    voyage: Voyage, problem: TeamOrienteering, routes: Plan, seconds: float, seed: int
) -> FleetPlan:
    """Routes that did best in rehearsals; where nobody gets home in time they break (6)."""
    collected = routes.objective(problem)
    result = Result("rehearsals", Status.FEASIBLE, routes, collected, None, seconds, seed)
    return FleetPlan.of(voyage, problem, result)


def simulate(
    instance: Instance,
    plan: FleetPlan | None = None,
    *,
    planner: str = "five-tier",
    runs: int = 50,
    fleet_size: int | None = None,
    reserve: float = 1.645,
    channel: str = "unlimited",
    loss: float | None = None,
    failures: float = 0.0,
    actuation: Actuation = "abstraction",
    gap: bool = False,
    straight_lines: bool = False,
    workers: int = 1,
    limits: Limits | float | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> FleetRuns:
    """Carry a plan out in many oceans, the same ones for every planner.

    Parameters
    ----------
    instance
        The mission.
    plan
        The plan to set out with; None plans for the sea that is to be expected.
    planner
        Who steers, see `fiveroute.sea.simulation.PLANNERS`.
    runs
        Oceans to sail in.
    fleet_size
        Number of AUVs; None takes that of the plan, of the instance, or else estimates it.
    reserve
        Standard deviations of the remaining time that AUVs keep in hand; 0 is the paper.
    channel
        What the AUVs talk over, a name in `fiveroute.sea.agents.channel.PRESETS`.
    loss, failures
        Probabilities that a message is lost, and that an AUV fails in mid-mission; without the
        first, messages are lost as the channel loses them.
    actuation
        What a leg takes.
    gap
        Whether to compare every run with a clairvoyant plan.
    straight_lines
        Whether to ignore the ocean.
    workers
        Processes on this machine.
    limits
        Seconds, or limits.
    seed
        Seed of the random numbers; the same on any number of workers.
    progress
        Told how many runs are done.
    folder
        Folder that the name of the instance's file of currents is relative to.

    Raises
    ------
    InputError
        If an option makes no sense, or the plan was made for other nodes.
    """
    from fiveroute.sea.agents.channel import PRESETS
    from fiveroute.sea.campaign import Campaign, sail_campaign

    if runs < 1:
        raise InputError("must be at least 1", field="runs", value=runs)
    if channel not in PRESETS:
        raise InputError(f"is none of {', '.join(PRESETS)}", field="channel", value=channel)
    if plan is not None and not _are_of_one_mission(instance, plan.instance):
        raise InputError(
            "was made for other nodes; plan this mission, or leave the plan out",
            field="plan",
            value=plan.instance.name,
        )
    clock = Limits.of(limits).start()
    pier = prepare(
        instance,
        None if plan is None else plan.filed(),
        planner=planner,
        fleet_size=fleet_size,
        reserve=reserve,
        actuation=actuation,
        straight_lines=straight_lines,
        limits=clock.limits,
        seed=seed,
        progress=progress,
        folder=folder,
    )
    how = {
        "planner": planner,
        "reserve": reserve,
        "channel": PRESETS[channel],
        "loss": loss,
        "failures": failures,
        "gap": gap,
        "seed": seed,
    }
    result = sail_campaign(
        Campaign(pier.world, pier.routes, runs, how),
        workers=workers,
        limits=clock.rest(),
        progress=progress,
    )
    return FleetRuns(pier, result, seed)


def _are_of_one_mission(one: Instance, other: Instance) -> bool:
    """Whether the stops are the same; fleet, ocean and luck may differ."""
    return [node.id for node in one.nodes] == [node.id for node in other.nodes] and np.array_equal(
        one.points, other.points
    )
