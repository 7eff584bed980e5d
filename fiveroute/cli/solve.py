"""``fiveroute solve``: exact methods."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]

METHODS = (
    "auto",
    "branch-price",
    "brute-force",
    "circuit",
    "compact",
    "enumeration",
    "flow",
)


@click.command("solve")
@options.instance
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default="auto",
    show_default=True,
    help="Exact method; auto chooses one and says which.",
)
@options.fleet_size
@options.time_limit
@click.option(
    "--gap",
    type=options.Real(min=0.0),
    default=0.0,
    show_default=True,
    metavar="G",
    help="Relative optimality gap at which to stop.",
)
@options.straight_lines
@click.option(
    "--certificate",
    type=options.FILE,
    help="File for what `verify --certificate` needs to confirm the bound of the relaxation.",
)
@options.output("File for the plan.")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instance: Path,
    method: str,
    fleet_size: int | None,
    time_limit: float,
    gap: float,
    straight_lines: bool,
    certificate: Path | None,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Best plan for INSTANCE with a proof, or the best bound in the time given."""
    from fiveroute.cli.certifying import write_certificate
    from fiveroute.cli.files import require_outputs
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import answer_plan
    from fiveroute.fleet_planning import solve
    from fiveroute.formats import read_instance
    from fiveroute.limits import Limits

    require_outputs(output, certificate, force=force)
    mission = read_instance(instance)
    outcome = run(
        lambda limits, progress: solve(
            mission,
            method=method,
            fleet_size=fleet_size,
            straight_lines=straight_lines,
            limits=limits,
            progress=progress,
            folder=instance.parent,
        ),
        Limits(time_limit, gap),
    )
    if certificate is not None:
        solved = outcome.value
        write_certificate(mission, solved.voyage, solved.problem, certificate, force=force)
    answer_plan(ctx, outcome, source=instance, output=output, force=force, as_json=as_json)
