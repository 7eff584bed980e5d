"""What a simulation knows of a mission: its problem, the law of its legs, and where things are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.generate import DEFAULT_UNCERTAINTY
from fiveroute.instance import Instance, Uncertainty
from fiveroute.problem import TeamOrienteering
from fiveroute.tiers.actuation import LegLaw, leg_law

__all__ = ["Theatre"]


@dataclass(frozen=True, slots=True, eq=False)
class Theatre:
    """A mission as the simulation sees it.

    Parameters
    ----------
    problem
        The problem, with the fleet that is sent.
    law
        What the legs really take.
    points
        Positions of start, nodes and destination in metres, shape (n + 2, 2).
    """

    problem: TeamOrienteering
    law: LegLaw
    points: NDArray[np.float64]

    @classmethod
    def of(
        cls,
        instance: Instance,
        fleet_size: int | None = None,
        *,
        travel: NDArray[np.float64] | None = None,
        uncertainty: Uncertainty | None = None,
    ) -> Theatre:
        """The theatre of an instance.

        Parameters
        ----------
        instance
            The mission.
        fleet_size
            Number of AUVs; None takes that of the instance.
        travel
            Planned leg times in seconds from tier 3, shape (n + 2, n + 2); None sails straight
            lines in still water.
        uncertainty
            The terms of (12); None takes those of the instance, or, where it states none,
            `fiveroute.generate.DEFAULT_UNCERTAINTY`.
        """
        problem = instance.problem(fleet_size, travel)
        lengths_km = instance.travel * (instance.fleet.speed / 1000.0)
        if uncertainty is None:
            stated = instance.uncertainty
            uncertainty = DEFAULT_UNCERTAINTY if stated == Uncertainty() else stated
        law = leg_law(problem.travel, lengths_km, uncertainty)
        return cls(problem, law, instance.points)
