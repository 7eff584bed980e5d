"""A mission together with the leg times of its ocean."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.instance import Instance
from fiveroute.ocean.currents import Current
from fiveroute.paths.leg_table import LegTable

__all__ = ["Voyage"]


@dataclass(frozen=True, slots=True, eq=False)
class Voyage:
    """What a fleet can sail of a mission, and how long each leg takes.

    Parameters
    ----------
    mission
        The mission as it was stated.
    instance
        The mission without the nodes that cannot be reached.
    legs
        Leg times and paths between its stops; None for straight lines in still water.
    unreachable
        Ids of the nodes that cannot be reached, or from which nobody gets home.
    is_complete
        Whether that is known of every node: an interruption leaves legs open, so that nothing
        is proved about the mission.
    hasty
        The current, where time was up before all legs were timed in it, so that some of `legs` are
        a little longer than they need be; a plan times those that it takes. None otherwise.
    """

    mission: Instance
    instance: Instance
    legs: LegTable | None = None
    unreachable: tuple[str, ...] = ()
    is_complete: bool = True
    hasty: Current | None = None

    @classmethod
    def straight(cls, mission: Instance) -> Voyage:
        """The mission in straight lines and still water."""
        return cls(mission, mission)

    @property
    def travel(self) -> NDArray[np.float64] | None:
        """Leg times in seconds, shape (n + 2, n + 2); None for straight lines."""
        return None if self.legs is None else self.legs.times

    @property
    def out_of_reach(self) -> float:
        """Data of the nodes that cannot be reached; completion rates count them."""
        mission, instance = (
            sum(node.data for node in each.nodes) for each in (self.mission, self.instance)
        )
        return max(mission - instance, 0.0)
