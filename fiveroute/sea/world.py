"""What a simulation knows of a mission: its problem, the law of its legs, and where things are."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.instance import Instance, Uncertainty
from fiveroute.limits import Limits
from fiveroute.problem import TeamOrienteering, completion_rate
from fiveroute.sea.courses.outlook import Outlook, Pace
from fiveroute.sea.luck import Luck
from fiveroute.sea.sailed_luck import SailedLuck, VehicleModel
from fiveroute.sea.seeds import TRIAL_OCEANS
from fiveroute.tiers.actuation import LegLaw, leg_law, uncertainty_of
from fiveroute.vehicle.fit import Fit

__all__ = ["World"]


@dataclass(frozen=True, slots=True, eq=False)
class World:
    """A mission as the simulation sees it.

    Parameters
    ----------
    problem
        The problem, with the fleet that is sent.
    law
        What the legs really take, or, where a vehicle sails them, what is expected of them.
    points
        Positions of start, nodes and destination in metres, shape (n + 2, 2).
    lengths_km
        Lengths of the legs in kilometres, shape (n + 2, n + 2).
    model
        The vehicle that sails the legs; None where they take what the law says.
    out_of_reach
        Data of nodes that cannot be reached, which completion rates count as well.
    pace
        That of the vehicle on its way home; None where legs take what the law says.
    """

    problem: TeamOrienteering
    law: LegLaw
    points: NDArray[np.float64]
    lengths_km: NDArray[np.float64]
    model: VehicleModel | None = None
    out_of_reach: float = 0.0
    pace: Pace | None = None

    @classmethod
    def of(
        cls,
        instance: Instance,
        fleet_size: int | None = None,
        *,
        travel: NDArray[np.float64] | None = None,
        uncertainty: Uncertainty | None = None,
        out_of_reach: float = 0.0,
    ) -> World:
        """The world of an instance.

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
            The terms of (12); None takes those of the instance, see `uncertainty_of`.
        out_of_reach
            Data of nodes of the mission that the instance does not name.
        """
        problem = instance.problem(fleet_size, travel)
        lengths_km = instance.lengths_km
        law = leg_law(problem.travel, lengths_km, uncertainty or uncertainty_of(instance))
        return cls(problem, law, instance.points, lengths_km, out_of_reach=out_of_reach)

    def completion(self, collected: float) -> float:
        """Completion rate theta, (31), of the whole mission, of collected data."""
        return completion_rate(collected, self.problem.total_profit + self.out_of_reach)

    def sailed_by(
        self, model: VehicleModel, seed: int = 0, *, limits: Limits | None = None
    ) -> World:
        """The same mission, its legs sailed by a vehicle, and the law fitted to what it does.

        Parameters
        ----------
        model
            How legs are sailed.
        seed
            Seed of the simulation.
        limits
            When to end the fit.
        """
        return self.expecting(model, self.fitted(model, seed, limits=limits))

    def fitted(self, model: VehicleModel, seed: int = 0, *, limits: Limits | None = None) -> Fit:
        """What the legs of the mission make of the vehicle, in oceans of the fit's own."""
        return model.fit(self.problem.travel, seed=seed + TRIAL_OCEANS, limits=limits)

    def expecting(self, model: VehicleModel, fit: Fit) -> World:
        """The same mission, its legs sailed by a vehicle of which a fit is known.

        Equation (12) knows no delay on the average; here a leg is expected to take as much longer
        than planned as it did when the law was fitted, and scatters about that.
        """
        delay = fit.delay.value
        uncertainty = replace(
            fit.uncertainty, drift=fit.drift.value / (1.0 + delay), floor=self.law.floor
        )
        law = leg_law((1.0 + delay) * self.problem.travel, self.lengths_km, uncertainty)
        pace = Pace((1.0 + delay) * fit.pace.value, (1.0 + delay) * fit.scatter.value)
        return replace(self, law=law, model=model, pace=pace)

    @property
    def by_law(self) -> World:
        """The same mission, its legs by the law alone, for fast rehearsals."""
        return replace(self, model=None)

    def outlook(self, reserve: float) -> Outlook:
        """What the AUVs expect, and keep in hand for a reserve of so many standard deviations."""
        return Outlook.of(self.problem, self.law, reserve, self.pace)

    def luck(self, seed: int, run: int) -> Luck | SailedLuck:
        """What every leg takes in one run."""
        if self.model is None:
            return Luck(self.law, seed, run)
        return SailedLuck(self.model, seed, run)
