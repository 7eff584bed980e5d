"""``fiveroute verify``: the independent judge."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fiveroute.cli import options
from fiveroute.cli.notes import tell

if TYPE_CHECKING:
    from typing import NoReturn

    from fiveroute.instance import Instance

__all__ = ["command"]


@click.command("verify")
@options.instance
@click.argument("plan", type=options.FILE, required=False)
@click.option(
    "--certificate",
    type=options.FILE,
    help="Confirm the bound that `solve --certificate` wrote, instead of judging a plan.",
)
@options.time_limit
@options.straight_lines
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instance: Path,
    plan: Path | None,
    certificate: Path | None,
    time_limit: float,
    straight_lines: bool,
    as_json: bool,
) -> None:
    """Judge PLAN for INSTANCE: every violation, with its AUV, node and amount.

    Where the instance has an ocean, the paths of the plan are sailed through it; a plan without
    paths takes the fastest ones. Exit code 0 for a feasible plan, 1 for one with violations.
    """
    from fiveroute.cli import answers
    from fiveroute.formats import read_instance
    from fiveroute.formats.plan_file import read_plan
    from fiveroute.verdict import judge

    if (plan is None) == (certificate is None):
        raise click.UsageError("give either PLAN or --certificate")
    if certificate is None and time_limit < math.inf:
        raise click.UsageError("--time-limit is for --certificate; a plan is judged to the end")
    if certificate is not None and straight_lines:
        raise click.UsageError("--straight-lines is for PLAN; a certificate says it itself")
    mission = read_instance(instance)
    if certificate is not None:
        _confirm(ctx, mission, instance, certificate, time_limit, as_json)
    assert plan is not None
    filed = read_plan(plan, mission)
    verdict = judge(mission, filed, instance.parent, straight_lines=straight_lines)
    answer = answers.verify_answer(mission, filed, verdict)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_verdict(answer)
    ctx.exit(0 if verdict.feasible else 1)


def _confirm(
    ctx: click.Context,
    mission: Instance,
    instance: Path,
    certificate: Path,
    time_limit: float,
    as_json: bool,
) -> NoReturn:
    """Confirm a certificate and leave: 0 confirmed, 1 refuted, 3 stopped before."""
    from fiveroute.cli import answers
    from fiveroute.cli.certifying import confirm_certificate
    from fiveroute.cli.running import run
    from fiveroute.limits import Limits

    outcome = run(
        lambda limits, _: confirm_certificate(mission, instance, certificate, limits),
        Limits(time_limit),
    )
    answer = outcome.value
    if as_json:
        answers.print_json(answer)
    elif answer["confirmed"]:
        tell(f"{mission.name}: no plan collects more than {answer['bound']:.10g}")
    elif answer["excess"] > 0.0:
        tell(f"{mission.name}: refuted, a route is worth {answer['excess']:.6g} too much")
    else:
        tell(f"{mission.name}: not confirmed in the time given")
    ctx.exit(0 if answer["confirmed"] else 1 if answer["excess"] > 0.0 else 3)
