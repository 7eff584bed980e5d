"""Options that several commands share, each defined once."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

__all__ = [
    "ACTUATIONS",
    "actuation",
    "fleet_size",
    "force",
    "instance",
    "json_output",
    "output",
    "reserve",
    "scheduler",
    "seed",
    "straight_lines",
    "time_limit",
    "workers",
]


ACTUATIONS = ("abstraction", "vehicle")
"""What a leg may take in a simulation."""

Command = TypeVar("Command", bound=Callable[..., Any])


class _Number(click.ParamType[float]):
    """A number that keeps a rule; no number keeps none."""

    def __init__(self, holds: Callable[[float], bool], rule: str) -> None:
        self.name = "number"
        self._holds, self._rule = holds, rule

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not self._holds(number):
            self.fail(f"{value!r} is not {self._rule}", param, ctx)
        return number


SECONDS = _Number(lambda seconds: seconds > 0.0, "a positive number of seconds")
METRES = _Number(lambda metres: 0.0 <= metres < math.inf, "a number of metres, 0 or more")
POSITIVE = _Number(lambda number: 0.0 < number < math.inf, "a finite number above 0")


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

instance = click.argument("instance", type=click.Path(path_type=Path))

fleet_size = click.option(
    "--fleet-size",
    type=click.IntRange(min=1),
    metavar="M",
    help="Number of AUVs; without it that of the instance.",
)
time_limit = click.option(
    "--time-limit", type=SECONDS, default=math.inf, metavar="S", help="Wall-clock seconds."
)
seed = click.option(
    "--seed",
    type=click.IntRange(min=0),
    default=0,
    show_default=True,
    help="Same seed, same answer, as long as no time limit cuts it short.",
)
straight_lines = click.option(
    "--straight-lines", is_flag=True, help="Ignore the ocean: straight legs in still water."
)
workers = click.option(
    "--workers",
    type=click.IntRange(min=1),
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
    type=click.FloatRange(min=0.0),
    default=1.645,
    show_default=True,
    metavar="Z",
    help="Standard deviations of the remaining time kept in hand; 0 as in the paper.",
)
json_output = click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON document on standard output."
)
force = click.option("--force", is_flag=True, help="Overwrite existing files.")


def output(help_text: str, *, required: bool = False) -> Callable[[Command], Command]:
    """``--output`` with its own words."""
    return click.option(
        "--output", type=click.Path(path_type=Path), required=required, help=help_text
    )
