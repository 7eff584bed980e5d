"""``fiveroute decide reserve``: how cautiously."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import click

from fiveroute.cli import options
from fiveroute.cli.decide.question import Work, at_sea, question
from fiveroute.cli.decide.values import values

__all__ = ["command"]


@question(
    "reserve",
    values(
        "--reserves",
        default="0,0.5,1,1.645,2.5",
        what="Standard deviations of the remaining time kept in hand.",
    ),
    click.option(
        "--accepted-late",
        type=options.Real(0.0, 1.0),
        default=0.01,
        show_default=True,
        metavar="P",
        help="Share of AUVs that may come home late.",
    ),
    options.runs,
    options.fleet_size,
    options.workers,
    options.straight_lines,
)
def command(
    instance: Path, reserves: tuple[float, ...], straight_lines: bool, seed: int, **how: Any
) -> Work:
    """How cautiously: data collected at sea against AUVs that come home late."""
    from fiveroute.decide.reserves import sweep_reserves
    from fiveroute.errors import InputError
    from fiveroute.formats import read_instance

    if min(reserves) < 0.0:
        raise InputError("must not be negative", field="--reserves", value=min(reserves))
    sweep = partial(sweep_reserves, reserves=reserves, **how)
    mission = read_instance(instance)
    return at_sea(sweep, mission, instance, straight_lines=straight_lines, seed=seed)
