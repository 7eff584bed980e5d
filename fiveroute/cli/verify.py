"""``fiveroute verify``: the independent judge."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from fiveroute.cli import options

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from fiveroute.check import Violation

__all__ = ["command"]


@click.command("verify")
@options.instance
@click.argument("plan", type=click.Path(path_type=Path))
@options.straight_lines
@options.json_output
@click.pass_context
def command(
    ctx: click.Context, instance: Path, plan: Path, straight_lines: bool, as_json: bool
) -> None:
    """Judge PLAN for INSTANCE: every violation, with its AUV, node and amount.

    Where the instance has an ocean, the paths of the plan are sailed through it; a plan without
    paths takes the fastest ones. Exit code 0 for a feasible plan, 1 for one with violations.
    """
    from fiveroute.check import check, check_claims
    from fiveroute.cli import answers
    from fiveroute.cli.judging import judged_legs
    from fiveroute.formats import read_instance
    from fiveroute.formats.plan_file import read_plan

    mission = read_instance(instance)
    filed = read_plan(plan, mission)
    travel: NDArray[np.float64] | None = None
    violations: list[Violation] = []
    if mission.has_ocean and not straight_lines:
        travel, violations = judged_legs(mission, filed, instance.parent)
    size = mission.fleet_size or max(len(filed.routes), 1)
    problem = mission.problem(size, travel)
    violations = violations + check(problem, filed.plan)
    if not violations:
        violations = check_claims(problem, filed.plan, filed.objective, filed.durations)
    answer = answers.verify_answer(mission, problem, filed, violations)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_verdict(answer)
    ctx.exit(1 if violations else 0)
