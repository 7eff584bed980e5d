"""A Pyomo model as a HiGHS programme.

Pyomo states the mathematics; its standard-form compiler turns them into a matrix, and
`fiveroute.models.highs` solves that. Pyomo's own two interfaces to HiGHS are not used: both
redirect the output of the whole process while they solve and answer Ctrl-C with an exit
of their own, neither has callbacks for limits and progress, and the newer one takes no
warm start.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pyomo.environ as pyo
from pyomo.common.collections import ComponentMap
from pyomo.repn.plugins.standard_form import LinearStandardFormCompiler

from fiveroute.limits import Clock
from fiveroute.models.highs import Program

__all__ = ["translate"]


def translate(
    model: pyo.ConcreteModel,
    clock: Clock,
    on_progress: Callable[[float | None, float | None], None] | None = None,
) -> tuple[Program, ComponentMap[Any, int]]:
    """Pass a linear model with a maximised objective to HiGHS.

    Parameters
    ----------
    model
        The model; its integer variables count as continuous until
        `Program.require_integers`.
    clock, on_progress
        As for `Program`.

    Returns
    -------
    program : Program
        The programme.
    columns : ComponentMap
        Column of every variable that occurs in the model.
    """
    form = LinearStandardFormCompiler().write(model, mixed_form=True, set_sense=pyo.maximize)
    integer = np.array([variable.is_integer() for variable in form.columns], dtype=np.bool_)
    order = np.argsort(~integer, kind="stable")
    variables = [form.columns[c] for c in order]
    program = Program(clock, maximise=True, on_progress=on_progress)
    cost = form.c.toarray().ravel()[order]
    lower, upper = np.array([variable.bounds for variable in variables], dtype=np.float64).T
    for part in (slice(0, integer.sum()), slice(integer.sum(), None)):
        program.add_columns(cost[part], lower[part], upper[part], integer=part.start == 0)
    sense = np.array([row.bound_type for row in form.rows])
    program.add_rows(
        form.A.tocsc()[:, order].tocsr(),
        np.where(sense <= 0, form.rhs, -np.inf),
        np.where(sense >= 0, form.rhs, np.inf),
    )
    return program, ComponentMap((variable, c) for c, variable in enumerate(variables))
