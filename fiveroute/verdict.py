"""The judge of plan files: a plan in the ocean of its instance, and every rule that it breaks.

The judge shares nothing with the planners but the definition of the problem. Paths are sailed
with the instance's own current and a quadrature of their own (`fiveroute.check_paths`), routes are
walked by `fiveroute.check`, and what the file claims is compared with what was found.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fiveroute.check import Violation, check, check_claims
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Instance
from fiveroute.problem import completion_rate
from fiveroute.routes import Plan

if TYPE_CHECKING:
    from fiveroute.ocean.currents import Superposition

__all__ = ["Verdict", "judge"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """What the judge found.

    Parameters
    ----------
    objective
        Data that the known nodes on the routes hold, each counted once.
    completion_rate
        Theta, equation (31).
    durations
        Travel and service time of every route in seconds.
    violations
        Every rule that is broken, with AUV, vertex and amount.
    """

    objective: float
    completion_rate: float
    durations: tuple[float, ...]
    violations: tuple[Violation, ...]

    @property
    def feasible(self) -> bool:
        """Whether no rule is broken."""
        return not self.violations


def judge(
    mission: Instance, filed: PlanFile, folder: Path | None = None, *, straight_lines: bool = False
) -> Verdict:
    """Judge a plan for an instance.

    Parameters
    ----------
    mission
        The instance.
    filed
        The plan; without paths it takes the fastest ones.
    folder
        Folder that the name of the instance's file of currents is relative to.
    straight_lines
        Whether to ignore the ocean.

    Raises
    ------
    InputError
        If the plan was made in another ocean, or the file of currents cannot be read.
    """
    folder = folder or Path()
    travel: NDArray[np.float64] | None = None
    violations: list[Violation] = []
    last = len(mission.nodes) + 1
    known = Plan.of([node for node in route if node < last] for route in filed.plan.routes)
    if mission.has_ocean and not straight_lines:
        travel, violations = _sailed(mission, filed, known, folder)
    size = mission.fleet_size or max(len(filed.routes), 1)
    problem = mission.problem(size, travel)
    violations += check(problem, filed.plan)
    if not violations:
        violations = check_claims(problem, filed.plan, filed.objective, filed.durations)
    objective = known.objective(problem)
    return Verdict(
        objective=objective,
        completion_rate=completion_rate(objective, problem.total_profit),
        durations=known.durations(problem),
        violations=tuple(violations),
    )


def _sailed(
    mission: Instance, filed: PlanFile, plan: Plan, folder: Path
) -> tuple[NDArray[np.float64], list[Violation]]:
    """Leg times in seconds, shape (n + 2, n + 2), infinite off the plan; faults of its paths."""
    from fiveroute.check_paths import check_paths, times_of_paths
    from fiveroute.ocean.stated import stated_current

    filed.require_currents(folder)
    current = stated_current(mission, folder)
    tracks = filed.tracks
    if tracks is None:
        return _fastest(mission, plan, current), []
    times = times_of_paths(mission, plan, tracks, current)
    return times, check_paths(mission, plan, tracks, current, times)


def _fastest(mission: Instance, plan: Plan, current: Superposition) -> NDArray[np.float64]:
    """Times of the fastest paths for the legs of a plan that states none."""
    from fiveroute.paths.stated_waters import waters_of
    from fiveroute.tiers.pathing import plan_legs

    last = len(mission.nodes) + 1
    legs = {leg for route in plan.routes for leg in itertools.pairwise((0, *route, last))}
    return plan_legs(waters_of(mission, current), current, mission.points, only=legs).times
