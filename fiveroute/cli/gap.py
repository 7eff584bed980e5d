"""``fiveroute gap``: the planner against exact solutions or bounds."""

from __future__ import annotations

import math
from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("gap")
@click.argument("instances", nargs=-1, required=True, type=click.Path(path_type=Path))
@options.time_limit
@click.option(
    "--exact-time-limit",
    type=options.SECONDS,
    default=10.0,
    show_default=True,
    metavar="S",
    help="Wall-clock seconds an instance for its bound.",
)
@options.seed
@click.option(
    "--reference",
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="Best-known values: columns instance and best_known.",
)
@options.straight_lines
@options.output("Write the table to this CSV file.")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instances: tuple[Path, ...],
    time_limit: float,
    exact_time_limit: float,
    seed: int,
    reference: Path | None,
    straight_lines: bool,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Plan every one of INSTANCES, bound it, and print how far the plans are from optimal."""
    from dataclasses import asdict

    from fiveroute.cli import answers
    from fiveroute.cli.files import require_output
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import sail
    from fiveroute.experiments.gap_table import (
        GapRow,
        gap_row,
        gap_table_csv,
        read_reference,
        summarise,
    )
    from fiveroute.formats import read_instance
    from fiveroute.formats.files import write_text_atomically
    from fiveroute.limits import Limits, ProgressCallback

    require_output(output, force)
    known = read_reference(reference) if reference else {}
    missions = [read_instance(path) for path in instances]

    def rows(limits: Limits, progress: ProgressCallback | None) -> list[GapRow]:
        done: list[GapRow] = []
        for mission, file in zip(missions, instances, strict=True):
            if limits.interrupt.is_set():
                break
            row = gap_row(
                sail(
                    mission,
                    file,
                    limits,
                    straight_lines=straight_lines,
                    seed=seed,
                    progress=progress,
                ),
                plan_limits=limits.within(time_limit),
                exact_limits=limits.within(exact_time_limit),
                seed=seed,
                reference=known,
                progress=progress,
            )
            done.append(row)
        return done

    outcome = run(rows, Limits(math.inf))
    table = outcome.value
    summary = summarise(table)
    if output is not None:
        write_text_atomically(output, gap_table_csv(table), force)
    if as_json:
        answers.print_json({"rows": [asdict(row) for row in table], "summary": asdict(summary)})
    else:
        answers.print_gaps(table, summary)
    ctx.exit(130 if outcome.interrupted else 0)
