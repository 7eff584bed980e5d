"""The current and the barriers that a mission states: their parts put together."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from fiveroute.instance import Instance
from fiveroute.ocean.barriers import Barriers
from fiveroute.ocean.current_grid import Region
from fiveroute.ocean.currents import Current, LambVortices, Superposition, UniformCurrent
from fiveroute.ocean.land_mask import land_distance
from fiveroute.ocean.obstacles import barriers_of

if TYPE_CHECKING:
    from fiveroute.ocean.model_current import ModelCurrent

__all__ = ["filed_current", "stated_barriers", "stated_current"]


def stated_current(instance: Instance, folder: Path | None = None) -> Superposition:
    """Superpose vortices, uniform current and file of an instance; still water if it has none.

    Parameters
    ----------
    instance
        The instance.
    folder
        Folder that the name of the file is relative to; None takes it as it is.

    Raises
    ------
    InputError
        If the file cannot be read as a current.
    """
    currents = instance.ocean.currents
    parts: list[Current] = []
    if currents.vortices:
        table = np.array([(v.x, v.y, v.circulation, v.radius) for v in currents.vortices])
        parts.append(LambVortices(*table.T.copy()))
    if currents.uniform is not None:
        parts.append(UniformCurrent(currents.uniform.u, currents.uniform.v))
    filed = filed_current(instance, folder)
    if filed is not None:
        parts.append(filed)
    return Superposition(tuple(parts))


def filed_current(instance: Instance, folder: Path | None = None) -> ModelCurrent | None:
    """The current of an instance's file, see `stated_current`; None if it names none."""
    currents = instance.ocean.currents
    if currents.file is None:
        return None
    file = (folder or Path()) / currents.file
    return _filed_current(file, _stamp(file), instance.origin, currents.depth, currents.begin)


def stated_barriers(
    instance: Instance, current: Superposition, region: Region | None = None
) -> Barriers:
    """Obstacles and land of an instance and its file of currents, with the margin to be kept.

    Parameters
    ----------
    instance
        The instance.
    current
        Its current, see `stated_current`.
    region
        Where paths must stay; None lets them go anywhere.
    """
    from fiveroute.ocean.model_current import ModelCurrent

    land = None
    for part in current.parts:
        if isinstance(part, ModelCurrent):
            land = land_distance(part.closed, part.west, part.south, part.step)
    return barriers_of(instance.ocean, region, margin=instance.ocean.margin, land=land)


@lru_cache(maxsize=1)
def _filed_current(
    file: Path,
    stamp: tuple[int, ...],
    origin: tuple[float, float] | None,
    depth: float,
    begin: str | None,
) -> ModelCurrent:
    """The current of a file; a mission that is planned again and again reads it once."""
    from fiveroute.ocean.model_current import read_current

    return read_current(file, origin=origin, depth=depth, begin=begin)


def _stamp(file: Path) -> tuple[int, ...]:
    """What changes with the content of a file; nothing for one that cannot be read."""
    try:
        found = file.stat()
    except (OSError, ValueError):
        return ()
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns
