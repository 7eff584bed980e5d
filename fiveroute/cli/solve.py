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
    type=click.FloatRange(min=0.0),
    default=0.0,
    show_default=True,
    help="Relative optimality gap at which to stop.",
)
@options.straight_lines
@click.option(
    "--certificate",
    type=click.Path(path_type=Path),
    help="Write what `verify --certificate` needs to confirm the bound of the relaxation.",
)
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
    certificate: Path | None,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Best plan for INSTANCE with a proof, or the best bound in the time given."""
    from fiveroute.cli import answers
    from fiveroute.cli.certifying import write_certificate
    from fiveroute.cli.files import require_output
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import completed, file_plan, sail
    from fiveroute.exact import solve_from_good_plan
    from fiveroute.formats import read_instance
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.paths.voyage import Voyage
    from fiveroute.problem import TeamOrienteering
    from fiveroute.result import Result

    for path in (output, certificate):
        require_output(path, force)
    mission = read_instance(instance)

    def work(
        limits: Limits, progress: ProgressCallback | None
    ) -> tuple[Voyage, TeamOrienteering, Result]:
        clock = limits.start()
        voyage = sail(mission, instance, limits, straight_lines=straight_lines, progress=progress)
        problem = voyage.instance.problem(fleet_size, voyage.travel)
        result = solve_from_good_plan(problem, method, clock.rest(), progress=progress)
        return voyage, problem, result

    outcome = run(work, Limits(time_limit, gap))
    voyage, problem, result = outcome.value
    file_plan(voyage, problem, result, output, force=force, source=instance)
    if certificate is not None:
        write_certificate(mission, voyage, problem, certificate, force=force)
    answer = completed(answers.solve_answer(voyage.instance, problem, result), voyage)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_routes(answer)
    ctx.exit(answers.exit_code(result.status, outcome.interrupted))
