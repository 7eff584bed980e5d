"""HiGHS beside OR-Tools in one process, and a small frame around one HiGHS model.

Both packages bring a shared library of the same name, libhighs.so.1, in different versions. The
Linux loader keeps one library a name, so whichever package comes second gets the other's copy
and fails to import. A copy made global by its full path is searched before that one: `_load`
makes the second package's own copy global just before it is imported. Nothing else in fiveroute
imports highspy; who needs it (or lets Pyomo load it) writes

    from fiveroute.models.highs import highspy

The frame, `Program`, is a linear or mixed-integer programme solved quietly on one thread, again
and again while rows come in, until its clock expires or somebody interrupts.

References
----------
Q. Huangfu and J. A. J. Hall, "Parallelizing the dual revised simplex method", Mathematical
Programming Computation 10 (2018), doi 10.1007/s12532-017-0130-5.
"""

from __future__ import annotations

import ctypes
import importlib
import math
import os
import sys
from collections.abc import Callable
from enum import StrEnum
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.limits import Clock

if TYPE_CHECKING:
    from scipy.sparse import csc_array, csr_array

__all__ = ["Outcome", "Program", "highspy"]


def _load() -> Any:
    """Import both packages, each with its own copy of the library; return highspy."""
    first, second = "ortools.sat.python.cp_model_helper", "highspy"
    if "highspy" in sys.modules:  # somebody else came first
        first, second = second, first
    importlib.import_module(first)
    if second not in sys.modules:
        package = find_spec(second.partition(".")[0])
        for folder in (package.submodule_search_locations or ()) if package else ():
            for copy in sorted(Path(folder).glob("**/libhighs.so*")):
                ctypes.CDLL(str(copy), mode=ctypes.RTLD_GLOBAL | getattr(os, "RTLD_NOW", 0))
        importlib.import_module(second)
    return sys.modules["highspy"]


highspy = _load()

Values = NDArray[np.float64]


class Outcome(StrEnum):
    """How one solve ended."""

    OPTIMAL = "optimal"
    INFEASIBLE = "infeasible"
    UNBOUNDED = "unbounded"
    STOPPED = "stopped"
    """A limit, an interrupt or numerical trouble: nothing is proved but `Program.bound`."""


