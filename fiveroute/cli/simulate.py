"""``fiveroute simulate``: a plan carried out in the uncertain ocean, again and again."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fiveroute.cli import options
from fiveroute.cli.notes import note, tell

if TYPE_CHECKING:
    from fiveroute.experiments.registry import Registry
    from fiveroute.fleet_runs import FleetRuns
    from fiveroute.instance import Instance
    from fiveroute.limits import Limits, ProgressCallback

__all__ = ["command"]

PLANNERS = (
    "five-tier",
    "short-sighted",
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
_PREPARING = ("planner", "fleet_size", "reserve", "actuation", "straight_lines", "seed")


@click.command("simulate")
@options.instance
@click.argument("plan", type=options.FILE, required=False)
@click.option(
    "--planner",
    type=click.Choice(PLANNERS),
    default="five-tier",
    show_default=True,
    help="Who steers: the five tiers with and without coordination, the paper's competitors, "
    "perfect communication, or no auction.",
)
@options.fleet_size
@options.runs
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
    "--loss", type=options.Real(0.0, 1.0), metavar="P", help="Probability of losing a message."
)
@click.option(
    "--failures",
    type=options.Real(0.0, 1.0),
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
@click.option("--events", type=options.FILE, help="File for every event, as JSON lines.")
@click.option(
    "--tracks",
    type=options.FILE,
    help="File for the track of every AUV, as CF trajectories: .nc.",
)
@options.output("File for a table, a row a run: .csv, .md or .parquet.")
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
    tracks: Path | None,
    output: Path | None,
    force: bool,
    as_json: bool,
    **choices: Any,
) -> None:
    """Carry PLAN out in the uncertain ocean of INSTANCE; without PLAN, plan first."""
    from fiveroute.cli import answers
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import tell_of
    from fiveroute.fleet_runs import FleetRuns
    from fiveroute.fleet_sailing import prepare
    from fiveroute.formats import read_instance
    from fiveroute.formats.plan_file import read_plan
    from fiveroute.heuristics.shortest_routes import is_proved_infeasible
    from fiveroute.limits import Limits
    from fiveroute.sea.campaign import Campaign, sail_campaign
    from fiveroute.sharing import require_scheduler

    require_scheduler(scheduler)
    files = _Files(events, tracks, output, force)
    files.check()
    mission = read_instance(instance)
    filed = None if plan is None else read_plan(plan, mission)
    config = {**choices, "log": files.need_log}
    anew = force or time_limit < math.inf  # a plan under a time limit cannot be made again
    registry = output and _registered(output, config, mission, instance, plan, anew)

    def work(limits: Limits, progress: ProgressCallback | None) -> FleetRuns:
        clock = limits.start()
        pier = prepare(
            mission,
            filed,
            **{name: choices[name] for name in _PREPARING},
            limits=limits,
            progress=progress,
            folder=instance.parent,
        )
        tell_of(pier.plan.voyage)
        result = sail_campaign(
            Campaign(pier.world, pier.routes, choices["runs"], _steering(config)),
            workers=workers,
            scheduler=scheduler,
            journal=registry.journal if registry else None,
            limits=clock.rest(),
            progress=progress,
        )
        return FleetRuns(pier, result, choices["seed"])

    outcome = run(work, Limits(time_limit))
    runs = outcome.value
    files.write(runs)
    if registry:
        registry.end()
    if choices["gap"] and runs.online_gap is None:
        note("no gap is given: a vehicle would have to sail all legs")
    if as_json:
        answers.print_json(answers.simulation_answer(runs))
    else:
        for line in str(runs).splitlines():
            tell(line)
    no_plan_exists = is_proved_infeasible(runs.pier.world.problem)
    if no_plan_exists:
        note("the destination is out of reach in time; AUVs come home late")
    ctx.exit(130 if outcome.interrupted else int(no_plan_exists))


@dataclass(frozen=True, slots=True)
class _Files:
    """What is written of a simulation, each if its file is named."""

    events: Path | None
    tracks: Path | None
    output: Path | None
    force: bool

    @property
    def need_log(self) -> bool:
        return self.events is not None or self.tracks is not None

    def check(self) -> None:
        """Refuse what could not be written, before any time is spent."""
        from fiveroute.cli.files import require_outputs
        from fiveroute.formats.tables import require_table
        from fiveroute.formats.track_file import require_tracks

        require_outputs(self.events, self.tracks, self.output, force=self.force)
        require_tracks(self.tracks, self.force)
        if self.output is not None:
            require_table(self.output)

    def write(self, runs: FleetRuns) -> None:
        if self.events is not None:
            runs.save_events(self.events, force=self.force)
        if self.tracks is not None:
            runs.save_tracks(self.tracks, force=self.force)
        if self.output is not None:
            runs.save(self.output, force=self.force)


def _registered(
    output: Path,
    config: dict[str, Any],
    mission: Instance,
    instance: Path,
    plan: Path | None,
    anew: bool,
) -> Registry:
    """Enter the campaign in the registry beside its table."""
    from fiveroute.experiments.registry import Registry, file_hash
    from fiveroute.formats.native import instance_hash
    from fiveroute.formats.plan_file import currents_hash
    from fiveroute.sea import campaign

    inputs = {
        "instance": instance_hash(mission),
        "currents": currents_hash(mission, instance),
        "plan": None if plan is None else file_hash(plan),
    }
    path = output.with_suffix(".run.json")
    return Registry.begin(path, config, inputs, campaign.__name__, force=anew)


def _steering(config: dict[str, Any]) -> dict[str, Any]:
    """The arguments of `simulate_fleet` among the options."""
    from fiveroute.sea.agents.channel import PRESETS

    same = ("planner", "reserve", "loss", "failures", "seed", "gap", "log")
    steering = {name: config[name] for name in same}
    return steering | {"channel": PRESETS[config["channel"]]}
