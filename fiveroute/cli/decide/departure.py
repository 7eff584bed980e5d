"""``fiveroute decide departure``: when to leave."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from fiveroute.cli import options
from fiveroute.cli.decide.question import Work, bound, question
from fiveroute.cli.decide.values import values

__all__ = ["command"]


@question(
    "departure",
    values(
        "--hours",
        default="0:24:3",
        what="Hours after the departure that the instance states, or else the file's first time.",
    ),
    options.fleet_size,
    bound,
)
def command(instance: Path, hours: tuple[float, ...], **how: Any) -> Work:
    """When to leave: the mission at different times of its forecast."""
    from fiveroute.decide.departures import sweep_departures
    from fiveroute.formats import read_instance

    return partial(sweep_departures, read_instance(instance), hours, **how, folder=instance.parent)
