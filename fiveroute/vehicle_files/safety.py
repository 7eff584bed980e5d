"""What must be safe before a vehicle sees it.

The judge of plans and that of paths look at the very waypoints that would be written: a plan
that visits a node twice, that exceeds an endurance, whose straight lines between waypoints
cross land or an obstacle, or that dives below the depth rating, does not leave fiveroute.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fiveroute.check import Violation
from fiveroute.check_paths import check_paths
from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.ocean.currents import Current
from fiveroute.vehicle_files.mission import Waypoint
from fiveroute.verdict import judge

__all__ = ["require_depths", "require_feasible", "require_passable"]

Tracks = Sequence[Sequence[NDArray[np.float64]]]

_REASONS = {
    "fleet_size": "its routes are {amount:+.0f} more or less than the AUVs of its fleet",
    "visited_twice": "{auv} visits node {node} again",
    "over_budget": "{auv} exceeds its endurance by {amount:.1f} s",
    "path": "the path of {auv} to {node} misses its ends, or legs are missing ({amount:g})",
    "collision": "the path of {auv} to {node} leads {amount:.1f} m through land or an obstacle",
    "impassable": "the current is too strong for {auv} on its path to {node}",
    "objective": "it claims {amount:+g} data more than it collects",
    "duration": "the route of {auv} claims {amount:+.1f} s more than it takes",
}


def require_feasible(filed: PlanFile, folder: Path) -> None:
    """Refuse a plan that the judge calls infeasible.

    Parameters
    ----------
    filed
        The plan; it must know no other nodes than its instance.
    folder
        Folder that the name of the instance's file of currents is relative to.
    """
    _refuse(filed, judge(filed.instance, filed, folder).violations)


def require_passable(filed: PlanFile, tracks: Tracks, current: Current) -> None:
    """Refuse paths that cross land or obstacles, or that the current does not let pass."""
    _refuse(filed, check_paths(filed.instance, filed.plan, tracks, current))


def require_depths(waypoints: Sequence[Waypoint], rating: float | None) -> None:
    """Refuse waypoints below the depth rating."""
    for waypoint in waypoints:
        if rating is not None and waypoint.depth > rating:
            raise InputError(
                f"is deeper than the vehicle's rating of {rating:g} m; pass a smaller --depth, or "
                "leave the node out",
                field=f"depth at {waypoint.name or 'a bend'!s}",
                value=waypoint.depth,
            )


def _refuse(filed: PlanFile, violations: Sequence[Violation]) -> None:
    if not violations:
        return
    first, names = violations[0], filed.vertex_names
    last = len(filed.instance.nodes) + 1
    node = "the destination" if first.node == last else repr(names[first.node or 0])
    reason = _REASONS[first.kind].format(
        auv="the fleet" if first.auv is None else f"AUV {first.auv + 1}",
        node=node,
        amount=first.amount,
    )
    more = f" (faults after this one: {len(violations) - 1})" if len(violations) > 1 else ""
    raise InputError(f"is unsafe: {reason}{more}; plan it again, in its ocean", field="plan")
