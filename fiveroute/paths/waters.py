"""What a path planner knows: the current, the barriers, and how fast and tightly an AUV moves."""

from __future__ import annotations

from dataclasses import dataclass

from fiveroute.errors import InputError
from fiveroute.ocean.barriers import Barriers
from fiveroute.ocean.current_grid import CurrentGrid

__all__ = ["Waters"]


@dataclass(frozen=True, slots=True, eq=False)
class Waters:
    """What a path planner knows of the ocean and of the vehicle.

    Parameters
    ----------
    grid
        The current.
    barriers
        Obstacles, land, and the edge of the region.
    speed
        V, speed through the water in metres per second.
    turning_radius
        Least radius of a turn in metres; 0 turns on the spot.
    """

    grid: CurrentGrid
    barriers: Barriers
    speed: float
    turning_radius: float = 0.0

    def __post_init__(self) -> None:
        if not self.speed > 0.0:
            raise InputError("an AUV must move", field="speed", value=self.speed)
        if not self.turning_radius >= 0.0:
            raise InputError(
                "a turning radius must not be negative",
                field="turning_radius",
                value=self.turning_radius,
            )
