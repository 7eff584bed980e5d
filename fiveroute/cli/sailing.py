"""From an instance file to the legs that its fleet can sail."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.paths.voyage import Voyage

if TYPE_CHECKING:
    from fiveroute.problem import TeamOrienteering
    from fiveroute.result import Result

__all__ = ["completed", "file_plan", "sail"]

_SHARE = 0.5
"""Share of a time limit that planning the paths may take."""


def sail(
    mission: Instance,
    file: Path,
    limits: Limits,
    *,
    straight_lines: bool,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Voyage:
    """Plan the legs of a mission in its ocean, or take straight lines where it has none.

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
    if straight_lines or not mission.has_ocean:
        return Voyage.straight(mission)
    from fiveroute.tiers.pathing import at_sea

    until = limits.within(_SHARE * limits.time)
    voyage = at_sea(mission, file.parent, limits=until, seed=seed, progress=progress)
    if voyage.unreachable:
        click.echo(
            "fiveroute: these nodes cannot be reached and are not visited: "
            f"{', '.join(voyage.unreachable)}",
            err=True,
        )
    return voyage


def file_plan(
    voyage: Voyage,
    problem: TeamOrienteering,
    result: Result,
    output: Path | None,
    *,
    force: bool,
    source: Path,
) -> None:
    """Write the plan of a voyage for its whole mission, if it has one and a file is asked for."""
    if output is None or result.plan is None:
        return
    from fiveroute.formats.plan_file import PlanFile, write_plan

    filed = PlanFile.of(voyage.instance, problem, result, voyage.legs)
    write_plan(replace(filed, instance=voyage.mission), output, force, source=source)


def completed(answer: dict[str, Any], voyage: Voyage) -> dict[str, Any]:
    """An answer for the voyage's instance, made one for the whole mission."""
    total = sum(node.data for node in voyage.mission.nodes)
    objective = answer["objective"]
    if objective is not None:
        answer["completion_rate"] = objective / total if total > 0.0 else 1.0
    return answer | {
        "straight_lines": voyage.legs is None,
        "unreachable": list(voyage.unreachable),
    }
