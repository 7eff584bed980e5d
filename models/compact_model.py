"""The compact model: constraints (3) to (8) of the paper, literally, in Pyomo.

With the paper's vertices N_1 (start), N_2 to N_(|N|-1) (sensor nodes), N_|N| (destination)
and AUVs A_1 to A_M; in the code, vertex N_i has the number i - 1.

    max   J = sum_m sum_k rho_k y_km                                                     (2)
    s.t.  sum_j x_1jm = sum_i x_i|N|m = 1                           for all m            (3)
          sum_m y_km <= 1                                           for all k            (4)
          sum_i x_ikm = sum_j x_kjm = y_km                          for all k, m         (5)
          sum_ij (t_ij + t_j) x_ijm <= T_max,m                      for all m            (6)
          2 <= u_im <= |N|                                          for all i >= 2, m    (7)
          u_im - u_jm + 1 <= (|N| - 1) (1 - x_ijm)                  for all i, j >= 2, m (8)
          x_ijm, y_km in {0, 1}; u_im, the position of N_i in route R_m, is continuous.

How it reads the paper where the text leaves something open:

- (3) is printed as a sum over all AUVs with M on the right. Then one AUV may sail two routes
  and another none, which with different budgets collects more than any fleet can. Every AUV
  gets its own row here; `Reading.aggregated_starts` gives the printed one.
- (7), (8) are printed for all vertices. With i = 1 the start takes position 2 at least, and
  a route through all |N| vertices needs the positions 2 to |N| + 1: forbidden. The start
  is left out here; `Reading.printed_positions` brings it back.
- Loops x_iim do not exist, the direct leg x_1|N|m does, and nothing is served at the ends.

For the solver's sake, without changing what is optimal: (2) is scaled so that the largest
rho_k counts 1000, which puts a solver's absolute tolerances far below what matters; (6) is
divided by the budget, the tolerance of the judge included; legs on no route within the
budget are left out (`fiveroute.models.reach`); equal AUVs are put in order
(`fiveroute.models.symmetry`). On request (8) is lifted by the leg back, which is
valid since positions may be consecutive (Desrochers and Laporte 1991):

    u_im - u_jm + 1 <= (|N| - 1) (1 - x_ijm) - (|N| - 3) x_jim                           (8')

References
----------
C. E. Miller, A. W. Tucker and R. A. Zemlin, "Integer programming formulation of traveling
salesman problems", Journal of the ACM 7 (1960), doi 10.1145/321043.321046.
M. Desrochers and G. Laporte, "Improvements and extensions to the Miller-Tucker-Zemlin subtour
elimination constraints", Operations Research Letters 10 (1991),
doi 10.1016/0167-6377(91)90083-2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pyomo.environ as pyo
from numpy.typing import NDArray

from fiveroute.models.reach import usable_legs
from fiveroute.models.symmetry import equal_pairs
from fiveroute.problem import TeamOrienteering

__all__ = ["Reading", "formulate"]

_LARGEST = 1000.0  # what the largest rho_k counts in the objective


@dataclass(frozen=True, slots=True)
class Reading:
    """How to read what the paper leaves open; see the head of this module.

    Parameters
    ----------
    aggregated_starts
        Whether (3) is the printed sum over the fleet. What such a model allows is no plan
        unless all budgets are equal.
    printed_positions
        Whether (7) and (8) hold for the start as well.
    """

    aggregated_starts: bool = False
    printed_positions: bool = False


def formulate(
    problem: TeamOrienteering,
    reading: Reading | None = None,
    *,
    usable: NDArray[np.bool_] | None = None,
    lifted: bool = False,
) -> pyo.ConcreteModel:
    """State the model.

    Parameters
    ----------
    problem
        The problem.
    reading
        How to read what is open; None for the reading that is right.
    usable
        Legs of every AUV, as of `usable_legs`, which None calls. Every AUV needs some.
    lifted
        Whether (8) is lifted to (8').

    Returns
    -------
    ConcreteModel
        Variables ``x[i, j, m]``, ``y[k, m]`` and ``u[i, m]``, the expression ``J``, its unit
        in the objective ``unit``, and constraints named after the paper's equations.
    """
    reading = reading or Reading()
    usable = usable_legs(problem) if usable is None else usable
    model = pyo.ConcreteModel()
    model.x = pyo.Var([(i, j, m) for m, i, j in np.argwhere(usable).tolist()], domain=pyo.Binary)
    into, out_of = _incidence(model.x)
    visits = [(k, m) for k, m in into if k != problem.destination]
    model.y = pyo.Var(sorted(visits), domain=pyo.Binary)
    _add_objective(model, problem)
    if reading.aggregated_starts:
        _add_printed_starts(model, problem, into, out_of)
    else:
        _add_starts(model, problem, into, out_of)
    _add_visits(model, into, out_of)
    _add_budgets(model, problem)
    _add_positions(model, problem, first=0 if reading.printed_positions else 1, lifted=lifted)
    _add_order(model, problem)
    return model


Incidence = dict[tuple[int, int], list[Any]]
"""Leg variables at every vertex for every AUV."""


def _incidence(x: pyo.Var) -> tuple[Incidence, Incidence]:
    """Legs into and out of every vertex, for every AUV that has any."""
    into: Incidence = {}
    out_of: Incidence = {}
    for (i, j, m), leg in x.items():
        into.setdefault((j, m), []).append(leg)
        out_of.setdefault((i, m), []).append(leg)
    return into, out_of


def _add_objective(model: pyo.ConcreteModel, problem: TeamOrienteering) -> None:
    profit = problem.profit.tolist()
    model.unit = max((profit[k] for k, _ in model.y), default=0.0) / _LARGEST or 1.0
    model.J = pyo.Expression(expr=sum(profit[k] * y for (k, _), y in model.y.items()))
    model.eq2 = pyo.Objective(expr=model.J / model.unit, sense=pyo.maximize)


def _add_starts(
    model: pyo.ConcreteModel, problem: TeamOrienteering, into: Incidence, out_of: Incidence
) -> None:
    fleet, end = range(problem.fleet_size), problem.destination
    model.eq3_start = pyo.Constraint(fleet, rule=lambda _, m: sum(out_of[0, m]) == 1)
    model.eq3_end = pyo.Constraint(fleet, rule=lambda _, m: sum(into[end, m]) == 1)


def _add_printed_starts(
    model: pyo.ConcreteModel, problem: TeamOrienteering, into: Incidence, out_of: Incidence
) -> None:
    size, end = problem.fleet_size, problem.destination
    starts = sum(x for m in range(size) for x in out_of.get((0, m), []))
    ends = sum(x for m in range(size) for x in into.get((end, m), []))
    model.eq3_start = pyo.Constraint(expr=starts == size)
    model.eq3_end = pyo.Constraint(expr=ends == size)


def _add_visits(model: pyo.ConcreteModel, into: Incidence, out_of: Incidence) -> None:
    visitors: dict[int, list[Any]] = {}
    for (k, _), y in model.y.items():
        visitors.setdefault(k, []).append(y)
    model.eq4 = pyo.Constraint(visitors, rule=lambda _, k: sum(visitors[k]) <= 1)
    each = model.y.index_set()
    model.eq5_in = pyo.Constraint(each, rule=lambda _, k, m: sum(into[k, m]) == model.y[k, m])
    model.eq5_out = pyo.Constraint(each, rule=lambda _, k, m: sum(out_of[k, m]) == model.y[k, m])


def _add_budgets(model: pyo.ConcreteModel, problem: TeamOrienteering) -> None:
    times = problem.travel + problem.service
    shares: dict[int, list[Any]] = {}
    for (i, j, m), x in model.x.items():
        shares.setdefault(m, []).append(float(times[i, j] / problem.allowed[m]) * x)
    model.eq6 = pyo.Constraint(shares, rule=lambda _, m: sum(shares[m]) <= 1.0)


def _add_positions(
    model: pyo.ConcreteModel, problem: TeamOrienteering, *, first: int, lifted: bool
) -> None:
    size = problem.n + 2
    legs = [(i, j, m) for i, j, m in model.x if i >= first]
    places = sorted({(v, m) for i, j, m in legs for v in (i, j)})
    model.u = pyo.Var(places, bounds=(2, size))  # (7)

    def follows(_: Any, i: int, j: int, m: int) -> Any:
        back = model.x[j, i, m] if lifted and (j, i, m) in model.x else 0
        return (
            model.u[i, m] - model.u[j, m] + 1
            <= (size - 1) * (1 - model.x[i, j, m]) - (size - 3) * back
        )

    model.eq8 = pyo.Constraint(legs, rule=follows)


def _add_order(model: pyo.ConcreteModel, problem: TeamOrienteering) -> None:
    def smaller_first(_: Any, k: int, a: int, b: int) -> Any:
        return model.y[k, b] <= sum(y for (j, m), y in model.y.items() if m == a and j < k)

    pairs = [(k, a, b) for a, b in equal_pairs(problem) for k, m in model.y if m == b]
    model.order = pyo.Constraint(pairs, rule=smaller_first)
