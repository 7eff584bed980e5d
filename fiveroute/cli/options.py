"""Options that several commands share, each defined once."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

__all__ = [
    "fleet_size",
    "force",
    "instance",
    "json_output",
    "output",
    "reserve",
    "seed",
    "straight_lines",
    "time_limit",
    "workers",
]


Command = TypeVar("Command", bound=Callable[..., Any])


class _Seconds(click.ParamType[float]):
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


class _Metres(click.ParamType[float]):
    name = "metres"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        try:
            metres = float(value)
        except ValueError:
            metres = math.nan
        if not 0.0 <= metres < math.inf:
            self.fail(f"{value!r} is not a number of metres, 0 or more", param, ctx)
        return metres


METRES = _Metres()


class _Positive(click.ParamType[float]):
    name = "positive"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not 0.0 < number < math.inf:
            self.fail(f"{value!r} is not a finite number above 0", param, ctx)
        return number


POSITIVE = _Positive()


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
