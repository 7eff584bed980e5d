"""How many AUVs? What every number of them collects at most, and what the plan for it collects.

The estimate (17) of tier 1 is pointed out; the curve shows what one more AUV would bring.
"""

from __future__ import annotations

from collections.abc import Sequence

from fiveroute.decide.sweep import Row, Sweep, figures, vary
from fiveroute.errors import InputError
from fiveroute.fleet_plan import FleetPlan
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.mission import Bounding, plan_mission
from fiveroute.paths.voyage import Voyage

__all__ = ["sweep_fleet_sizes"]


def sweep_fleet_sizes(
    voyage: Voyage,
    sizes: Sequence[int],
    *,
    bound: Bounding = "quick",
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Sweep:
    """Plan a mission with every number of AUVs.

    Parameters
    ----------
    voyage
        The mission and its leg times.
    sizes
        Numbers of AUVs.
    bound
        Where the upper bounds come from.
    limits
        When to stop, shared among the sizes.
    seed
        Seed of the random numbers.
    progress
        Told what is at work.

    Raises
    ------
    InputError
        If the endurance is stated for every AUV on its own: then the fleet has its size.
    """
    endurance = voyage.mission.fleet.endurance
    if isinstance(endurance, tuple):
        raise InputError(
            f"states {len(endurance)} AUVs one by one; give one number for all to vary the fleet",
            field="fleet.endurance",
        )
    estimates: list[float | None] = []

    def row(size: float, limits: Limits) -> Row:
        planned = plan_mission(
            voyage.instance,
            travel=voyage.travel,
            fleet_size=int(size),
            bound=bound,
            limits=limits,
            seed=seed,
        )
        estimates.append(planned.fleet_estimate)
        return figures(FleetPlan.of(voyage, planned.problem, planned.result, planned))

    clock = (limits or Limits()).start()
    name = voyage.mission.name
    sweep = vary(name, "fleet_size", "", sizes, row, clock=clock, progress=progress)
    known = [estimate for estimate in estimates if estimate is not None]
    return sweep.marking(known[0], "estimate (17)") if known else sweep
