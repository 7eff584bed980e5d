"""``fiveroute export``: a plan for vehicles and map programs."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

import click

from fiveroute.cli import options
from fiveroute.cli.notes import aside
from fiveroute.words import clock, counted

__all__ = ["command"]

_FORMATS = (
    "qgc",
    "wpl",
    "neptus",
    "moos",
    "slocum",
    "cola2",
    "gpx",
    "kml",
    "geojson",
    "csv",
)


@click.command("export")
@click.argument("plan", type=options.FILE)
@click.option(
    "--to", "format_name", type=click.Choice(_FORMATS), required=True, help="Format to write."
)
@options.output(
    "File to write; a folder for moos and slocum, and for a fleet in qgc, wpl or cola2.",
    required=True,
)
@click.option("--auv", type=options.Whole(min=1), metavar="K", help="The K-th AUV only.")
@click.option(
    "--depth",
    type=options.METRES,
    metavar="D",
    help="Cruising depth in metres, positive down; without it that of the instance.",
)
@click.option(
    "--origin",
    type=options.POSITION,
    metavar="LON,LAT",
    help="Where x = y = 0 lies, for plans that do not say.",
)
@click.option(
    "--vehicle",
    "names",
    multiple=True,
    metavar="NAME",
    help="Name of an AUV, once for each in their order; without it auv-1, auv-2, ...",
)
@click.option(
    "--depart",
    type=click.DateTime(["%Y-%m-%dT%H:%M", "%Y-%m-%dT%H:%M:%S", "%Y-%m-%dT%H:%M:%SZ"]),
    metavar="UTC",
    help="Departure, as 2016-01-31T12:00; adds times to gpx, kml, geojson and csv.",
)
@click.option(
    "--tolerance",
    type=options.METRES,
    default=1.0,
    show_default=True,
    metavar="METRES",
    help="How far straight lines between waypoints may leave a path.",
)
@options.force
def command(
    plan: Path,
    format_name: str,
    output: Path,
    auv: int | None,
    depth: float | None,
    origin: tuple[float, float] | None,
    names: tuple[str, ...],
    depart: datetime | None,
    tolerance: float,
    force: bool,
) -> None:
    """Write PLAN for vehicles or map programs.

    A plan that is infeasible, crosses land or obstacles, or dives too deep is refused.
    """
    from fiveroute.formats.plan_file import read_plan
    from fiveroute.vehicle_files import Choices, export_plan

    choices = Choices(
        depth=depth,
        origin=origin,
        auv=auv,
        names=names,
        departure=depart,
        tolerance=tolerance,
    )
    mission = export_plan(read_plan(plan), plan, format_name, output, choices, force)
    for vehicle in mission.vehicles:
        nodes = sum(point.kind == "node" for point in vehicle.waypoints)
        home = clock(vehicle.waypoints[-1].arrival)
        aside(
            f"{vehicle.name}: {counted(nodes, 'node')}, "
            f"{counted(len(vehicle.waypoints), 'waypoint')}, home after {home}"
        )
