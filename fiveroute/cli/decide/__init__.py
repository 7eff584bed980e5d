"""``fiveroute decide``: what is decided before departure. One file a question.

A question reads its options, and returns the work that makes a table of its values. What all
questions share, from the limits to the picture, is in `question`.
"""

from __future__ import annotations

import click

from fiveroute.cli.decide import departure, ensemble, fleet_size, reserve, speed

__all__ = ["command"]


@click.group("decide")
def command() -> None:
    """Decide before departure: fleet size, departure, speed, reserve, and against an ensemble."""


for question in (fleet_size, departure, speed, reserve, ensemble):
    command.add_command(question.command)
