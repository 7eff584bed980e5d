"""``fiveroute verify``: the independent judge."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("verify")
@options.instance
@click.argument("plan", type=click.Path(path_type=Path))
@options.json_output
@click.pass_context
def command(ctx: click.Context, instance: Path, plan: Path, as_json: bool) -> None:
    """Judge PLAN for INSTANCE: every violation, with its AUV, node and amount.

    Exit code 0 for a feasible plan, 1 for one with violations.
    """
    from fiveroute.check import check, check_claims
    from fiveroute.cli import answers
    from fiveroute.cli.files import read_mission
    from fiveroute.formats.plan_file import read_plan

    mission = read_mission(instance)
    filed = read_plan(plan, mission)
    problem = mission.problem(mission.fleet_size or max(len(filed.routes), 1))
    violations = check(problem, filed.plan)
    if not violations:
        violations = check_claims(problem, filed.plan, filed.objective, filed.durations)
    answer = answers.verify_answer(mission, problem, filed, violations)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_verdict(answer)
    ctx.exit(1 if violations else 0)
