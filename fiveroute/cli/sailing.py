"""From an instance file to the legs that its fleet can sail."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from fiveroute.cli.notes import note
from fiveroute.fleet_plan import FleetPlan
from fiveroute.fleet_planning import sail as sail_in_its_ocean
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.paths.voyage import Voyage

if TYPE_CHECKING:
    from fiveroute.cli.running import Outcome

__all__ = ["answer_plan", "sail", "tell_of"]


def sail(
    mission: Instance,
    file: Path,
    limits: Limits,
    *,
    straight_lines: bool,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Voyage:
    """Plan the legs of the mission in a file, and name the nodes that cannot be reached.

    Parameters
    ----------
    mission
        The instance.
    file
        File that it comes from; the name of its file of currents is relative to its folder.
    limits
        Limits of the whole command.
    straight_lines
        Whether to ignore the ocean.
    seed
        Seed of the random numbers.
    progress
        Told how many paths are planned.
    """
    voyage = sail_in_its_ocean(
        mission,
        folder=file.parent,
        straight_lines=straight_lines,
        limits=limits,
        seed=seed,
        progress=progress,
    )
    tell_of(voyage)
    return voyage


def tell_of(voyage: Voyage) -> None:
    """Say on standard error which nodes cannot be reached, and if legs were planned in haste."""
    if voyage.unreachable:
        why = "cannot be reached" if voyage.is_complete else "have no path yet"
        note(f"these nodes {why} and are not visited: {', '.join(voyage.unreachable)}")
    if voyage.hasty is not None:
        note("time ran out while legs were planned, so that some take longer than they need to")


def answer_plan(
    ctx: click.Context,
    outcome: Outcome[FleetPlan],
    *,
    source: Path,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """File a plan where a file is asked for, print it, and leave with the code of its status.

    Parameters
    ----------
    ctx
        The command.
    outcome
        What it came to.
    source
        File of the instance.
    output, force
        File for the plan, or None, and whether it may be overwritten.
    as_json
        Whether to print JSON.
    """
    from fiveroute.cli import answers

    plan = outcome.value
    tell_of(plan.voyage)
    if output is not None and plan.result.plan is not None:
        plan.save(output, force=force, source=source)
    answer = answers.fleet_plan_answer(plan)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_routes(answer)
    ctx.exit(answers.exit_code(plan.status, outcome.interrupted))
