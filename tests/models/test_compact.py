"""The compact model: how the printed constraints differ from the right ones, and cut-offs."""

from itertools import permutations

import numpy as np
import pyomo.environ as pyo
import pytest

from fiveroute.limits import Limits
from fiveroute.models import compact
from fiveroute.models.compact_model import Reading, formulate
from fiveroute.models.highs import Outcome
from fiveroute.models.pyomo_program import translate
from fiveroute.problem import TeamOrienteering
from fiveroute.result import Status
from fiveroute.routes import Plan

PRINTED_STARTS = Reading(aggregated_starts=True)
PRINTED_POSITIONS = Reading(printed_positions=True)


def optimum(problem: TeamOrienteering, reading: Reading | None = None) -> float | None:
    """J of the model as it stands, without the judge; None where it has no solution."""
    model = formulate(problem, reading)
    program, columns = translate(model, Limits().start())
    program.require_integers(True)
    if program.solve() is Outcome.INFEASIBLE:
        return None
    values = program.values
    for variable, column in columns.items():
        variable.set_value(values[column], skip_validation=True)
    return float(pyo.value(model.J))


def two_arms(budgets: list[float]) -> TeamOrienteering:
    """Nodes 10 s west and 10 s east of a common start and destination."""
    x = np.array([0.0, -10.0, 10.0, 0.0])
    return TeamOrienteering(np.abs(x[:, None] - x), [0] * 4, [0, 1, 1, 0], budgets)


def random_problem(n: int, budgets: list[float], seed: int) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    travel = rng.uniform(1.0, 10.0, (n + 2, n + 2))
    return TeamOrienteering(travel, np.zeros(n + 2), np.pad(1.0 - rng.random(n), 1), budgets)


def test_printed_starts_let_one_auv_sail_two_routes() -> None:
    """Budgets (2T, eps): the AUV that can sail takes both arms, the other never leaves."""
    travel = two_arms([40.0]).travel.copy()
    travel[1, 2] = travel[2, 1] = 1000.0  # no way between the arms but through the start
    problem = TeamOrienteering(travel, [0] * 4, [0, 1, 1, 0], [40.0, 0.0])
    assert optimum(problem) == pytest.approx(1.0)
    assert optimum(problem, PRINTED_STARTS) == pytest.approx(2.0)


@pytest.mark.parametrize("seed", range(4))
def test_printed_starts_change_nothing_for_equal_budgets(seed: int) -> None:
    problem = random_problem(4, [14.0, 14.0], seed)
    assert optimum(problem, PRINTED_STARTS) == pytest.approx(optimum(problem))


def test_printed_positions_forbid_the_route_through_everything() -> None:
    """Three nodes on a line in ample time: the printed (7), (8) collect two of them at most."""
    x = np.arange(5.0)
    problem = TeamOrienteering(np.abs(x[:, None] - x), [0] * 5, [0, 1, 1, 1, 0], [100.0])
    assert optimum(problem) == pytest.approx(3.0)
    assert optimum(problem, PRINTED_POSITIONS) == pytest.approx(2.0)


def test_the_rows_are_those_of_the_paper() -> None:
    problem = random_problem(3, [100.0, 100.0], seed=0)
    model = formulate(problem)
    n, fleet = 3, 2
    sizes = {c.local_name: len(c) for c in model.component_objects(pyo.Constraint)}
    legs_between = n * (n - 1) + n  # i, j >= 2 in the paper's numbers, no loops
    assert sizes == {
        "eq3_start": fleet,
        "eq3_end": fleet,
        "eq4": n,
        "eq5_in": n * fleet,
        "eq5_out": n * fleet,
        "eq6": fleet,
        "eq8": legs_between * fleet,
        "order": n,
    }
    assert all(i != j for i, j, _ in model.x)
    assert all((0, problem.destination, m) in model.x for m in range(fleet))
    assert all(u.bounds == (2, n + 2) for u in model.u.values())


@pytest.mark.parametrize("seed", range(6))
def test_strengthening_changes_no_optimum(seed: int) -> None:
    problem = random_problem(5, [14.0, 11.0] if seed % 2 else [12.0, 12.0], seed)
    literal = compact.solve(problem, strengthened=False)
    assert literal.status in (Status.OPTIMAL, Status.INFEASIBLE)
    strengthened = compact.solve(problem)
    assert strengthened.status is literal.status
    assert strengthened.objective == pytest.approx(literal.objective, abs=1e-6)


@pytest.mark.parametrize("short", [2e-9, 1e-8, 1e-7, 5e-7])
def test_a_route_within_the_tolerance_of_highs_is_cut_off(short: float) -> None:
    """The budget lacks less than HiGHS notices of what all three nodes take."""
    whole = random_problem(3, [1.0], seed=3)
    least = min(whole.duration(order) for order in permutations((1, 2, 3)))
    result = compact.solve(whole.with_budgets([least * (1.0 - short)]))
    assert result.status is Status.OPTIMAL
    assert result.plan is not None
    assert len(result.plan.visited) < 3
    exact = compact.solve(whole.with_budgets([least]))
    assert exact.plan is not None
    assert len(exact.plan.visited) == 3


def test_a_stop_after_the_relaxation_reports_its_bound() -> None:
    """The bound says at least what is collected, and at most all there is."""
    problem = random_problem(10, [12.0, 12.0], seed=1)
    for seconds in (0.02, 0.1):
        result = compact.solve(problem, Limits(time=seconds))
        assert result.bound is not None
        assert result.objective is not None
        assert result.objective <= result.bound <= problem.total_profit


def test_a_warm_start_is_kept_whatever_the_order_of_equal_auvs() -> None:
    start = Plan(((2,), (1,)))
    result = compact.solve(two_arms([20.0, 20.0]), warm_start=start)
    assert result.plan == start
    assert result.status is Status.OPTIMAL
