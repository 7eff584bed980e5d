"""``fiveroute decide fleet-size``: how many AUVs."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from fiveroute.cli import options
from fiveroute.cli.decide.question import Work, at_sea, bound, question
from fiveroute.cli.decide.values import values

if TYPE_CHECKING:
    from fiveroute.mission import Bounding

__all__ = ["command"]


@question(
    "fleet-size",
    values("--sizes", default="1:6:1", what="Numbers of AUVs."),
    bound,
    options.straight_lines,
)
def command(
    instance: Path, sizes: tuple[float, ...], bound: Bounding, straight_lines: bool, seed: int
) -> Work:
    """How many AUVs: what each number of them collects, and could collect at most."""
    from fiveroute.decide.fleet_sizes import sweep_fleet_sizes
    from fiveroute.errors import InputError
    from fiveroute.formats import read_instance

    if any(size < 1 or size != int(size) for size in sizes):
        raise InputError("must be whole numbers from 1 on", field="--sizes", value=list(sizes))
    sweep = partial(sweep_fleet_sizes, sizes=[int(size) for size in sizes], bound=bound)
    mission = read_instance(instance)
    return at_sea(sweep, mission, instance, straight_lines=straight_lines, seed=seed)
