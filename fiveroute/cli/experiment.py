"""``fiveroute experiment``: the paper's Section IV."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from fiveroute.cli import options
from fiveroute.cli.notes import note

__all__ = ["command"]


_scenarios = click.option(
    "--scenarios",
    type=options.Whole(min=1),
    default=20,
    show_default=True,
    metavar="N",
    help="Number of scenarios.",
)


_runs = click.option(
    "--runs",
    type=options.Whole(min=1),
    default=50,
    show_default=True,
    metavar="K",
    help="Oceans a scenario.",
)


@click.group("experiment")
def command() -> None:
    """Repeat the paper's experiments."""


@command.command("preplanning")
@_scenarios
@options.seed
@options.output("Folder for report, tables and pictures.", kind=options.FOLDER)
@options.force
@options.json_output
@click.pass_context
def preplanning(
    ctx: click.Context,
    scenarios: int,
    seed: int,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Section IV-B: the giant-route method against Voronoi, k-means and AHC."""
    from fiveroute.cli import answers
    from fiveroute.cli.files import require_folder
    from fiveroute.cli.running import run
    from fiveroute.experiments.preplanning import Scenario, run_scenarios
    from fiveroute.experiments.preplanning_report import FILES, report, summary, write_report
    from fiveroute.limits import Limits, Progress, ProgressCallback

    require_folder(output, FILES, force)

    def work(limits: Limits, progress: ProgressCallback | None) -> list[Scenario]:
        clock = limits.start()

        def tell(what: str) -> None:
            if progress is not None:
                progress(Progress(clock.seconds, message=what))

        done = []
        for scenario in run_scenarios(scenarios, seed, tell):
            done.append(scenario)
            if clock.interrupted:
                break
        return done

    outcome = run(work, Limits())
    if output is not None:
        write_report(outcome.value, output, force)
    if as_json:
        answers.print_json(summary(outcome.value))
    else:
        click.echo(report(outcome.value), nl=False)
    ctx.exit(130 if outcome.interrupted else 0)


@command.command("stochastic")
@_scenarios
@_runs
@options.actuation
@options.reserve
@options.workers
@options.scheduler
@options.seed
@options.output(
    "Folder for report, tables and pictures, and for what is done as soon as it is done.",
    kind=options.FOLDER,
)
@options.force
@options.json_output
@click.pass_context
def stochastic(
    ctx: click.Context,
    /,
    workers: int,
    scheduler: str | None,
    output: Path | None,
    force: bool,
    as_json: bool,
    **choices: Any,
) -> None:
    """Section IV-C and D: the five-tiered planner against FTCMP and RMMP, with and without tier 5.

    With --output, a campaign that was killed goes on where it was.
    """
    from fiveroute.cli import answers
    from fiveroute.cli.files import require_folder
    from fiveroute.cli.running import run
    from fiveroute.experiments.stochastic import cells_of, registered, sail_cells
    from fiveroute.experiments.stochastic_cell import Outcome
    from fiveroute.experiments.stochastic_report import FILES, report, summary, write_report
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.sharing import require_scheduler

    require_folder(output, FILES, force)
    require_scheduler(scheduler)
    cells = cells_of(**choices)
    registry = None if output is None else registered(output, choices, force=force)

    def work(limits: Limits, progress: ProgressCallback | None) -> list[Outcome]:
        folder = None if output is None else output / "cells"
        return sail_cells(
            cells,
            folder,
            workers=workers,
            scheduler=scheduler,
            limits=limits,
            progress=progress,
        )

    outcome = run(work, Limits())
    if outcome.interrupted:
        note("interrupted; the same call with --output goes on")
        ctx.exit(130)
    if output is not None:
        write_report(outcome.value, output, force)
    if registry is not None:
        registry.end()
    if as_json:
        answers.print_json(summary(outcome.value))
    else:
        click.echo(report(outcome.value), nl=False)


@command.command("coordination")
@click.option(
    "--scenarios",
    type=options.Whole(min=0),
    default=5,
    show_default=True,
    metavar="N",
    help="Scenarios of the ablations; 0 for none.",
)
@_runs
@options.seed
@options.output("Folder for report and pictures.", kind=options.FOLDER)
@options.force
@options.json_output
@click.pass_context
def coordination(
    ctx: click.Context,
    scenarios: int,
    runs: int,
    seed: int,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Section IV-C in single missions, and what every part of the planner is worth.

    --output gets the pictures: typical missions with three and with four AUVs, with and without
    coordination; one run hour by hour; an auction. Ablations take about two minutes a scenario.
    """
    from fiveroute.cli import answers
    from fiveroute.cli.files import require_folder
    from fiveroute.cli.running import run
    from fiveroute.experiments.ablations import Trial, gathered, sail_variants
    from fiveroute.experiments.coordination_cases import CASES, Case, sail_case
    from fiveroute.experiments.coordination_report import FILES, report, summary, write_report
    from fiveroute.limits import Limits, Progress, ProgressCallback

    require_folder(output, FILES, force)

    def work(limits: Limits, progress: ProgressCallback | None) -> tuple[list[Case], list[Trial]]:
        clock, trials = limits.start(), list[Trial]()
        cases = [sail_case(*case, runs, seed) for case in CASES]
        for trial in sail_variants(scenarios, runs, seed=seed):
            trials.append(trial)
            if progress is not None:
                message = f"scenario {trial.scenario}: {trial.variant.name}"
                progress(Progress(clock.seconds, message=message))
            if clock.interrupted:
                break
        return cases, trials

    outcome = run(work, Limits())
    cases, rows = outcome.value[0], gathered(outcome.value[1])
    if output is not None:
        write_report(cases, rows, runs, output, force)
    if as_json:
        answers.print_json(summary(cases, rows))
    else:
        click.echo(report(cases, rows, runs), nl=False)
    ctx.exit(130 if outcome.interrupted else 0)
