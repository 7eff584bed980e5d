"""``fiveroute giant-route``: one route through every node."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("giant-route")
@options.instance
@click.option("--exact", is_flag=True, help="Prove it optimal, as far as the time allows.")
@options.time_limit
@options.seed
@options.straight_lines
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instance: Path,
    exact: bool,
    time_limit: float,
    seed: int,
    straight_lines: bool,
    as_json: bool,
) -> None:
    """Shortest route from start to destination through all nodes of INSTANCE."""
    from fiveroute.cli import answers
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import sail
    from fiveroute.formats import read_instance
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.paths.voyage import Voyage
    from fiveroute.result import GiantRouteResult
    from fiveroute.tiers.preplanning import find_giant_route

    mission = read_instance(instance)

    def work(limits: Limits, progress: ProgressCallback | None) -> tuple[Voyage, GiantRouteResult]:
        clock = limits.start()
        voyage = sail(
            mission, instance, limits, straight_lines=straight_lines, seed=seed, progress=progress
        )
        problem = voyage.instance.problem(mission.fleet_size or 1, voyage.travel)
        route = find_giant_route(problem, clock.rest(), exact=exact, seed=seed, progress=progress)
        return voyage, route

    outcome = run(work, Limits(time_limit))
    voyage, result = outcome.value
    answer = answers.giant_route_answer(voyage.instance, result, seed)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_giant_route(answer)
    ctx.exit(answers.exit_code(result.status, outcome.interrupted))
