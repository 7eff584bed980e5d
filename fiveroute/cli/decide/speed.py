"""``fiveroute decide speed``: how fast."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import click

from fiveroute.cli import options
from fiveroute.cli.decide.question import Work, bound, question
from fiveroute.cli.decide.values import values

__all__ = ["command"]


@question(
    "speed",
    values(
        "--speeds",
        default="0.6:2.0:0.2",
        what="Speeds through the water in metres per second.",
    ),
    click.option(
        "--battery",
        type=options.POSITIVE,
        metavar="WH",
        help="Watt-hours of an AUV; without it what the endurance of the instance needs.",
    ),
    click.option(
        "--hotel",
        type=options.POSITIVE,
        default=30.0,
        show_default=True,
        metavar="W",
        help="Power of electronics and sensors.",
    ),
    click.option(
        "--propulsion",
        type=options.POSITIVE,
        default=4.05,
        show_default=True,
        metavar="W",
        help="Power of propulsion at 1 m/s; it grows as the cube of the speed.",
    ),
    options.fleet_size,
    bound,
    options.straight_lines,
)
def command(
    instance: Path, speeds: tuple[float, ...], hotel: float, propulsion: float, **how: Any
) -> Work:
    """How fast: a faster AUV goes farther in an hour, and has fewer hours."""
    from fiveroute.decide.speeds import PowerModel, sweep_speeds
    from fiveroute.formats import read_instance

    power = PowerModel(hotel, propulsion)
    mission = read_instance(instance)
    return partial(sweep_speeds, mission, speeds, power=power, **how, folder=instance.parent)
