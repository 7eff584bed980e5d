"""The legs of a filed plan, judged in the ocean of its instance."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.check import Violation
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Instance
from fiveroute.plan import Plan

if TYPE_CHECKING:
    from fiveroute.ocean.currents import Superposition

__all__ = ["judged_legs"]


def judged_legs(
    mission: Instance, filed: PlanFile, folder: Path
) -> tuple[NDArray[np.float64], list[Violation]]:
    """Times of the legs that a plan sails, and what is wrong with its paths.

    Parameters
    ----------
    mission
        The instance.
    filed
        The plan.
    folder
        Folder that the name of the instance's file of currents is relative to.

    Returns
    -------
    travel
        Leg times in seconds, shape (n + 2, n + 2), infinite where the plan has no leg.
    violations
        See `fiveroute.check_paths.check_paths`.
    """
    from fiveroute.check_paths import check_paths, times_of_paths
    from fiveroute.ocean.stated import stated_current

    last = len(mission.nodes) + 1
    plan = Plan.of([node for node in route if node < last] for route in filed.plan.routes)
    filed.require_currents(folder)
    current = stated_current(mission, folder)
    tracks = filed.tracks
    if tracks is None:
        return _fastest(mission, plan, current), []
    times = times_of_paths(mission, plan, tracks, current)
    return times, check_paths(mission, plan, tracks, current, times)


def _fastest(mission: Instance, plan: Plan, current: Superposition) -> NDArray[np.float64]:
    """Times of the fastest paths for the legs of a plan that states none."""
    from fiveroute.tiers.pathing import plan_legs, waters_of

    last = len(mission.nodes) + 1
    legs = {leg for route in plan.routes for leg in itertools.pairwise((0, *route, last))}
    return plan_legs(waters_of(mission, current), current, mission.points, only=legs).times
