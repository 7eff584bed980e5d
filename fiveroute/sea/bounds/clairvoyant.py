"""The clairvoyant plan: what a fleet could have collected that knew its luck.

After a run all leg times are known, those that nobody sailed as well. The best plan for
them is an ordinary team orienteering problem; the fleet search solves it, starting from what was
really done. The share of it that the fleet missed is the online optimality gap of the run. As the
search is a heuristic, the gap is a lower bound of the true one; at the size of the paper it
is within some tenths of a per cent.
"""

from __future__ import annotations

from fiveroute.heuristics.fleet_search import fleet_search
from fiveroute.heuristics.pick_up import trim
from fiveroute.heuristics.shortest_routes import shortest_routes
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan
from fiveroute.sea.luck import Luck
from fiveroute.sea.seeds import Purpose, generator

__all__ = ["clairvoyant_plan"]


def clairvoyant_plan(
    problem: TeamOrienteering, luck: Luck, done: Plan, trials: int = 20_000
) -> tuple[TeamOrienteering, Plan]:
    """The best plan found for the leg times of a run.

    Parameters
    ----------
    problem
        The problem with planned leg times.
    luck
        The luck of the run.
    done
        What the fleet did; what was late is trimmed until it is not.
    trials
        Number of trials of the search.

    Returns
    -------
    real
        The problem with the leg times that came.
    plan
        The plan, which keeps within all budgets.
    """
    real = TeamOrienteering(luck.matrix(), problem.service, problem.profit, problem.budgets)
    seen: set[int] = set()
    routes = []
    for auv, route in enumerate(done.routes):
        once = tuple(node for node in route if node not in seen)
        seen.update(once)
        routes.append(trim(real, auv, once))
    start = Plan(tuple(routes))
    is_legal = all(
        duration <= allowed
        for duration, allowed in zip(start.durations(real), real.allowed, strict=True)
    )
    rng = generator(Purpose.CLAIRVOYANT, luck.seed, luck.run)
    if not is_legal and shortest_routes(real) is None:
        return real, start  # not even the way home is in time
    warm = start if is_legal else None
    return real, fleet_search(real, rng=rng, warm_start=warm, iterations=trials)
