"""Quick bounds: never below the optimum, never weaker for more work."""

from __future__ import annotations

import csv
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models import bounds
from fiveroute.models.bounds import Bound, Effort, quick_bound
from fiveroute.problem import TeamOrienteering


def field(n: int, seed: int, fleet: int, budget: float) -> TeamOrienteering:
    """Nodes in a square of 10 by 10, the paper's ends and data."""
    rng = np.random.default_rng(seed)
    xy = np.vstack([[3.0, 5.0], rng.uniform(0.0, 10.0, (n, 2)), [7.0, 5.0]])
    travel = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    profit = np.pad(1.0 - rng.random(n), 1)
    return TeamOrienteering(travel, np.zeros(n + 2), profit, [budget] * fleet)


@pytest.mark.parametrize("seed", range(200))
def test_bounds_the_optimum(seed: int, odd: Callable[[int], Any]) -> None:
    truth = odd(seed)
    for effort in Effort:
        bound = quick_bound(truth.problem, effort=effort)
        assert bound.value >= (truth.optimum or 0.0)
        assert bound.method != "infeasible" or truth.optimum is None


@pytest.mark.parametrize("n", [0, 1, 5, 40, 170])
def test_more_work_never_weakens(n: int) -> None:
    problem = field(n, seed=n, fleet=3, budget=9.0)
    values = [quick_bound(problem, effort=effort).value for effort in Effort]
    assert values == sorted(values, reverse=True)
    assert values[0] <= problem.total_profit * (1.0 + 1e-8)


def test_large_problems_take_the_symmetric_relaxation(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = field(40, seed=9, fleet=3, budget=9.0)
    strong = quick_bound(problem)
    monkeypatch.setattr(bounds, "_WITH_CLOCK", 10)
    monkeypatch.setattr(bounds, "_WITH_DIRECTIONS", 10)
    quick, full = quick_bound(problem), quick_bound(problem, effort=Effort.FULL)
    assert (strong.method, quick.method, full.method) == ("flow", "symmetric", "flow")
    assert strong.value <= full.value * (1.0 + 1e-6) <= quick.value * (1.0 + 2e-6)


def test_the_quality_the_paper_s_size_deserves() -> None:
    """Sixty nodes, three AUVs: the relaxation lies some percent below all data."""
    problem = field(60, seed=0, fleet=3, budget=18.0)
    bound = quick_bound(problem)
    assert bound.method == "flow"
    assert bound.value < 0.95 * problem.total_profit


def test_nodes_beyond_reach_do_not_count() -> None:
    x = np.array([0.0, 1.0, 50.0, 2.0])
    problem = TeamOrienteering(abs(x[:, None] - x), np.zeros(4), [0, 1, 8, 0], [4.0])
    assert quick_bound(problem, effort=Effort.LEAST).value == 1.0


def test_the_grid_of_the_data_rounds_down() -> None:
    """Six nodes on a ring earn 10 each: fractions of them do not count."""
    problem = field(6, seed=1, fleet=1, budget=9.0)
    tens = TeamOrienteering(
        problem.travel, problem.service, 10.0 * np.sign(problem.profit), problem.budgets
    )
    for effort in Effort:
        assert quick_bound(tens, effort=effort).value % 10.0 == 0.0


def test_no_route_at_all() -> None:
    problem = TeamOrienteering([[0, 5], [5, 0]], [0, 0], [0, 0], [6.0, 4.0])
    assert quick_bound(problem) == Bound(0.0, "infeasible")


def test_a_relaxation_may_prove_that_there_is_no_plan() -> None:
    """Both AUVs need node 1 to get across in time."""
    times = [[0, 1, 10], [9, 0, 1], [9, 9, 0]]
    problem = TeamOrienteering(times, [0, 0, 0], [0, 1, 0], [2.0, 2.0])
    assert quick_bound(problem, effort=Effort.LEAST).value == 1.0
    assert quick_bound(problem) == Bound(0.0, "infeasible")


@pytest.mark.parametrize("n", [30, 180, 510])
def test_a_stopped_bound_still_bounds(n: int) -> None:
    problem = field(n, seed=4, fleet=2, budget=10.0)
    least, quick = (quick_bound(problem, effort=e).value for e in (Effort.LEAST, Effort.QUICK))
    interrupted = Limits()
    interrupted.interrupt.set()
    for limits in (Limits(time=0.0), Limits(time=0.02), interrupted):
        assert quick - 1e-9 <= quick_bound(problem, limits).value <= least


def test_an_interrupt_ends_a_long_relaxation() -> None:
    limits = Limits()
    threading.Timer(0.2, limits.interrupt.set).start()
    problem = field(510, seed=5, fleet=6, budget=18.0)
    assert quick_bound(problem, limits, effort=Effort.FULL).value <= problem.total_profit


def test_one_direction_s_current_does_not_fool_large_problems() -> None:
    """Eastward legs take a tenth of westward ones; the symmetric relaxation must not mind."""
    problem = field(510, seed=6, fleet=2, budget=10.0)
    rng = np.random.default_rng(6)
    east = np.where(rng.random(problem.travel.shape) < 0.5, 0.1, 1.0)
    skewed = TeamOrienteering(
        problem.travel * east, problem.service, problem.profit, problem.budgets
    )
    assert quick_bound(skewed).value >= quick_bound(problem).value


def test_importing_bounds_is_light() -> None:
    code = (
        "import sys, fiveroute.models.bounds; "
        "assert not {'highspy', 'ortools', 'scipy.sparse'} & set(sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_never_below_the_best_known_values(public_file: Callable[[str], Path]) -> None:
    """Every twelfth of Chao's instances."""
    table = public_file("benchmarks/top-chao/best-known.csv")
    with table.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))[::12]
    for row in rows:
        words = table.with_name(f"{row['instance']}.txt").read_text(encoding="utf-8").split()
        nodes = np.array(words[6:], dtype=np.float64).reshape(-1, 3)
        travel = np.hypot(*(nodes[:, None, :2] - nodes[:, :2]).transpose(2, 0, 1))
        profit = np.pad(nodes[1:-1, 2], 1)
        budgets = [float(words[5])] * int(words[3])
        problem = TeamOrienteering(travel, np.zeros(len(nodes)), profit, budgets)
        for effort in (Effort.LEAST, Effort.QUICK):
            bound = quick_bound(problem, effort=effort).value
            assert bound >= float(row["best_known"]), row["instance"]
