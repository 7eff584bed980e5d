"""The current that a mission states: its parts put together."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fiveroute.instance import Instance
from fiveroute.ocean.currents import Current, LambVortices, Superposition, UniformCurrent

__all__ = ["stated_current"]


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
    if currents.file is not None:
        from fiveroute.ocean.model_current import read_current

        file = (folder or Path()) / currents.file
        parts.append(
            read_current(file, origin=instance.origin, depth=currents.depth, begin=currents.begin)
        )
    return Superposition(tuple(parts))
