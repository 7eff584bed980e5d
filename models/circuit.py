"""CP-SAT circuits: one circuit through start and destination for every AUV.

In the paper's numbering, for every AUV m:

    max   sum_m sum_k rho_k y_km                                                     (2)
    s.t.  circuit over the arcs x_ijm, the arc |N| -> 1, and a loop at every node
          k that m does not visit, which is chosen exactly when y_km = 0     (3), (5), (7), (8)
          sum_m y_km <= 1                                                            (4)
          sum_ij (t_ij + s_j) x_ijm <= T_max,m                                       (6)

The circuit constraint says all at once that a route starts, ends, is connected and has no
sub-tours. Legs on no route within the budget are left out (`fiveroute.models.reach`), equal
AUVs are put in order (`fiveroute.models.symmetry`).

CP-SAT knows integers alone. Times are rounded down, budgets and data up, so the integer
problem is a relaxation and its bound a bound of the real problem. The judge decides about
every plan found; a route that only rounding let through is forbidden, leg sequence by leg
sequence, and the model is solved again.

One worker with the whole linear relaxation is the default. It proves problems of 15 and 20
nodes several times quicker than the mixed portfolio of two workers, and repeats itself.

References
----------
L. Perron, F. Didier and S. Gay, "The CP-SAT-LP solver", 29th International Conference on
Principles and Practice of Constraint Programming, LIPIcs 280 (2023),
doi 10.4230/LIPIcs.CP.2023.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from ortools.sat.python import cp_model

from fiveroute.limits import Limits, ProgressCallback
from fiveroute.models.incumbent import Incumbent
from fiveroute.models.integers import ROUNDING, round_down, round_up, units_per_one
from fiveroute.models.interrupt import on_interrupt
from fiveroute.models.legs import Leg, legs_of, route_along
from fiveroute.models.reach import usable_legs
from fiveroute.models.symmetry import equal_pairs, in_order
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Result
from fiveroute.routes import Plan, Route

__all__ = ["solve", "supports"]

_TIME_UNITS = 1e9  # units in a budget
_DATA_UNITS = 1e12  # units in all data that can be reached

_SAFE = 1.0 + 1e-12  # covers the rounding errors of a sum of times


def supports(problem: TeamOrienteering) -> bool:
    """Every problem is supported."""
    return True


def solve(
    problem: TeamOrienteering,
    limits: Limits | None = None,
    *,
    warm_start: Plan | None = None,
    progress: ProgressCallback | None = None,
    workers: int = 1,
    seed: int = 1,
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
    workers
        Threads of CP-SAT. With more than one, which of several best plans comes out is
        left to chance.
    seed
        Seed of CP-SAT.
    """
    answer = Incumbent(problem, "circuit", limits, warm_start=warm_start, progress=progress)
    usable = usable_legs(problem)
    if not usable.any(axis=(1, 2)).all():
        return answer.infeasible()
    answer.lower(float(problem.profit[usable.any(axis=(0, 1))].sum()))
    if answer.must_stop:
        return answer.result()
    circuits = _Circuits.of(problem, usable)
    if answer.plan is not None:
        circuits.hint(in_order(problem, answer.plan))
    while True:
        search = _Search(circuits, answer)
        if search.run(workers, seed) == cp_model.INFEASIBLE:
            return answer.infeasible()
        if answer.must_stop or not search.rejected:
            return answer.result()
        for route in search.rejected:
            circuits.forbid(route)


