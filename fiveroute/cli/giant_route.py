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
    from fiveroute.cli.files import read_mission
    from fiveroute.cli.running import run
    from fiveroute.limits import Limits
    from fiveroute.tiers.preplanning import find_giant_route

    mission = read_mission(instance, straight_lines=straight_lines)
    problem = mission.problem(mission.fleet_size or 1)
    outcome = run(
        lambda limits, progress: find_giant_route(
            problem, limits, exact=exact, seed=seed, progress=progress
        ),
        Limits(time_limit),
    )
    answer = answers.giant_route_answer(mission, outcome.value, seed)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_giant_route(answer)
    ctx.exit(answers.exit_code(outcome.value.status, outcome.interrupted))
