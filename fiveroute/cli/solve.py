"""``fiveroute solve``: exact methods."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("solve")
@options.instance
@click.option(
    "--method",
    type=click.Choice(["auto", "brute-force", "circuit", "compact", "flow"]),
    default="auto",
    show_default=True,
    help="Exact method; auto chooses one and says which.",
)
@options.fleet_size
@options.time_limit
@click.option(
    "--gap",
    type=click.FloatRange(min=0.0),
    default=0.0,
    show_default=True,
    help="Relative optimality gap at which to stop.",
)
@options.straight_lines
@options.output("Write the plan to this file.")
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
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Best plan for INSTANCE with a proof, or the best bound in the time given."""
    from fiveroute.cli import answers
    from fiveroute.cli.files import read_mission, require_output
    from fiveroute.cli.running import run
    from fiveroute.formats.plan_file import PlanFile, write_plan
    from fiveroute.limits import Limits
    from fiveroute.models import solve

    require_output(output, force)
    mission = read_mission(instance, straight_lines=straight_lines)
    problem = mission.problem(fleet_size)
    outcome = run(
        lambda limits, progress: solve(problem, method, limits, progress=progress),
        Limits(time_limit, gap),
    )
    result = outcome.value
    if output is not None and result.plan is not None:
        write_plan(PlanFile.of(mission, problem, result), output, force, source=instance)
    answer = answers.solve_answer(mission, problem, result)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_routes(answer)
    ctx.exit(answers.exit_code(result.status, outcome.interrupted))
