"""The HiGHS frame, and its peace with OR-Tools in one process."""

from __future__ import annotations

import subprocess
import sys
import threading

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array

from fiveroute.limits import Limits
from fiveroute.models.highs import Outcome, Program

SOLVE_WITH_ORTOOLS = """
from ortools.sat.python import cp_model
model = cp_model.CpModel()
x = model.new_bool_var("x")
model.maximize(x)
solver = cp_model.CpSolver()
assert solver.solve(model) == cp_model.OPTIMAL and solver.value(x) == 1
"""

SOLVE_WITH_HIGHS = """
from fiveroute.limits import Limits
from fiveroute.models.highs import Outcome, Program
program = Program(Limits().start(), maximise=True)
program.add_columns([1.0], 0.0, 2.5, integer=True)
program.require_integers(True)
assert program.solve() is Outcome.OPTIMAL and program.objective == 2.0
"""


@pytest.mark.parametrize(
    "parts",
    [
        (SOLVE_WITH_ORTOOLS, SOLVE_WITH_HIGHS, SOLVE_WITH_ORTOOLS),
        (SOLVE_WITH_HIGHS, SOLVE_WITH_ORTOOLS, SOLVE_WITH_HIGHS),
        ("import highspy", SOLVE_WITH_HIGHS, SOLVE_WITH_ORTOOLS, SOLVE_WITH_HIGHS),
    ],
    ids=["ortools first", "fiveroute first", "highspy first"],
)
def test_either_package_may_come_first(parts: tuple[str, ...]) -> None:
    run = subprocess.run([sys.executable, "-c", "\n".join(parts)], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def _knapsack(program: Program, items: int, rows: int) -> NDArray[np.float64]:
    """A multi-dimensional knapsack: hard in its last percent, feasible at zero; its profits."""
    rng = np.random.default_rng(1)
    weights, profits = rng.random((rows, items)), rng.random(items)
    program.add_columns(profits, 0.0, 1.0, integer=True)
    program.add_rows(csr_array(weights), -np.inf, weights.sum(axis=1) / 4.0)
    return profits


def test_rows_come_in_between_two_solves() -> None:
    program = Program(Limits().start(), maximise=True)
    assert program.add_columns([1.0, 2.0], 0.0, [3.0, 4.0]) == slice(0, 2)
    assert program.solve() is Outcome.OPTIMAL
    assert program.objective == 11.0
    assert program.add_rows(csr_array(np.array([[1.0, 1.0]])), -np.inf, 5.0) == slice(0, 1)
    assert program.solve() is Outcome.OPTIMAL
    assert program.values.tolist() == [1.0, 4.0]
    assert program.row_duals.tolist() == [1.0]
    program.delete_rows([0])
    assert program.solve() is Outcome.OPTIMAL
    assert program.objective == 11.0


def test_integrality_is_demanded_and_relaxed() -> None:
    program = Program(Limits().start(), maximise=True)
    program.add_columns([1.0], 0.0, 1.5, integer=True)
    for required, optimum in ((False, 1.5), (True, 1.0), (False, 1.5)):
        program.require_integers(required)
        assert program.solve() is Outcome.OPTIMAL
        assert program.objective == optimum


@pytest.mark.parametrize("integer", [False, True])
def test_contradicting_rows_are_infeasible(integer: bool) -> None:
    program = Program(Limits().start())
    program.add_columns([1.0, -1.0], 0.0, np.inf, integer=integer)
    program.require_integers(integer)
    program.add_rows(csr_array(np.array([[1.0, 1.0], [1.0, 1.0]])), [3.0, -np.inf], [np.inf, 2.0])
    assert program.solve() is Outcome.INFEASIBLE
    assert not program.has_solution


def test_a_ray_without_end_is_unbounded() -> None:
    program = Program(Limits().start(), maximise=True)
    program.add_columns([1.0, 1.0], 0.0, np.inf)
    program.add_rows(csr_array(np.array([[1.0, -1.0]])), -1.0, 1.0)
    assert program.solve() is Outcome.UNBOUNDED


def test_a_second_look_leaves_the_options_as_they_are() -> None:
    program = Program(Limits().start(), maximise=True)
    program.set("presolve", "on")
    program.add_columns([1.0, 1.0], 0.0, np.inf)
    program.add_rows(csr_array(np.array([[1.0, -1.0]])), -1.0, 1.0)
    assert program.solve() is Outcome.UNBOUNDED
    assert program.highs.getOptionValue("presolve")[1] == "on"


def test_an_expired_clock_stops_at_once_with_a_bound() -> None:
    program = Program(Limits(time=0.0).start(), maximise=True)
    _knapsack(program, 60, 30)
    program.require_integers(True)
    assert program.solve() is Outcome.STOPPED
    assert program.bound >= 0.0


def test_the_time_limit_counts_each_solve_by_itself() -> None:
    """HiGHS adds the run times of one object up; a fresh second must still be a second."""
    program = Program(Limits().start(), maximise=True)
    _knapsack(program, 30, 5)
    program.require_integers(True)
    assert program.solve() is Outcome.OPTIMAL
    spent = program.highs.getRunTime()
    assert program.solve() is Outcome.OPTIMAL
    assert program.highs.getRunTime() >= spent


def test_an_interrupt_from_another_thread_leaves_incumbent_and_bound() -> None:
    limits = Limits()
    seen: list[tuple[float | None, float | None]] = []

    def interrupt_once_underway(objective: float | None, bound: float | None) -> None:
        seen.append((objective, bound))
        if objective is not None and bound is not None:
            threading.Thread(target=limits.interrupt.set).start()

    program = Program(limits.start(), maximise=True, on_progress=interrupt_once_underway)
    _knapsack(program, 200, 60)
    program.require_integers(True)
    assert program.solve() is Outcome.STOPPED
    assert program.has_solution
    assert program.objective <= program.bound
    objective, bound = seen[-1]
    assert objective is not None
    assert bound is not None
    assert objective <= bound


def test_a_handed_over_solution_is_the_first_incumbent() -> None:
    program = Program(Limits().start(), maximise=True)
    profits = _knapsack(program, 60, 30)
    program.require_integers(True)
    program.set("mip_max_nodes", 0)
    program.set("mip_heuristic_effort", 0.0)
    best = np.zeros(60)
    best[np.argsort(-profits)[:10]] = 1.0
    program.start_from(best)
    program.solve()
    assert program.has_solution
    assert program.objective >= profits @ best


def test_unknown_options_are_refused() -> None:
    with pytest.raises(ValueError, match="no_such_option"):
        Program(Limits().start()).set("no_such_option", 1)
