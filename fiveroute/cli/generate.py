"""``fiveroute generate``: scenarios from a seed."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("generate")
@click.argument(
    "layout", metavar="LAYOUT", type=click.Choice(["paper", "uniform", "clustered", "ring"])
)
@click.option(
    "--nodes",
    type=options.Whole(0, 100_000),
    default=60,
    show_default=True,
    metavar="N",
    help="Number of sensor nodes.",
)
@options.seed
@options.new_fleet_size
@click.option(
    "--currents",
    type=click.Choice(["effective", "printed", "none"]),
    show_default="effective",
    help="Vortices of the layout 'paper': as printed they are too weak to matter.",
)
@options.output("File for the scenario.", required=True)
@options.force
def command(
    layout: str,
    nodes: int,
    seed: int,
    fleet_size: int | None,
    currents: str | None,
    output: Path,
    force: bool,
) -> None:
    """Write a scenario.

    LAYOUT is `paper` (Section IV-A), `uniform`, `clustered` or `ring`.
    """
    from fiveroute.errors import InputError
    from fiveroute.formats import write_instance
    from fiveroute.generate import generate

    if currents is not None and layout != "paper":
        raise InputError(
            f"is for the layout 'paper'; {layout!r} has still water, leave it out",
            field="--currents",
            value=currents,
        )
    scenario = generate(
        layout, nodes=nodes, seed=seed, fleet_size=fleet_size, currents=currents or "effective"
    )
    write_instance(scenario, output, force=force)