class Program:
    """A programme opt c x, row_lower <= A x <= row_upper, lower <= x <= upper, in HiGHS.

    Parameters
    ----------
    clock
        When to stop; looked at by every solve.
    maximise
        Sense of the objective.
    on_progress
        Told the incumbent's objective and the bound while an integer solve runs; None for
        what is not known yet.
    on_solution
        Told every better integer point while it runs, a value a column.

    Attributes
    ----------
    has_solution
        Whether the last solve left a feasible point.
    objective
        Objective of that point.
    bound
        What bounds the objective of the last integer solve, as HiGHS believes.
    """

    def __init__(
        self,
        clock: Clock,
        *,
        maximise: bool = False,
        on_progress: Callable[[float | None, float | None], None] | None = None,
        on_solution: Callable[[Values], None] | None = None,
    ) -> None:
        self._clock = clock
        self._on_progress, self._on_solution = on_progress, on_solution
        self._reported = -math.inf
        self._integers: list[NDArray[np.int32]] = []
        self.has_solution = False
        self.objective = math.nan
        self.bound = math.nan
        self.highs = highspy.Highs()
        self.set("output_flag", False)
        self.set("threads", 1)
        if maximise:
            self.highs.changeObjectiveSense(highspy.ObjSense.kMaximize)
        self.highs.cbSimplexInterrupt += self._watch
        self.highs.cbIpmInterrupt += self._watch
        self.highs.cbMipInterrupt += self._watch
        if on_solution is not None:
            self.highs.cbMipImprovingSolution += self._improve

    def set(self, option: str, value: bool | int | float | str) -> None:
        """Set an option of HiGHS by its own name."""
        if self.highs.setOptionValue(option, value) != highspy.HighsStatus.kOk:
            raise ValueError(f"HiGHS refuses {option} = {value!r}")

    def add_columns(
        self,
        cost: ArrayLike,
        lower: ArrayLike,
        upper: ArrayLike,
        matrix: csc_array | None = None,
        *,
        integer: bool = False,
    ) -> slice:
        """Append columns; return their places.

        Parameters
        ----------
        cost, lower, upper
            A value a column, or one for all.
        matrix
            Coefficients in the rows that exist already, shape (rows, columns); None for zeros.
        integer
            Whether `require_integers` shall concern them; until then they are continuous.
        """
        first = self.highs.getNumCol()
        cost, lower, upper = (
            np.array(v, dtype=np.float64) for v in np.broadcast_arrays(cost, lower, upper)
        )
        starts, rows, entries = np.zeros(len(cost), np.int32), np.zeros(0, np.int32), np.zeros(0)
        if matrix is not None:
            starts, rows = matrix.indptr[:-1].astype(np.int32), matrix.indices.astype(np.int32)
            entries = matrix.data.astype(np.float64)
        self.highs.addCols(len(cost), cost, lower, upper, len(entries), starts, rows, entries)
        columns = slice(first, first + len(cost))
        if integer:
            self._integers.append(np.arange(columns.start, columns.stop, dtype=np.int32))
        return columns

    def add_rows(self, matrix: csr_array, lower: ArrayLike, upper: ArrayLike) -> slice:
        """Append rows over all columns; return their places."""
        first, count = self.highs.getNumRow(), matrix.shape[0]
        lower, upper = (
            np.array(np.broadcast_to(np.asarray(bound, dtype=np.float64), (count,)))
            for bound in (lower, upper)
        )
        self.highs.addRows(
            count,
            lower,
            upper,
            matrix.nnz,
            matrix.indptr[:-1].astype(np.int32),
            matrix.indices.astype(np.int32),
            matrix.data.astype(np.float64),
        )
        return slice(first, first + count)

    def delete_rows(self, rows: ArrayLike) -> None:
        """Remove rows; the later ones move up."""
        places = np.array(rows, dtype=np.int32)
        self.highs.deleteRows(len(places), places)

    def require_integers(self, required: bool) -> None:
        """Demand integrality of the columns that were added as integers, or relax it."""
        kind = highspy.HighsVarType.kInteger if required else highspy.HighsVarType.kContinuous
        for columns in self._integers:
            kinds = np.full(len(columns), int(kind), dtype=np.uint8)
            self.highs.changeColsIntegrality(len(columns), columns, kinds)

    def start_from(self, values: ArrayLike) -> None:
        """Hand over a solution, one value a column, to start the next integer solve from."""
        point = np.array(values, dtype=np.float64)
        self.highs.setSolution(len(point), np.arange(len(point), dtype=np.int32), point)

    def solve(self) -> Outcome:
        """Solve within what is left of the clock; a linear programme starts from its last basis."""
        outcome = self._run()
        if outcome is None:  # infeasible or unbounded: only presolve leaves that open
            _, presolve = self.highs.getOptionValue("presolve")
            self.set("presolve", "off")
            outcome = self._run()
            self.set("presolve", presolve)
        return outcome or Outcome.STOPPED

    @property
    def values(self) -> Values:
        """The last point, a value a column; gone when rows or columns change."""
        return np.array(self.highs.getSolution().col_value, dtype=np.float64)

    @property
    def row_duals(self) -> Values:
        """Row multipliers of the last linear solve: change of the objective a unit of each row."""
        return np.array(self.highs.getSolution().row_dual, dtype=np.float64)

    def _run(self) -> Outcome | None:
        # HiGHS adds up the run times of one object and holds the sum against its limit.
        self.set("time_limit", min(self.highs.getRunTime() + self._clock.left, highspy.kHighsInf))
        self.highs.run()
        info = self.highs.getInfo()
        self.has_solution = bool(info.primal_solution_status == _FEASIBLE_POINT)
        self.objective = float(info.objective_function_value)
        self.bound = float(info.mip_dual_bound)
        return _OUTCOMES.get(self.highs.getModelStatus(), Outcome.STOPPED)

    def _watch(self, event: Any) -> None:
        if self._clock.expired:
            event.interrupt()
        if self._on_progress is None or event.data_out is None:
            return
        if self._clock.seconds - self._reported >= _REPORT_EVERY:
            self._reported = self._clock.seconds
            figures = (event.data_out.mip_primal_bound, event.data_out.mip_dual_bound)
            objective, bound = (v if abs(v) < highspy.kHighsInf else None for v in figures)
            self._on_progress(objective, bound)

    def _improve(self, event: Any) -> None:
        if self._on_solution is not None and event.data_out is not None:
            self._on_solution(np.array(event.data_out.mip_solution, dtype=np.float64))


_REPORT_EVERY = 0.2  # seconds between two progress reports
_FEASIBLE_POINT = 2  # kSolutionStatusFeasible of HiGHS

_OUTCOMES: dict[Any, Outcome | None] = {
    highspy.HighsModelStatus.kOptimal: Outcome.OPTIMAL,
    highspy.HighsModelStatus.kModelEmpty: Outcome.OPTIMAL,
    highspy.HighsModelStatus.kInfeasible: Outcome.INFEASIBLE,
    highspy.HighsModelStatus.kUnbounded: Outcome.UNBOUNDED,
    highspy.HighsModelStatus.kUnboundedOrInfeasible: None,
}