@dataclass(frozen=True, slots=True, eq=False)
class _Circuits:
    """The model.

    Parameters
    ----------
    problem
        The problem.
    cp
        The model of CP-SAT.
    legs
        x_ijm by (i, j), for every AUV.
    visits
        y_km by (k, m).
    units
        Integer units per unit of data.
    """

    problem: TeamOrienteering
    cp: cp_model.CpModel
    legs: list[dict[Leg, cp_model.IntVar]]
    visits: dict[tuple[int, int], cp_model.IntVar]
    units: float

    @classmethod
    def of(cls, problem: TeamOrienteering, usable: NDArray[np.bool_]) -> _Circuits:
        reachable = np.where(usable.any(axis=(0, 1)), problem.profit, 0.0)
        units = units_per_one(reachable, float(reachable.sum()) or 1.0, _DATA_UNITS)
        self = cls(problem, cp_model.CpModel(), [], {}, units)
        for m in range(problem.fleet_size):
            self._add_circuit(m, usable[m])
        self._add_visits()
        self._add_order()
        data = round_up(units * reachable)
        self.cp.maximize(  # (2)
            cp_model.LinearExpr.weighted_sum(
                list(self.visits.values()), [int(data[k]) for k, _ in self.visits]
            )
        )
        return self

    def _add_circuit(self, m: int, usable: NDArray[np.bool_]) -> None:
        legs = {
            (int(i), int(j)): self.cp.new_bool_var(f"x_{i}_{j}_{m}") for i, j in np.argwhere(usable)
        }
        nodes = sorted({j for _, j in legs} - {self.problem.destination})
        visited = {k: self.cp.new_bool_var(f"y_{k}_{m}") for k in nodes}
        arcs = [(i, j, chosen) for (i, j), chosen in legs.items()]
        loops = [(k, k, ~visit) for k, visit in visited.items()]
        back = (self.problem.destination, 0, True)
        self.cp.add_circuit([*arcs, *loops, back])  # (3), (5), (7), (8)
        self._add_budget(m, legs)
        self.legs.append(legs)
        self.visits.update({(k, m): visit for k, visit in visited.items()})

    def _add_budget(self, m: int, legs: dict[Leg, cp_model.IntVar]) -> None:
        """Add (6), rounded to the safe side: a route has at most n + 1 legs."""
        tails, heads = np.array(list(legs), dtype=np.int64).T
        times = self.problem.travel[tails, heads] + self.problem.service[heads]
        allowed = float(self.problem.allowed[m])
        units = units_per_one(times, allowed, _TIME_UNITS)
        capacity = math.floor(units * allowed * _SAFE + (self.problem.n + 1) * ROUNDING)
        weights = round_down(units * times).tolist()
        self.cp.add(cp_model.LinearExpr.weighted_sum(list(legs.values()), weights) <= capacity)

    def _add_visits(self) -> None:
        for k in range(1, self.problem.n + 1):
            self.cp.add_at_most_one(visit for (node, _), visit in self.visits.items() if node == k)

    def _add_order(self) -> None:
        for a, b in equal_pairs(self.problem):
            smaller: list[cp_model.IntVar] = []
            for k in range(1, self.problem.n + 1):
                if (k, b) in self.visits:
                    self.cp.add_bool_or([~self.visits[k, b], *smaller])
                    smaller.append(self.visits[k, a])

    def hint(self, plan: Plan) -> None:
        """Start the next search from a plan in order."""
        for m, route in enumerate(plan.routes):
            taken = set(legs_of(route, self.problem.destination))
            for leg, chosen in self.legs[m].items():
                self.cp.add_hint(chosen, leg in taken)
        for (k, m), visit in self.visits.items():
            self.cp.add_hint(visit, k in plan.routes[m])

    def forbid(self, route: Route) -> None:
        """Cut a route off for every AUV whose budget it exceeds."""
        legs = legs_of(route, self.problem.destination)
        duration = self.problem.duration(route)
        for m, allowed in enumerate(self.problem.allowed):
            if duration > allowed and all(leg in self.legs[m] for leg in legs):
                self.cp.add_bool_or([~self.legs[m][leg] for leg in legs])

    def bound(self, units: float) -> float:
        """Bound on the data from a bound on its integer units."""
        return (units + self.problem.n * ROUNDING) / self.units


class _Search(cp_model.CpSolverSolutionCallback):
    """One run of CP-SAT, which offers its plans and bounds as they come."""

    def __init__(self, circuits: _Circuits, answer: Incumbent) -> None:
        super().__init__()
        self._circuits, self._answer = circuits, answer
        self.rejected: set[Route] = set()

    def run(self, workers: int, seed: int) -> int:
        """Search to the end or the limits; return the status of CP-SAT."""
        clock = self._answer.clock
        solver = cp_model.CpSolver()
        solver.parameters.num_workers = workers
        solver.parameters.random_seed = seed
        solver.parameters.linearization_level = 2
        solver.parameters.catch_sigint_signal = False
        solver.parameters.relative_gap_limit = clock.limits.gap
        solver.parameters.max_time_in_seconds = clock.left
        solver.best_bound_callback = self._lower
        with on_interrupt(clock.limits.interrupt, solver.stop_search):
            status = solver.solve(self._circuits.cp, self)
        if status == cp_model.MODEL_INVALID:
            raise AssertionError(f"CP-SAT refuses the model: {self._circuits.cp.validate()}")
        if status == cp_model.OPTIMAL:  # stopped before presolve, CP-SAT calls 0 a bound
            self._lower(solver.best_objective_bound)
        return int(status)

    def on_solution_callback(self) -> None:
        """Judge a plan."""
        problem = self._circuits.problem
        chosen = [
            [leg for leg, variable in legs.items() if self.boolean_value(variable)]
            for legs in self._circuits.legs
        ]
        plan = Plan(tuple(route_along(legs, problem.destination) for legs in chosen))
        if not self._answer.offer(plan):
            self.rejected.update(
                route
                for m, route in enumerate(plan.routes)
                if problem.duration(route) > problem.allowed[m]
            )

    def _lower(self, units: float) -> None:
        self._answer.lower(self._circuits.bound(units))
