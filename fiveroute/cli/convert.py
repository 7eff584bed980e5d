"""``fiveroute convert``: from one file format to another."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("convert")
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--from",
    "source_format",
    type=click.Choice(["native", "chao", "tsplib", "oplib"]),
    help="Format of FILE; without it content and suffix tell.",
)
@click.option(
    "--to",
    "target_format",
    type=click.Choice(["native", "chao", "tsplib", "oplib"]),
    required=True,
    help="Format to write.",
)
@options.output("File to write.", required=True)
@options.force
def command(
    file: Path, source_format: str | None, target_format: str, output: Path, force: bool
) -> None:
    """Translate the instance FILE; what the target format cannot hold is refused."""
    from fiveroute.formats import read_instance, write_instance

    mission = read_instance(file, source_format)
    write_instance(mission, output, target_format, force, source=file)
