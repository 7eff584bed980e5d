"""``fiveroute path``: tier 3 alone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from fiveroute.cli import options

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from fiveroute.instance import Instance

__all__ = ["command"]

_LONGEST = 4.0
"""Duration of a path in a current that varies, at most, in times of that in still water."""


@click.command("path")
@options.instance
@click.argument("origin", metavar="FROM")
@click.argument("goal", metavar="TO")
@click.option(
    "--depart",
    type=options.Real(min=0.0),
    default=0.0,
    show_default=True,
    metavar="T",
    help="Seconds after the beginning of the mission at which the AUV leaves.",
)
@options.time_limit
@options.seed
@options.picture("current, obstacles, path and reference")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instance: Path,
    origin: str,
    goal: str,
    depart: float,
    time_limit: float,
    seed: int,
    picture: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fastest path in the ocean of INSTANCE between two stops, and how far from a reference.

    FROM and TO are ids of nodes, `start` or `destination`.
    """
    from fiveroute.cli import answers
    from fiveroute.cli.files import require_output, require_picture
    from fiveroute.cli.running import run
    from fiveroute.formats import read_instance
    from fiveroute.limits import Limits
    from fiveroute.ocean.stated import stated_current
    from fiveroute.paths.stated_waters import waters_of
    from fiveroute.tiers.pathing import plan_path

    require_output(picture, force)
    require_picture(picture)
    mission = read_instance(instance)
    ends = [_position(mission, name, field) for name, field in ((origin, "FROM"), (goal, "TO"))]
    way = float(np.hypot(*(ends[1] - ends[0]))) / mission.fleet.speed
    waters = waters_of(
        mission, stated_current(mission, instance.parent), duration=depart + _LONGEST * way
    )
    clock = Limits(time_limit).start()
    outcome = run(
        lambda limits, _: plan_path(waters, *ends, begin=depart, seed=seed, limits=limits),
        clock.limits,
    )
    planned, seconds = outcome.value, clock.seconds
    if picture is not None:
        from fiveroute.experiments.pictures import path_map
        from fiveroute.plots.saving import save_figure

        save_figure(path_map(waters, planned, f"{mission.name}: {origin} to {goal}"), picture)
    answer = answers.path_answer(mission, (origin, goal), planned, seconds)
    if as_json:
        answers.print_json(answer)
    else:
        answers.print_path(answer)
    code = 0 if planned.path.is_found else 1
    ctx.exit(130 if outcome.interrupted else code)


def _position(mission: Instance, name: str, field: str) -> NDArray[np.float64]:
    """Where a stop is, in metres, shape (2,)."""
    from fiveroute.errors import InputError, nearest

    names = ["start", *(node.id for node in mission.nodes), "destination"]
    if name not in names:
        raise InputError(
            f"is no stop of {mission.name!r}; {nearest(name, names)}",
            field=field,
            value=name,
        )
    position: NDArray[np.float64] = mission.points[names.index(name)]
    return position
