"""The compact model, solved by HiGHS.

The mathematics are in `fiveroute.models.compact_model`. Strengthening, the default, adds what
integers fulfil anyway and what closes the gap of the linear relaxation: (8) is lifted, and
rows of connectivity enter while the relaxation violates them
(`fiveroute.models.max_flow_cuts`), for every AUV m:

    sum of x_ijm into S >= y_km    for k in S, start not in S.

A violated set brings the rows of all its nodes and all AUVs: what one AUV violates
here, another violates at the next node of the search tree.

HiGHS tolerates an excess of 1e-6 in (6), the judge a thousandth of that. A route that he
rejects is cut off, leg sequence by leg sequence, and the model is solved again.

Progress comes from the callbacks of HiGHS. Its bound is widened by its own tolerances.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.compact_model import formulate
from fiveroute.models.highs import Outcome
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.legs import legs_of, route_along
from fiveroute.models.max_flow_cuts import violated_sets
from fiveroute.models.pyomo_program import translate
from fiveroute.models.reach import usable_legs
from fiveroute.models.symmetry import in_order
from fiveroute.models.unreduced import UNREDUCED
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["solve", "supports"]

_MARGIN = 1e-5  # of the objective's unit: what the absolute tolerances of HiGHS may hide
_ROUNDS = 50  # of cutting before the integer search


def supports(problem: TeamOrienteering) -> bool:
    """Every problem is supported."""
    return True


def solve(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Plan | None = None,
    progress: ProgressCallback | None = None,
    strengthened: bool = True,
) -> Result:
    """Best plan, or the best plan and bound that the limits allow.

    Parameters
    ----------
    problem
        The problem.
    limits
        When to stop.
    warm_start
        A plan to start from.
    progress
        Told of every better plan and bound.
    strengthened
        Whether to help the solver; without, it gets (3) to (8) alone.
    """
    answer = Incumbent(problem, "compact", limits, warm_start=warm_start, progress=progress)
    usable = usable_legs(problem)
    if not usable.any(axis=(1, 2)).all():
        return answer.infeasible()
    answer.lower(float(problem.profit[usable.any(axis=(0, 1))].sum()))
    if answer.must_stop:
        return answer.result()
    search = _Search(answer, usable, strengthened)
    if strengthened and search.tighten() is Outcome.INFEASIBLE:
        return answer.infeasible()
    while not answer.must_stop:
        if search.run() is Outcome.INFEASIBLE:
            return answer.infeasible()
        if not search.rejected:
            break
        search.forbid_rejected()
    return answer.result()


class _Search:
    """The model in HiGHS, and what it finds."""

    def __init__(self, answer: Incumbent, usable: NDArray[np.bool_], strengthened: bool) -> None:
        model = formulate(answer.problem, usable=usable, lifted=strengthened)
        self._answer, self._problem, self._unit = answer, answer.problem, model.unit
        self._fleet = range(answer.problem.fleet_size)
        self.rejected: set[Route] = set()
        self._program, columns = translate(model, answer.clock, self._on_progress)
        self._program.set("mip_rel_gap", answer.clock.limits.gap)
        for option, value in UNREDUCED.items():
            self._program.set(option, value)
        self._program.highs.cbMipImprovingSolution += self._on_solution
        self._legs = {leg: columns[x] for leg, x in model.x.items()}
        self._visits = {visit: columns[y] for visit, y in model.y.items()}
        self._places = {place: columns[u] for place, u in model.u.items()}

    def tighten(self) -> Outcome:
        """Add rows of connectivity while the linear relaxation violates some."""
        for _ in range(_ROUNDS):
            outcome = self._program.solve()
            if outcome is not Outcome.OPTIMAL:
                return outcome
            self._lower(self._program.objective)
            if self._answer.must_stop or not self._add_connectivity(self._program.values):
                break
        return Outcome.OPTIMAL

    def run(self) -> Outcome:
        """Solve for integers, from the best plan known."""
        self.rejected.clear()
        self._program.require_integers(True)
        if self._answer.plan is not None:
            self._program.start_from(self._point(in_order(self._problem, self._answer.plan)))
        outcome = self._program.solve()
        if outcome is not Outcome.INFEASIBLE:
            self._lower(self._program.bound)
        if outcome is Outcome.OPTIMAL:  # stopped, HiGHS may still hold the relaxation's point
            self._judge(self._program.values)
        return outcome

    def forbid_rejected(self) -> None:
        """Cut off the routes that the judge rejected, for every AUV that they are too long for."""
        for route in self.rejected:
            legs = legs_of(route, self._problem.destination)
            duration = self._problem.duration(route)
            for m, allowed in enumerate(self._problem.allowed):
                if duration > allowed and all((i, j, m) in self._legs for i, j in legs):
                    columns = [self._legs[i, j, m] for i, j in legs]
                    self._add_row(dict.fromkeys(columns, 1.0), -np.inf, len(legs) - 1.0)

    def _add_connectivity(self, values: NDArray[np.float64]) -> bool:
        """Add the rows of all sets that some AUV violates; return whether there are any."""
        sets = np.concatenate([self._violated(m, values) for m in self._fleet])
        for inside in np.unique(sets, axis=0):
            for m in self._fleet:
                self._add_entry(m, inside)
        return len(sets) > 0

    def _violated(self, m: int, values: NDArray[np.float64]) -> NDArray[np.bool_]:
        legs = [(i, j) for i, j, auv in self._legs if auv == m]
        tails, heads = np.array(legs, dtype=np.int64).T
        demand = np.zeros(self._problem.n + 2)
        for (k, auv), column in self._visits.items():
            if auv == m:
                demand[k] = values[column]
        return violated_sets(tails, heads, values[[self._legs[i, j, m] for i, j in legs]], demand)

    def _add_entry(self, m: int, inside: NDArray[np.bool_]) -> None:
        """AUV m comes into the set if it visits any node there; one row a node."""
        entering = {
            column: 1.0
            for (i, j, auv), column in self._legs.items()
            if auv == m and inside[j] and not inside[i]
        }
        for k in np.flatnonzero(inside).tolist():
            if (k, m) in self._visits:
                self._add_row(entering | {self._visits[k, m]: -1.0}, 0.0, np.inf)

    def _add_row(self, row: dict[int, float], lower: float, upper: float) -> None:
        width = self._program.highs.getNumCol()
        entries = (list(row.values()), (np.zeros(len(row), dtype=np.int64), list(row)))
        self._program.add_rows(csr_array(entries, shape=(1, width)), lower, upper)

    def _point(self, plan: Plan) -> NDArray[np.float64]:
        """A plan in order, as a value a column."""
        point = np.zeros(self._program.highs.getNumCol())
        point[list(self._places.values())] = 2.0
        for m, route in enumerate(plan.routes):
            for place, (i, j) in enumerate(legs_of(route, self._problem.destination), start=2):
                point[self._legs[i, j, m]] = 1.0
                if (j, m) in self._places:
                    point[self._places[j, m]] = place
            point[[self._visits[k, m] for k in route]] = 1.0
        return point

    def _judge(self, values: NDArray[np.float64]) -> None:
        """Offer the plan of an integer point, and keep the routes that are too long."""
        chosen: list[list[tuple[int, int]]] = [[] for _ in range(self._problem.fleet_size)]
        for (i, j, m), column in self._legs.items():
            if values[column] > 0.5:
                chosen[m].append((i, j))
        plan = Plan(tuple(route_along(legs, self._problem.destination) for legs in chosen))
        if not self._answer.offer(plan):
            self.rejected.update(
                route
                for route, duration, allowed in zip(
                    plan.routes, plan.durations(self._problem), self._problem.allowed, strict=True
                )
                if duration > allowed
            )

    def _on_solution(self, event: Any) -> None:
        self._judge(np.array(event.data_out.mip_solution))

    def _on_progress(self, _objective: float | None, bound: float | None) -> None:
        if bound is not None:
            self._lower(bound)

    def _lower(self, bound: float) -> None:
        self._answer.lower(self._unit * (bound + _MARGIN))
