"""Options that several commands share, each defined once."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

__all__ = [
    "ACTUATIONS",
    "FILE",
    "FOLDER",
    "Real",
    "Whole",
    "actuation",
    "fleet_size",
    "force",
    "instance",
    "json_output",
    "new_fleet_size",
    "output",
    "picture",
    "reserve",
    "runs",
    "scheduler",
    "seed",
    "straight_lines",
    "time_limit",
    "workers",
]


ACTUATIONS = ("abstraction", "vehicle")
"""What a leg may take in a simulation."""

Command = TypeVar("Command", bound=Callable[..., Any])


class Whole(click.IntRange):
    """A whole number in a range."""

    name = "whole number"


class Real(click.FloatRange):
    """A finite number in a range: what is no number is in none."""

    name = "number"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Read a number."""
        number = float(super().convert(value, param, ctx))
        if not math.isfinite(number):
            self.fail(f"{value!r} is not a finite number", param, ctx)
        return number


class _Seconds(click.ParamType[float]):
    """A time limit; infinity is none."""

    name = "seconds"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        try:
            seconds = float(value)
        except ValueError:
            seconds = math.nan
        if not seconds > 0.0:
            self.fail(f"{value!r} is not a positive number of seconds", param, ctx)
        return seconds


SECONDS = _Seconds()
METRES = Real(min=0.0)
POSITIVE = Real(min=0.0, min_open=True)


class _Position(click.ParamType[tuple[float, float]]):
    name = "position"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        try:
            first, second = map(float, str(value).split(","))
        except ValueError:
            first = second = math.nan
        if not (math.isfinite(first) and math.isfinite(second)):
            self.fail(f"{value!r} is not two numbers with a comma between them", param, ctx)
        return first, second


POSITION = _Position()

FILE = click.Path(path_type=Path)
FILE.name = "file"  # what help says for its values
FOLDER = click.Path(path_type=Path)
FOLDER.name = "dir"

instance = click.argument("instance", type=FILE)

fleet_size = click.option(
    "--fleet-size",
    type=Whole(min=1),
    metavar="M",
    help="Number of AUVs; without it that of the instance.",
)
new_fleet_size = click.option(
    "--fleet-size",
    type=Whole(min=1),
    metavar="M",
    help="Number of AUVs; without it the planner estimates one.",
)
runs = click.option(
    "--runs",
    type=Whole(min=1),
    default=50,
    show_default=True,
    metavar="K",
    help="Oceans to sail in.",
)
time_limit = click.option(
    "--time-limit", type=SECONDS, default=math.inf, metavar="S", help="Wall-clock seconds."
)
seed = click.option(
    "--seed",
    type=Whole(min=0),
    default=0,
    show_default=True,
    metavar="N",
    help="Same seed, same answer, as long as no time limit cuts it short.",
)
straight_lines = click.option(
    "--straight-lines", is_flag=True, help="Ignore the ocean: straight legs in still water."
)
workers = click.option(
    "--workers",
    type=Whole(min=1),
    default=1,
    show_default=True,
    metavar="W",
    help="Processes; the numbers do not depend on them.",
)
scheduler = click.option("--scheduler", metavar="ADDRESS", help="Dask scheduler to run on instead.")
actuation = click.option(
    "--actuation",
    type=click.Choice(ACTUATIONS),
    default="abstraction",
    show_default=True,
    help="What a leg takes: equation (12), or what a vehicle takes that sails it.",
)
reserve = click.option(
    "--reserve",
    type=Real(min=0.0),
    default=1.645,
    show_default=True,
    metavar="Z",
    help="Standard deviations of the remaining time kept in hand; 0 as in the paper.",
)
json_output = click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON document on standard output."
)
force = click.option("--force", is_flag=True, help="Overwrite existing files.")


def output(
    what: str, *, required: bool = False, kind: click.Path = FILE
) -> Callable[[Command], Command]:
    """``--output``, which says what is written there, in what formats if there are several."""
    return click.option("--output", type=kind, required=required, help=what)


def picture(what: str) -> Callable[[Command], Command]:
    """``--picture``, which says what is drawn there."""
    return click.option("--picture", type=FILE, help=f"Draw {what} here: .png, .svg or .pdf.")
