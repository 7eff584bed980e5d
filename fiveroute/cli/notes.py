"""What a command says: its answer, and on standard error whatever is beside it.

Names come from files of strangers, and a terminal obeys what it is told by signs that nobody sees;
they become spaces. A note that cannot be said is lost, an answer is not: `fiveroute.cli.main` ends
with an error then.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from typing import TextIO

import click

from fiveroute.words import printable

__all__ = ["aside", "hush", "note", "tell"]


def tell(line: str) -> None:
    """Print a line of the answer."""
    click.echo(printable(line))


def note(sentence: str) -> None:
    """Say a sentence to whoever runs the command."""
    aside(f"fiveroute: {printable(sentence)}")


def aside(text: str) -> None:
    """Print on standard error, so that answers can be piped, if there is anybody to read it."""
    try:
        click.echo(text, err=True)
    except OSError:
        hush(sys.stderr)


def hush(stream: TextIO) -> None:
    """Send nowhere what a stream that cannot be written still holds."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
