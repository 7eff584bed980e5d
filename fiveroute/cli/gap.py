"""``fiveroute gap``: the planner against exact solutions or bounds, and against its peers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fiveroute.cli import options
from fiveroute.cli.notes import note
from fiveroute.cli.solve import METHODS

if TYPE_CHECKING:
    from fiveroute.experiments.gap_row import GapRow, Side
    from fiveroute.experiments.gap_table import GapSummary

__all__ = ["command"]

PEERS = ("ortools", "pyvrp", "vroom")

_SIDES: Mapping[str | None, Side] = {
    None: "both",
    "heuristic": "heuristic",
    "exact": "exact",
}


@click.command("gap")
@click.argument("instances", nargs=-1, required=True, type=options.FILE)
@options.fleet_size
@options.time_limit
@click.option(
    "--exact-time-limit",
    type=options.SECONDS,
    default=10.0,
    show_default=True,
    metavar="S",
    help="Wall-clock seconds an instance for its bound.",
)
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default="auto",
    show_default=True,
    help="Exact method.",
)
@click.option(
    "--only",
    type=click.Choice(("heuristic", "exact")),
    help="The planner without any bound, or the exact method without the planner.",
)
@click.option(
    "--peer",
    "peers",
    type=click.Choice(PEERS),
    multiple=True,
    help="Another solver, with the time limit and the core of the planner; may be repeated.",
)
@options.seed
@click.option(
    "--reference",
    type=options.FILE,
    metavar="CSV",
    help="Best-known values: columns instance and best_known. No solver sees them.",
)
@options.workers
@options.scheduler
@click.option(
    "--keep",
    type=options.FOLDER,
    help="Keep every row in this folder as soon as it is done, and use those it has.",
)
@options.straight_lines
@options.picture("shares of instances over gap and time")
@options.output("File for the table: .csv, .md or .parquet.")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    /,
    instances: tuple[Path, ...],
    only: str | None,
    peers: tuple[str, ...],
    reference: Path | None,
    workers: int,
    scheduler: str | None,
    keep: Path | None,
    picture: Path | None,
    output: Path | None,
    force: bool,
    as_json: bool,
    **how: Any,
) -> None:
    """Plan every one of INSTANCES, bound it, and print how far the plans are from optimal.

    INSTANCES are files, or folders of files. The planner has the time limit, the exact method
    starts from its plan and has the exact time limit on top. Everybody works on one core.
    """
    from fiveroute.cli import answers
    from fiveroute.cli.gap_answer import print_gaps
    from fiveroute.cli.running import run
    from fiveroute.experiments.gap_campaign import measure_all, read_entries
    from fiveroute.experiments.gap_row import GapSettings
    from fiveroute.experiments.gap_table import read_reference, summarise
    from fiveroute.experiments.kept_rows import KeptRows
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.peers import require_peers
    from fiveroute.sharing import require_scheduler

    _require(output, picture, keep, force)
    require_scheduler(scheduler)
    asked = tuple(dict.fromkeys(peers))
    require_peers(asked, how["time_limit"])
    known = read_reference(reference) if reference else {}
    entries, notes = read_entries(instances)
    for sentence in notes:
        note(sentence)
    settings = GapSettings(side=_SIDES[only], peers=asked, **how)

    def work(limits: Limits, progress: ProgressCallback | None) -> list[GapRow]:
        return measure_all(
            entries,
            settings,
            reference=known,
            kept=KeptRows(keep) if keep else None,
            workers=workers,
            scheduler=scheduler,
            limits=limits,
            progress=progress,
        )

    outcome = run(work, Limits())
    rows = outcome.value
    summary = summarise(rows)
    _warn(rows, summary)
    if rows:
        _write(rows, output, picture, force)
    if as_json:
        table = [row.as_document() for row in rows]
        answers.print_json({"rows": table, "summary": asdict(summary)})
    else:
        print_gaps(rows, summary)
    ctx.exit(130 if outcome.interrupted else 0)


def _require(output: Path | None, picture: Path | None, keep: Path | None, force: bool) -> None:
    """Refuse what could not be written, before any time is spent."""
    from fiveroute.cli.files import require_folder, require_outputs, require_picture
    from fiveroute.formats.tables import require_table

    require_outputs(output, picture, force=force)
    require_picture(picture)
    if output is not None:
        require_table(output)
    require_folder(keep, (), force)


def _warn(rows: Sequence[GapRow], summary: GapSummary) -> None:
    """Say what the table does not: nodes that are left out, values that cannot be right."""
    for row in rows:
        if row.unreachable:
            note(f"{row.instance}: {row.unreachable} nodes cannot be reached and are not visited")
    for name in summary.contradictions:
        note(f"{name}: the best known value is above the proven bound; one of them is wrong")


def _write(rows: Sequence[GapRow], output: Path | None, picture: Path | None, force: bool) -> None:
    """Write the table and draw its picture, each if its file is named."""
    if output is not None:
        from fiveroute.experiments.gap_table import flat_rows
        from fiveroute.formats.tables import write_rows

        write_rows(flat_rows(rows), output, force)
    if picture is not None:
        from fiveroute.experiments.gap_table import proof_times, shortfalls
        from fiveroute.experiments.pictures import gap_profile
        from fiveroute.plots.saving import save_figure

        save_figure(gap_profile(shortfalls(rows), proof_times(rows)), picture)
