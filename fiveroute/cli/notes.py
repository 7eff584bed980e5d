"""What a command says beside its answer: on standard error, so that answers can be piped."""

from __future__ import annotations

import click

__all__ = ["note"]


def note(sentence: str) -> None:
    """Say a sentence to whoever runs the command."""
    click.echo(f"fiveroute: {sentence}", err=True)
