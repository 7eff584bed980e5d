"""``fiveroute view``: a look at a plan."""

from __future__ import annotations

from pathlib import Path

import click

from fiveroute.cli import options

__all__ = ["command"]


@click.command("view")
@click.argument("plan", type=options.FILE)
@click.argument("other", type=options.FILE, required=False)
@click.option(
    "--events",
    type=options.FILE,
    multiple=True,
    help="Runs to play, as `simulate --events` wrote them; twice for PLAN and OTHER, or to "
    "compare two logs of PLAN.",
)
@click.option(
    "--tracks",
    type=click.Path(path_type=Path),
    metavar="FILE",
    multiple=True,
    help="Tracks sailed in the runs of --events, as `simulate --tracks` wrote them; once for "
    "each log.",
)
@click.option(
    "--run",
    type=options.Whole(min=0),
    metavar="K",
    help="Run to draw in a picture or film; in a page choose it there.",
)
@click.option(
    "--instance",
    type=options.FILE,
    help="Instance that the plan must be for; its folder has the file of currents.",
)
@options.output("File for page, picture or film: .html, .png, .svg, .pdf or .gif.", required=True)
@options.force
def command(
    plan: Path,
    other: Path | None,
    events: tuple[Path, ...],
    tracks: tuple[Path, ...],
    run: int | None,
    instance: Path | None,
    output: Path,
    force: bool,
) -> None:
    """Show PLAN, beside OTHER if there is one, on a page of its own that needs no network."""
    from fiveroute.cli.files import require_output
    from fiveroute.view.looks import load_scenes, require_look, write_look

    require_output(output, force)
    require_look(output)
    scenes = load_scenes([plan] if other is None else [plan, other], events, instance, tracks)
    write_look(scenes, output, run=run, force=force)
