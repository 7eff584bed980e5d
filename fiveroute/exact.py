"""Exact methods with a head start: a good plan first, then the proof.

The exact methods know nothing of the heuristics, so that proofs do not depend on them. A good plan
helps all of them, though: what cannot be better than it need not be looked at. Column generation
starts from all routes that the search came across.
"""

from __future__ import annotations

import numpy as np

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models import solve
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["solve_from_good_plan"]

_FEW = 12
"""Nodes up to which the proof takes less time than a search."""

_SHARE = 0.2
"""Share of a time limit that the search may take."""


def solve_from_good_plan(
    problem: TeamOrienteering,
    method: str = "auto",
    limits: Limits | None = None,
    *,
    seed: int = 0,
    progress: ProgressCallback | None = None,
) -> Result:
    """Solve a problem exactly, starting from a plan of the fleet search.

    Parameters
    ----------
    problem
        The problem.
    method
        A name in `fiveroute.models.METHODS`, or ``auto``.
    limits
        When to stop; None without any limit.
    seed
        Seed of the search.
    progress
        Told of better plans and bounds.
    """
    clock = (limits or Limits()).start()
    routes: list[Route] = []
    start = _good_plan(problem, clock.rest(), seed, routes) if problem.n > _FEW else None
    return solve(problem, method, clock.rest(), warm_start=start, routes=routes, progress=progress)


def _good_plan(
    problem: TeamOrienteering, limits: Limits, seed: int, routes: list[Route]
) -> Plan | None:
    """A plan of the fleet search, None where it finds none to start from; `routes` takes others."""
    from fiveroute.heuristics.fleet_search import default_trials, fleet_search
    from fiveroute.models.bounds import Effort, quick_bound

    try:
        return fleet_search(
            problem,
            limits.within(_SHARE * limits.time),
            rng=np.random.default_rng(seed),
            iterations=default_trials(problem.n),
            enough=quick_bound(problem, limits, effort=Effort.LEAST).value,
            remember=routes.extend,
        )
    except ValueError:
        return None
