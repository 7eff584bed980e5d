"""``fiveroute plan``: the main job."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fiveroute.cli import options

if TYPE_CHECKING:
    from fiveroute.mission import Bounding, Search
    from fiveroute.tiers.preplanning import Allocation

__all__ = ["command"]


@click.command("plan")
@options.instance
@options.fleet_size
@options.time_limit
@options.seed
@click.option(
    "--allocation",
    type=click.Choice(["giant-route", "voronoi", "k-means", "ahc"]),
    default="giant-route",
    show_default=True,
    help="How Algorithm 1 first shares the nodes out; both searches begin with it.",
)
@click.option(
    "--search",
    type=click.Choice(["fleet", "paper"]),
    default="fleet",
    show_default=True,
    help="paper: Algorithm 1 alone; fleet: then a search over the whole fleet.",
)
@click.option(
    "--bound",
    type=click.Choice(["none", "quick", "exact"]),
    default="quick",
    show_default=True,
    help="Where the optimality gap comes from.",
)
@click.option(
    "--samples",
    type=options.Whole(min=0),
    default=0,
    show_default=True,
    metavar="K",
    help="Plan on this many sampled leg times (S-GGARP); 0 plans on the given ones.",
)
@click.option(
    "--quantile",
    type=options.Real(0.0, 1.0),
    metavar="Q",
    help="Quantile of a route's sampled time that must fit the endurance; default: the mean.",
)
@click.option(
    "--workers",
    type=options.Whole(min=1),
    metavar="W",
    help="Threads of the fleet search; default: one a core. The plan does not depend on them.",
)
@options.straight_lines
@options.output("File for the plan.")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instance: Path,
    fleet_size: int | None,
    time_limit: float,
    seed: int,
    allocation: Allocation,
    search: Search,
    bound: Bounding,
    samples: int,
    quantile: float | None,
    workers: int | None,
    straight_lines: bool,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fleet size, routes for every AUV, completion rate and optimality gap for INSTANCE."""
    from fiveroute.cli.files import require_output
    from fiveroute.cli.running import run
    from fiveroute.cli.sailing import answer_plan
    from fiveroute.fleet_planning import plan
    from fiveroute.formats import read_instance
    from fiveroute.limits import Limits

    require_output(output, force)
    mission = read_instance(instance)
    outcome = run(
        lambda limits, progress: plan(
            mission,
            fleet_size=fleet_size,
            search=search,
            bound=bound,
            allocation=allocation,
            samples=samples,
            quantile=quantile,
            straight_lines=straight_lines,
            limits=limits,
            seed=seed,
            workers=workers or os.cpu_count() or 1,
            progress=progress,
            folder=instance.parent,
        ),
        Limits(time_limit),
    )
    answer_plan(ctx, outcome, source=instance, output=output, force=force, as_json=as_json)
