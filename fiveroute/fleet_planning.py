"""Planning a fleet in its ocean, for people who call fiveroute from Python.

    import fiveroute as fr

    plan = fr.plan(fr.read("sea.json"))
    print(plan)
    plan.save("plan.json")

`plan` and `solve` do what the commands of the same names do: the legs are planned in the ocean of
the instance first (tier 3), then the fleet (tiers 1 and 2, or an exact method).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from fiveroute.errors import InputError
from fiveroute.fleet_plan import FleetPlan
from fiveroute.instance import Instance
from fiveroute.limits import Limits, ProgressCallback
from fiveroute.paths.voyage import Voyage

if TYPE_CHECKING:
    from fiveroute.mission import Bounding, Search
    from fiveroute.tiers.preplanning import Allocation

__all__ = ["plan", "sail", "solve"]

_SHARE_OF_PATHS = 0.5
"""Share of a time limit that planning the paths may take."""


def sail(
    instance: Instance,
    *,
    folder: Path | None = None,
    straight_lines: bool = False,
    limits: Limits | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Voyage:
    """Plan the legs of a mission in its ocean, or take straight lines where it has none.

    Parameters
    ----------
    instance
        The mission.
    folder
        Folder that the name of its file of currents is relative to.
    straight_lines
        Whether to ignore the ocean.
    limits
        Limits of all the work; the legs take half of the time at most.
    seed
        Seed of the random numbers.
    progress
        Told how many paths are planned.
    """
    if not isinstance(instance, Instance):
        raise InputError(
            "is no mission; read its file first, fiveroute.read(path)",
            field="instance",
            value=instance,
        )
    if straight_lines or not instance.has_ocean:
        return Voyage.straight(instance)
    from fiveroute.tiers.pathing import at_sea

    limits = limits or Limits()
    until = limits.within(_SHARE_OF_PATHS * limits.time)
    return at_sea(instance, folder, limits=until, seed=seed, progress=progress)


def plan(
    instance: Instance,
    *,
    fleet_size: int | None = None,
    search: Search = "fleet",
    bound: Bounding = "quick",
    allocation: Allocation = "giant-route",
    samples: int = 0,
    quantile: float | None = None,
    straight_lines: bool = False,
    limits: Limits | float | None = None,
    seed: int = 0,
    workers: int = 1,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> FleetPlan:
    """Plan a fleet: how many AUVs, the route of each, and how far from optimal.

    Parameters
    ----------
    instance
        The mission.
    fleet_size
        Number of AUVs; None takes that of the instance, or else estimates it by (17).
    search
        ``fleet``, or the paper's pipeline alone.
    bound
        Where the upper bound comes from: ``none``, ``quick``, or ``exact``, which may improve
        the plan as well.
    allocation
        How the paper's pipeline first shares the nodes out.
    samples, quantile
        Number of sampled leg times to plan with, for the search ``paper``, and the quantile of
        a route's time that must fit the endurance; None takes their mean.
    straight_lines
        Whether to ignore the ocean.
    limits
        Seconds, or limits; None lets every search end by itself.
    seed
        Seed of the random numbers; without a time limit it determines the plan.
    workers
        Number of threads of the fleet search; the plan does not depend on it.
    progress
        Called as the work goes on.
    folder
        Folder that the name of the instance's file of currents is relative to.

    Raises
    ------
    InputError
        If the options contradict each other, a stop lies on land, or no fleet size is stated
        and none can be estimated.
    """
    from fiveroute.mission import plan_mission, require_options

    require_options(search, bound, allocation, samples, quantile, seed, workers)
    clock = Limits.of(limits).start()
    voyage = sail(
        instance,
        folder=folder,
        straight_lines=straight_lines,
        limits=clock.limits,
        seed=seed,
        progress=progress,
    )
    planned = plan_mission(
        voyage.instance,
        travel=voyage.travel,
        fleet_size=fleet_size,
        allocation=allocation,
        search=search,
        bound=bound,
        samples=samples,
        quantile=quantile,
        limits=clock.rest(),
        seed=seed,
        workers=workers,
        progress=progress,
    )
    return FleetPlan.of(voyage, planned.problem, planned.result, planned)


def solve(
    instance: Instance,
    *,
    method: str = "auto",
    fleet_size: int | None = None,
    straight_lines: bool = False,
    limits: Limits | float | None = None,
    seed: int = 0,
    progress: ProgressCallback | None = None,
    folder: Path | None = None,
) -> FleetPlan:
    """The best plan with a proof, or the best plan and bound in the time given.

    Parameters
    ----------
    instance
        The mission.
    method
        A name in `fiveroute.models.METHODS`, or ``auto``.
    fleet_size
        Number of AUVs; None takes that of the instance.
    straight_lines
        Whether to ignore the ocean.
    limits
        Seconds, or limits; None goes on until the plan is proved.
    seed
        Seed of the search for the plan that the proof starts from.
    progress
        Told of better plans and bounds.
    folder
        Folder that the name of the instance's file of currents is relative to.
    """
    from fiveroute.exact import solve_from_good_plan

    clock = Limits.of(limits).start()
    voyage = sail(
        instance,
        folder=folder,
        straight_lines=straight_lines,
        limits=clock.limits,
        seed=seed,
        progress=progress,
    )
    problem = voyage.instance.problem(fleet_size, voyage.travel)
    result = solve_from_good_plan(problem, method, clock.rest(), seed=seed, progress=progress)
    return FleetPlan.of(voyage, problem, result)
