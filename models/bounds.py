"""Quick upper bounds for any size, so that every plan can state its gap.

Three relaxations, each stronger and dearer than the one before:

- ``reachable``: the data of all nodes from which some AUV comes home in time;
- ``knapsack``: every node takes its least share of the fleet's time, see
  `fiveroute.models.knapsack_bound`;
- ``flow``: the linear relaxation of the two-index flow model with connectivity cuts, see
  `fiveroute.models.flow_relaxation`, or, for a thousand nodes and more, its smaller sister without
  directions, ``symmetric``, see `fiveroute.models.symmetric_relaxation`.

Every value is recomputed from the problem's own data by weak duality and rounded up, never taken
from a solver as it is. Where all data are multiples of one number, it is rounded down to
that grid.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from fiveroute.limits import Clock, Limits
from fiveroute.models.common_divisor import rounded_down
from fiveroute.models.knapsack_bound import knapsack_bound
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering

__all__ = ["Bound", "Effort", "quick_bound"]


class Effort(StrEnum):
    """How much work a bound may cost; more work never gives a weaker one."""

    LEAST = "least"
    """Two looks at the matrix: milliseconds, 0.5 s for 5,000 nodes."""

    QUICK = "quick"
    """A second for a few hundred nodes, some ten for 5,000."""

    FULL = "full"
    """Until the relaxation has converged, as long as the limits allow."""


@dataclass(frozen=True, slots=True)
class Bound:
    """An upper bound on the data that any plan collects.

    Parameters
    ----------
    value
        The bound; 0 where no plan exists at all.
    method
        ``reachable``, ``knapsack``, ``flow``, ``symmetric``, or ``infeasible`` where it is
        proved that no plan exists.
    """

    value: float
    method: str


def quick_bound(
    problem: TeamOrienteering, limits: Limits | None = None, *, effort: Effort = Effort.QUICK
) -> Bound:
    """Bound what any plan collects; valid whenever the limits stop it.

    Parameters
    ----------
    problem
        The problem, of any size.
    limits
        When to stop; without any it ends by itself.
    effort
        How much work to do.
    """
    clock = (limits or Limits()).start()
    network = Network.of(problem)
    if network.has_no_route:
        return Bound(0.0, "infeasible")
    reachable = float(network.profit[network.reachable].sum()) * (1.0 + _SAFE)
    bounds = [Bound(reachable, "reachable"), Bound(knapsack_bound(network), "knapsack")]
    if effort is not Effort.LEAST:
        bounds += _quick(network, clock)
    if effort is Effort.FULL:
        bounds += _full(network, clock)
    best = min(bounds, key=lambda bound: bound.value)
    if best.value < 0.0:
        return Bound(0.0, "infeasible")
    return Bound(rounded_down(best.value, problem.profit), best.method)


def _quick(network: Network, clock: Clock) -> list[Bound]:
    """The strongest relaxation that is solved in seconds."""
    from fiveroute.models.flow_relaxation import FlowRelaxation, relax
    from fiveroute.models.symmetric_relaxation import SymmetricRelaxation

    if clock.expired:
        return []
    if network.n <= _WITH_CLOCK:
        return [Bound(relax(network, clock).dual.value, "flow")]
    if network.n <= _WITH_DIRECTIONS:
        rough = FlowRelaxation(network, clock, timed=False)
        rough.solve(tail=_TAIL)
        return [Bound(rough.dual.value, "flow")]
    symmetric = SymmetricRelaxation(network, clock)
    symmetric.solve(tail=_LONG_TAIL)
    return [Bound(symmetric.bound, "symmetric")]


def _full(network: Network, clock: Clock) -> list[Bound]:
    """The strongest relaxation, to the end, where that is not done already."""
    from fiveroute.models.flow_relaxation import relax

    if network.n <= _WITH_CLOCK or clock.expired:
        return []
    return [Bound(relax(network, clock).dual.value, "flow")]


_WITH_CLOCK = 150  # nodes up to which the clock rows take less than a second
_WITH_DIRECTIONS = 500  # nodes up to which the directions do
_TAIL, _LONG_TAIL = 1e-4, 3e-3  # relative gains below which a quick relaxation stops
_SAFE = 1e-9  # share of a sum that its rounding errors stay far below
