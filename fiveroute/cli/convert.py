"""``fiveroute convert``: from one file format to another."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from fiveroute.cli import options
from fiveroute.cli.notes import note
from fiveroute.words import counted

if TYPE_CHECKING:
    from fiveroute.instance import Instance

__all__ = ["command"]

_INSTANCES = ("native", "chao", "tsplib", "oplib")
_CHARTS = ("csv", "geojson", "kml", "gpx")


@click.command("convert")
@click.argument("file", type=options.FILE)
@click.option(
    "--from",
    "source_format",
    type=click.Choice([*_INSTANCES, *_CHARTS]),
    help="Format of FILE; without it content and suffix tell.",
)
@click.option(
    "--to",
    "target_format",
    type=click.Choice(_INSTANCES),
    required=True,
    help="Format to write.",
)
@options.output("File for the instance.", required=True)
@click.option(
    "--start",
    type=options.POSITION,
    metavar="LON,LAT",
    help="Where the AUVs are released, or X,Y in metres as in FILE; else its point 'start'.",
)
@click.option(
    "--destination",
    type=options.POSITION,
    metavar="LON,LAT",
    help="Where they are recovered; else the point 'destination'.",
)
@options.new_fleet_size
@click.option("--speed", type=options.POSITIVE, metavar="V", help="Metres per second.")
@click.option(
    "--endurance", type=options.POSITIVE, metavar="S", help="Seconds that an AUV can be out."
)
@click.option("--depth", type=options.METRES, metavar="D", help="Cruising depth in metres.")
@click.option("--depth-rating", type=options.POSITIVE, metavar="D", help="Deepest dive in metres.")
@click.option(
    "--zones",
    type=options.FILE,
    metavar="CHART",
    help="Land and obstacles: the polygons of a GeoJSON, KML or KMZ file.",
)
@click.option(
    "--currents",
    type=options.FILE,
    metavar="NETCDF",
    help="File of currents of an ocean model.",
)
@options.force
def command(
    file: Path,
    source_format: str | None,
    target_format: str,
    output: Path,
    zones: Path | None,
    force: bool,
    **terms: Any,
) -> None:
    """Translate the instance FILE, or make one of a chart of nodes.

    What the target format cannot hold is refused. A chart (csv, geojson, kml, also packed
    as KMZ, or gpx) knows no fleet: the options from --start to --currents say the rest.
    """
    from fiveroute.formats import chart_text, read_instance, survey_format, write_instance

    chart = survey_format(file, chart_text(file)) if source_format is None else source_format
    found = ""
    if chart in _CHARTS:
        # a name of currents is relative to the folder of the call, whatever that of the chart
        mission, areas = _charted(file, chart, zones, terms)
        source, found = Path("chart"), _found(mission, areas)
    else:
        stated = [name for name, value in {**terms, "zones": zones}.items() if value is not None]
        if stated:
            raise click.UsageError(
                f"--{stated[0].replace('_', '-')} is for charts of nodes; FILE says it itself"
            )
        mission, source = read_instance(file, source_format), file
    write_instance(mission, output, target_format, force, source=source)
    if found:
        note(f"{output}: {found}")


def _found(mission: Instance, areas: int) -> str:
    """What a chart has become, so that whoever made it sees what was not understood."""
    import numpy as np

    size = " by ".join(f"{span / 1e3:.3g}" for span in np.ptp(mission.points, axis=0))
    parts = len(mission.ocean.obstacles) + len(mission.ocean.land)
    holes = f", cut into {parts} without holes" if parts > areas else ""
    data = f"data {mission.total_data:.6g} in all"
    if all(node.data == 1.0 for node in mission.nodes):
        data = "each counts 1 as data"
    return (
        f"{counted(len(mission.nodes), 'node')} ({data}) in {size} km, "
        f"{counted(areas, 'zone')} to keep out of{holes}"
    )


def _charted(
    file: Path, chart: str | None, zones: Path | None, terms: dict[str, Any]
) -> tuple[Instance, int]:
    """The mission that a chart of nodes becomes, and how many zones were on the charts."""
    from fiveroute.errors import InputError
    from fiveroute.formats import Terms, read_survey
    from fiveroute.formats.files import title_of
    from fiveroute.formats.native import require_name

    currents: Path | None = terms.pop("currents")
    if currents is not None and not currents.is_file():
        raise InputError("does not exist; check the name", file=currents, field="--currents")
    if currents is not None:
        require_name(str(currents))
    survey = read_survey(file, chart)
    closed = None if zones is None else read_survey(zones)
    whole = Terms(**terms, currents=None if currents is None else str(currents))
    try:
        mission = survey.instance(title_of(file), whole, closed)
    except InputError as error:
        raise error.at(file) from None
    return mission, len(survey.areas) + (0 if closed is None else len(closed.areas))
