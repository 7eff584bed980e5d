r"""Two-index time-flow model of team orienteering: it knows arcs and times, but no AUVs.

With x_ij = 1 if some AUV sails the leg from i to j, and z_ij its time of arrival at j on that leg,
the paper's problem (2) to (8) reads

    max  sum_j rho_j y_j                                                       (2)  objective
    s.t. sum_j x_0j = M, and M_c arcs end in the destination of class c        (3)  fleet, class
         sum_i x_ij = y_j <= 1                                                 (4)  degree
         sum_i x_ij = sum_k x_jk                                               (5)  balance
         sum_i z_ij + sum_k (t_jk + s_j) x_jk = sum_k z_jk                     (6)  clock
         a_ij x_ij <= z_ij <= b_ij x_ij                                        (6)  window
         sum of x_ij into S >= y_k for k in S, start not in S                  (7)-(8)  sets
         x, y integer

for sensor nodes j. The clock takes the place of an index for the AUV: what arrives at j at some
time leaves it after the service, and reaches the destination within the budget. Different budgets
need no more than one copy of the destination for every distinct budget (classes c of M_c equal
AUVs), see `fiveroute.models.network`. The clock forbids cycles apart from the start unless they
take no time at all; the sets forbid those too, and they tighten the relaxation.

The root is solved as a linear programme with all arcs and violated sets
(`fiveroute.models.flow_relaxation`). Its multipliers bound, by weak duality, what a plan with a
given arc can collect. HiGHS looks for a good plan among the few arcs with the highest
bounds, and then for a proof among all arcs whose bounds exceed it. Plans that the judge rejects,
since HiGHS works to a coarser tolerance, are cut off, and the model is solved again.

Large problems get a quick bound and a greedy plan first, because their root may outlast any
limit, and the programme no more arcs than memory holds: those with the highest bounds, the
best of the others being what a plan outside the programme may collect.

References
----------
N. Bianchessi, R. Mansini and M. G. Speranza, "A branch-and-cut algorithm for the Team
Orienteering Problem", International Transactions in Operational Research 25 (2018),
doi 10.1111/itor.12422.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.bounds import quick_bound
from fiveroute.models.common_divisor import common_divisor
from fiveroute.models.flow_program import FlowProgram, Routes, arcs_of
from fiveroute.models.flow_relaxation import FlowRelaxation, relax
from fiveroute.models.greedy_plan import offer_greedy_plan
from fiveroute.models.highs import Outcome
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.network import Network
from fiveroute.models.weak_duality import if_idle, if_used
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["solve", "supports"]

Booleans = NDArray[np.bool_]
Floats = NDArray[np.float64]

_CORE_ARCS = 4  # arcs a node among which a good plan is looked for first
_CORE_TREE = 200  # branch-and-bound nodes that this may take
_MOST_ARCS = 100_000  # arcs that the programme may have
_LARGE = 150  # nodes above which a quick bound and a greedy plan come first
_TOO_LARGE = 2000  # nodes above which they are all
_SHORT = 0.999  # share of the data's grid that any better plan surely gains
_UNVISITED = 0.1  # weight in the first plan of a node that the relaxation does not visit


def supports(problem: TeamOrienteering) -> bool:
    """Any problem: times, budgets and data may be what they like."""
    return True


def solve(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Plan | None = None,
    progress: ProgressCallback | None = None,
) -> Result:
    """Solve to optimality, or as far as the limits allow.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop; None without any limit.
    warm_start
        A plan to start from; one that the judge rejects is left aside.
    progress
        Told of better plans and bounds.
    """
    incumbent = Incumbent(problem, "flow", limits, warm_start=warm_start, progress=progress)
    network = Network.of(problem)
    if network.has_no_route:
        return incumbent.infeasible()
    if incumbent.must_stop:
        return incumbent.result()
    if network.n > _LARGE:
        bound = quick_bound(problem, incumbent.clock.rest())
        if bound.method == "infeasible":
            return incumbent.infeasible()
        incumbent.lower(bound.value)
        offer_greedy_plan(incumbent, problem.profit)
    if network.n > _TOO_LARGE or incumbent.must_stop:
        return incumbent.result()
    root = relax(network, incumbent.clock)
    if root.dual.value < 0.0:
        return incumbent.infeasible()
    incumbent.lower(root.dual.value)
    visits = np.append(root.visits[: network.n + 1], 0.0)
    offer_greedy_plan(incumbent, problem.profit * (_UNVISITED + visits))
    if incumbent.must_stop:
        return incumbent.result()
    if _search(root, incumbent) is Outcome.INFEASIBLE and incumbent.plan is None:
        return incumbent.infeasible()
    return incumbent.result()


def _search(root: FlowRelaxation, incumbent: Incumbent) -> Outcome:
    """Look for a good plan among a few promising arcs, then for a proof among all of use.

    The outcome is that of the whole problem: stopped where the programme lacks arcs of use.
    """
    network, step = root.network, common_divisor(incumbent.problem.profit) or 0.0
    bounds = if_used(network, root.multipliers, root.dual)
    arcs, others = _best_arcs(network, bounds, _CORE_ARCS * network.n)
    if others > max(incumbent.objective, 0.0):
        program = _program(root, incumbent, arcs, others)
        program.stop_after(_CORE_TREE)
        _branch(program, incumbent, others)
    if incumbent.must_stop:
        return Outcome.STOPPED
    least = max(incumbent.objective + _SHORT * step, 0.0)
    arcs, others = _best_arcs(network, bounds, _MOST_ARCS)
    if others < least:
        arcs, others = bounds >= least, -np.inf
    outcome = _branch(_program(root, incumbent, arcs, others), incumbent, others)
    return outcome if others == -np.inf else Outcome.STOPPED


def _best_arcs(network: Network, bounds: Floats, count: int) -> tuple[Booleans, float]:
    """The arcs with the highest bounds, short legs first among equals.

    Returns
    -------
    arcs : Booleans
        Shape (n + 1, size).
    others : float
        The highest bound of any other arc.
    """
    if count >= bounds.size:
        return np.isfinite(bounds), -np.inf
    legs = network.legs(np.arange(network.n + 1)[:, None], np.arange(network.size))
    order = np.lexsort((legs.ravel(), -bounds.ravel()))
    arcs = np.zeros(bounds.size, dtype=np.bool_)
    arcs[order[:count]] = True
    return arcs.reshape(bounds.shape) & np.isfinite(bounds), float(bounds.flat[order[count]])


def _program(
    root: FlowRelaxation, incumbent: Incumbent, arcs: Booleans, others: float
) -> FlowProgram:
    """The model over some arcs and those of the best plan, with the sets of use.

    No plan with other arcs collects more than `others`, or than the best plan.
    """
    network = root.network
    if incumbent.plan is not None:
        arcs = arcs | arcs_of(network, incumbent.plan)
    program = FlowProgram(
        network,
        arcs,
        if_idle(network, root.dual) < incumbent.objective,
        incumbent.clock,
        on_bound=lambda bound: incumbent.lower(max(bound, others, incumbent.objective)),
        on_routes=lambda found: _offer(found, network, incumbent),
    )
    program.add_sets(root.multipliers.sets, root.multipliers.served)
    return program


def _branch(program: FlowProgram, incumbent: Incumbent, others: float) -> Outcome:
    """Solve again and again until the judge accepts the optimum; return how it ended.

    `others` bounds the plans that the program does not know.
    """
    while True:
        if incumbent.plan is not None:
            program.start_from(incumbent.plan)
        outcome = program.solve(incumbent.clock.limits.gap)
        bound = -np.inf if outcome is Outcome.INFEASIBLE else program.bound
        found = program.routes() or Routes([], [])
        late = _offer(found, program.network, incumbent) if found.routes else []
        incumbent.lower(max(bound, others, incumbent.objective))
        for auv_class, route in late:
            program.forbid(auv_class, route)
        for cycle in found.cycles:
            program.forbid_cycle(cycle)
        accepted = not late and not found.cycles
        if accepted or outcome is not Outcome.OPTIMAL or incumbent.must_stop:
            return outcome


def _offer(found: Routes, network: Network, incumbent: Incumbent) -> list[tuple[int, Route]]:
    """Offer the routes that are in time as a plan; return the others with their classes."""
    problem = incumbent.problem
    waiting = [list(auvs) for auvs in network.members]
    plan: list[Route] = [()] * problem.fleet_size
    late = []
    for auv_class, route in found.routes:
        auv = waiting[auv_class].pop()
        if problem.duration(route) <= problem.allowed[auv]:
            plan[auv] = route
        else:
            late.append((auv_class, route))
    incumbent.offer(Plan.of(plan))
    return late
