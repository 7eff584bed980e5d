"""``fiveroute gap``: the planner against exact solutions or bounds, and against its peers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from fiveroute.cli import options
from fiveroute.cli.solve import METHODS

if TYPE_CHECKING:
    from fiveroute.experiments.gap_row import GapRow, Side

__all__ = ["command"]

PEERS = ("ortools", "pyvrp", "vroom")

_SIDES: Mapping[str | None, Side] = {
    None: "both",
    "heuristic": "heuristic",
    "exact": "exact",
}

_PICTURES = (".png", ".svg", ".pdf")


@click.command("gap")
@click.argument("instances", nargs=-1, required=True, type=click.Path(path_type=Path))
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
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="Best-known values: columns instance and best_known. No solver sees them.",
)
@options.workers
@click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler to run on instead.")
@click.option(
    "--keep",
    type=click.Path(path_type=Path),
    metavar="FOLDER",
    help="Keep every row in this folder as soon as it is done, and use those it has.",
)
@options.straight_lines
@click.option(
    "--picture",
    type=click.Path(path_type=Path),
    help="Draw shares of instances over gap and time, .png, .svg or .pdf.",
)
@options.output("Write the table to this file, .csv, .md or .parquet.")
@options.force
@options.json_output
@click.pass_context
def command(
    ctx: click.Context,
    instances: tuple[Path, ...],
    fleet_size: int | None,
    time_limit: float,
    exact_time_limit: float,
    method: str,
    only: str | None,
    peers: tuple[str, ...],
    seed: int,
    reference: Path | None,
    workers: int,
    scheduler: str | None,
    keep: Path | None,
    straight_lines: bool,
    picture: Path | None,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Plan every one of INSTANCES, bound it, and print how far the plans are from optimal.

    INSTANCES are files, or folders of files. The planner has the time limit, the exact method
    starts from its plan and has the exact time limit on top. Everybody works on one core.
    """
    from dataclasses import asdict

    from fiveroute.cli import answers
    from fiveroute.cli.files import require_folder, require_output
    from fiveroute.cli.gap_answer import print_gaps
    from fiveroute.cli.running import run
    from fiveroute.errors import InputError
    from fiveroute.experiments.gap_campaign import measure_all, read_entries
    from fiveroute.experiments.gap_row import GapSettings
    from fiveroute.experiments.gap_table import flat_rows, read_reference, summarise
    from fiveroute.experiments.kept_rows import KeptRows
    from fiveroute.experiments.run_table import require_table, write_rows
    from fiveroute.limits import Limits, ProgressCallback
    from fiveroute.peers import require_peers

    for path in (output, picture):
        require_output(path, force)
    if output is not None:
        require_table(output)
    if picture is not None and picture.suffix not in _PICTURES:
        raise InputError(
            f"a picture ends in {', '.join(_PICTURES)}", field="picture", value=str(picture)
        )
    require_folder(keep, (), force)
    asked = tuple(dict.fromkeys(peers))
    require_peers(asked, time_limit)
    known = read_reference(reference) if reference else {}
    entries, notes = read_entries(instances)
    for note in notes:
        _say(note)
    settings = GapSettings(
        time_limit=time_limit,
        exact_time_limit=exact_time_limit,
        method=method,
        side=_SIDES[only],
        fleet_size=fleet_size,
        peers=asked,
        straight_lines=straight_lines,
        seed=seed,
    )

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
    for row in rows:
        if row.unreachable:
            _say(f"{row.instance}: {row.unreachable} nodes cannot be reached and are not visited")
    for name in summary.contradictions:
        _say(f"{name}: the best known value is above the proven bound; one of them is wrong")
    if output is not None and rows:
        write_rows(flat_rows(rows), output, force)
    if picture is not None and rows:
        _draw(rows, picture)
    if as_json:
        table = [row.as_document() for row in rows]
        answers.print_json({"rows": table, "summary": asdict(summary)})
    else:
        print_gaps(rows, summary)
    ctx.exit(130 if outcome.interrupted else 0)


def _say(sentence: str) -> None:
    click.echo(f"fiveroute: {sentence}", err=True)


def _draw(rows: Sequence[GapRow], file: Path) -> None:
    from fiveroute.experiments.gap_table import proof_times, shortfalls
    from fiveroute.experiments.pictures import gap_profile, save

    save(gap_profile(shortfalls(rows), proof_times(rows)), file)
