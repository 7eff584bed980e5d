"""How much work tier 2 takes on, by the size of the mission.

A run without a time limit counts its steps instead of timing them, so that a seed gives
one plan on every machine. What suits the paper's size would take hours at thousands of
nodes; here is the one place where the counts shrink. Measured on one core of 2020, an
individual of T takes about 10 + 0.0006 r^3 microseconds to be born, polished and judged,
with r nodes on a sub-route, and Algorithm 1 calls T some three times per AUV and start.
"""

from __future__ import annotations

from dataclasses import dataclass

from fiveroute.heuristics.sggarp import Genetics
from fiveroute.tiers.routing import RouteSearch

__all__ = ["Effort", "effort_for"]


@dataclass(frozen=True, slots=True)
class Effort:
    """Amount of work of tier 2.

    Parameters
    ----------
    starts
        Number of allocations that Algorithm 1 starts from.
    search
        How it searches.
    """

    starts: int
    search: RouteSearch


def effort_for(nodes: int, fleet_size: int) -> Effort:
    """The effort for a mission: about a second at the paper's size, half a minute at 5,000 nodes.

    Parameters
    ----------
    nodes
        Number n of sensor nodes.
    fleet_size
        Number M of AUVs.
    """
    microseconds = 1e6 * (1.0 + nodes / 200.0)
    birth = 10.0 + 6e-4 * (nodes / fleet_size) ** 3
    individuals = microseconds / (3 * fleet_size * birth)  # per AUV and call, over all starts
    if individuals < 12:
        return Effort(1, RouteSearch(genetics=None))
    if individuals < 500:
        size = min(20, int(individuals**0.5) + 2)
        return Effort(1, RouteSearch(Genetics(size, int(individuals) // size), offered=50))
    return Effort(min(int(individuals // 500), 16), RouteSearch(Genetics()))
