"""``fiveroute simulate``: a plan carried out in the uncertain ocean, again and again."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fiveroute.cli import options

if TYPE_CHECKING:
    from fiveroute.experiments.registry import Registry
    from fiveroute.formats.plan_file import PlanFile
    from fiveroute.instance import Instance
    from fiveroute.limits import Clock
    from fiveroute.paths.voyage import Voyage
    from fiveroute.plan import Plan
    from fiveroute.sea.theatre import Theatre

__all__ = ["command"]

PLANNERS = (
    "five-tier",
    "cbba",
    "no-coordination",
    "ftcmp",
    "rmmp",
    "of-one-mind",
    "own-pick-up",
    "to-the-letter",
    "re-optimising",
)
CHANNELS = ("unlimited", "fsk", "psk", "nanomodem", "bursty")


@click.command("simulate")
@options.instance
@click.argument("plan", type=click.Path(path_type=Path), required=False)
@click.option(
    "--planner",
    type=click.Choice(PLANNERS),
    default="five-tier",
    show_default=True,
    help="Who steers: the five tiers with and without coordination, the paper's competitors, "
    "perfect communication, or no auction.",
)
@options.fleet_size
@click.option(
    "--runs", type=click.IntRange(min=1), default=50, show_default=True, help="Oceans to sail in."
)
@options.seed
@options.reserve
@click.option(
    "--channel",
    type=click.Choice(CHANNELS),
    default="unlimited",
    show_default=True,
    help="Acoustic channel between the AUVs.",
)
@click.option(
    "--loss", type=click.FloatRange(0.0, 1.0), metavar="P", help="Probability of losing a message."
)
@click.option(
    "--failures",
    type=click.FloatRange(0.0, 1.0),
    default=0.0,
    show_default=True,
    metavar="P",
    help="Probability that an AUV fails in mid-mission.",
)
@options.actuation
@click.option("--gap", is_flag=True, help="Compare each run with a clairvoyant plan (slower).")
@options.workers
@options.scheduler
@options.time_limit
@options.straight_lines
@click.option(
    "--events", type=click.Path(path_type=Path), help="Write every event to this JSON lines file."
)
@options.output("Write a row a run to this file, .parquet or .csv.")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    /,
    instance: Path,
    plan: Path | None,
    workers: int,
    scheduler: str | None,
    time_limit: float,
    events: Path | None,
    output: Path | None,
    force: bool,
    as_json: bool,
    **choices: Any,
) -> None:
    """Carry PLAN out in the uncertain ocean of INSTANCE; without PLAN, plan first."""
    from fiveroute.cli import answers
    from fiveroute.cli.files import require_output
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import sail
    from fiveroute.experiments.campaign import Campaign, sail_campaign
    from fiveroute.experiments.run_table import event_lines, require_table, write_table
    from fiveroute.formats import read_instance
    from fiveroute.formats.files import write_text_atomically
    from fiveroute.formats.plan_file import read_plan
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.sea.simulation import SimulationResult

    for path in (events, output):
        require_output(path, force)
    if output is not None:
        require_table(output)
    mission = read_instance(instance)
    filed = None if plan is None else read_plan(plan, mission)
    log = events is not None
    registry = None
    if output is not None:
        config = {**choices, "log": log}
        anew = force or time_limit < math.inf  # such a plan cannot be made again
        registry = _registered(output, config, mission, instance, plan, anew)

    def work(limits: Limits, progress: ProgressCallback | None) -> tuple[Voyage, SimulationResult]:
        clock = limits.start()
        voyage = sail(
            mission,
            instance,
            limits,
            straight_lines=choices["straight_lines"],
            seed=choices["seed"],
            progress=progress,
        )
        theatre, routes = _prepared(voyage, instance.parent, filed, clock, choices)
        campaign = Campaign(theatre, routes, choices["runs"], _steering(choices, log))
        result = sail_campaign(
            campaign,
            workers=workers,
            scheduler=scheduler,
            journal=None if registry is None else registry.journal,
            limits=clock.rest(),
            progress=progress,
        )
        return voyage, result

    outcome = run(work, Limits(time_limit))
    voyage, result = outcome.value
    if events is not None:
        write_text_atomically(events, event_lines(voyage.instance, result), force)
    if output is not None:
        write_table(result, output, force)
    if registry is not None:
        registry.end()
    answer = answers.simulation_answer(voyage, result, choices["seed"])
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_simulation(answer)
    ctx.exit(130 if outcome.interrupted else 0)


def _registered(
    output: Path,
    config: dict[str, Any],
    mission: Instance,
    instance: Path,
    plan: Path | None,
    anew: bool,
) -> Registry:
    """Enter the campaign in the registry beside its table."""
    from fiveroute.experiments import campaign
    from fiveroute.experiments.registry import Registry, file_hash
    from fiveroute.formats.native import instance_hash
    from fiveroute.formats.plan_file import currents_hash

    inputs = {
        "instance": instance_hash(mission),
        "currents": currents_hash(mission, instance),
        "plan": None if plan is None else file_hash(plan),
    }
    path = output.with_suffix(".run.json")
    return Registry.begin(path, config, inputs, campaign.__name__, force=anew)


def _prepared(
    voyage: Voyage, folder: Path, filed: PlanFile | None, clock: Clock, choices: dict[str, Any]
) -> tuple[Theatre, Plan]:
    """The theatre, and the routes of the plan file or else those of the rehearsed plan."""
    import numpy as np

    from fiveroute.sea.departure import departure_plan
    from fiveroute.sea.sailed_luck import VehicleModel
    from fiveroute.sea.theatre import Theatre
    from fiveroute.tiers.preplanning import fleet_size_of

    seed = choices["seed"]
    routes = None if filed is None else _routes(filed, voyage)
    if routes is not None:
        size = len(routes.routes)
    else:
        rng = np.random.default_rng(seed)
        size = choices["fleet_size"] or fleet_size_of(voyage.instance, voyage.travel, rng=rng)
    theatre = Theatre.of(voyage.instance, size, travel=voyage.travel)
    if choices["actuation"] == "vehicle":
        theatre = theatre.sailed_by(VehicleModel.of(voyage, folder), seed)
    if routes is None:
        routes = departure_plan(
            theatre.by_law,
            choices["planner"],
            reserve=choices["reserve"],
            seed=seed,
            limits=clock.rest(),
        )
    return theatre, routes


def _steering(choices: dict[str, Any], log: bool) -> dict[str, Any]:
    """The arguments of `simulate_fleet` among the choices."""
    from fiveroute.sea.channel import PRESETS

    same = ("planner", "reserve", "loss", "failures", "seed", "gap")
    steering = {name: choices[name] for name in same}
    return steering | {"channel": PRESETS[choices["channel"]], "log": log}


def _routes(filed: PlanFile, voyage: Voyage) -> Plan:
    """The routes of a plan file over the nodes that can be reached."""
    from fiveroute.plan import Plan

    vertex = {node.id: k for k, node in enumerate(voyage.instance.nodes, start=1)}
    return Plan.of([vertex[name] for name in route if name in vertex] for route in filed.routes)
