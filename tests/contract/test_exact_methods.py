"""What every exact method promises, on one bank of small problems."""

import json
import math
import subprocess
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.limits import Limits, Progress
from fiveroute.models import METHODS, choose, solve
from fiveroute.problem import TeamOrienteering
from fiveroute.result import PROOF_TOLERANCE, Result, Status
from fiveroute.routes import Plan


def plane(points: list[tuple[float, float]]) -> NDArray[np.float64]:
    xy = np.array(points)
    return cdist(xy, xy)


def scattered(n: int, budgets: list[float], seed: int) -> TeamOrienteering:
    rng = np.random.default_rng(seed)
    profit = np.pad(1.0 - rng.random(n), 1)
    travel = plane([(x, y) for x, y in rng.uniform(0.0, 100.0, (n + 2, 2))])
    return TeamOrienteering(travel, 5.0 * (profit > 0.0) + 2.0 * profit, profit, budgets)


def in_unit(problem: TeamOrienteering, scale: float) -> TeamOrienteering:
    return replace(problem, profit=problem.profit * scale)


def with_shortcut() -> TeamOrienteering:
    """The direct leg takes 10 s, the way over node 1 takes 2 s."""
    return TeamOrienteering([[0, 1, 10], [9, 0, 1], [9, 9, 0]], [0, 0, 0], [0, 1, 0], budgets=[2.0])


def one_stone_two_auvs() -> TeamOrienteering:
    """Both AUVs need node 1 to get across, and only one can have it."""
    return with_shortcut().with_budgets([2.0, 2.0])


BANK = {
    # A line of three nodes, one second apart; the budget reaches all of them.
    "line": TeamOrienteering(
        plane([(float(i), 0.0) for i in range(5)]), [0] * 5, [0, 1, 2, 4, 0], [4.0]
    ),
    # Nothing to visit: the direct leg is the plan.
    "no nodes": TeamOrienteering([[0, 3], [3, 0]], [0, 0], [0, 0], [3.0, 5.0]),
    # Nothing to visit, and the second AUV cannot even cross.
    "no nodes, too far": TeamOrienteering([[0, 3], [3, 0]], [0, 0], [0, 0], [3.0, 2.0]),
    # Downstream is ten times quicker than upstream.
    "asymmetric": TeamOrienteering(
        np.where(np.tri(6, k=-1) > 0, 10.0, 1.0), [0] * 6, [0, 1, 2, 3, 4, 0], [3.0, 12.0]
    ),
    # Only the way over a node is short enough.
    "shortcut": with_shortcut(),
    # Each AUV alone has a route, the fleet has none.
    "one stone, two AUVs": one_stone_two_auvs(),
    # Everything is everywhere at once.
    "zero times": TeamOrienteering(np.zeros((6, 6)), [0] * 6, [0, 1, 2, 3, 4, 0], [0.0, 0.0]),
    # Zero budgets allow legs of no time, and nothing else.
    "zero budget": TeamOrienteering(
        [[0, 0, 1, 0], [0, 0, 1, 0], [1, 1, 0, 1], [0, 0, 1, 0]], [0] * 4, [0, 2, 9, 0], [0.0]
    ),
    # Start and destination coincide.
    "tour": TeamOrienteering(
        plane([(0.0, 0.0), (0.0, 3.0), (4.0, 3.0), (4.0, 0.0), (0.0, 0.0)]),
        [0] * 5, [0, 1, 1, 1, 0], [14.0],
    ),
    # The AUVs differ, and so do their routes.
    "different budgets": scattered(6, [60.0, 180.0, 110.0], seed=4),
    # Interchangeable AUVs.
    "equal budgets": scattered(6, [150.0, 150.0], seed=5),
    # Node 2 takes no travelling, but all day to serve.
    "service": TeamOrienteering(np.zeros((4, 4)), [0, 3, 99, 0], [0, 1, 50, 0], [5.0]),
    # Node 1 is out of reach of everybody.
    "unreachable": TeamOrienteering(
        plane([(0.0, 0.0), (99.0, 0.0), (1.0, 1.0), (2.0, 0.0)]), [0] * 4, [0, 9, 1, 0], [4.0]
    ),
    # The only leg is longer than the budget by more than rounding.
    "over by a little": TeamOrienteering([[0, 1], [1, 0]], [0, 0], [0, 0], [1.0 - 1e-8]),
    # The route is as long as the budget but for rounding, which the tolerance forgives.
    "rounding": TeamOrienteering(
        np.full((5, 5), 0.1), [0, 0, 0, 0, 0], [0, 1, 1, 1, 0], [0.1 + 0.1 + 0.1 + 0.1 - 1e-12]
    ),
    # Next to nothing is still more than nothing: data in a unit that is far too large.
    "traces of data": in_unit(scattered(6, [110.0, 90.0], seed=6), 1e-9),
    "nearly traces of data": in_unit(scattered(6, [110.0, 90.0], seed=6), 1e-4),
    # The same in a unit that is far too small.
    "bits of data": in_unit(scattered(6, [110.0, 90.0], seed=6), 1e12),
    # The best of it is out of reach, and must not make the rest look like nothing.
    "a lure": TeamOrienteering(
        plane([(0.0, 0.0), (1.0, 1.0), (1.0, 2.0), (99.0, 0.0), (2.0, 0.0)]),
        [0] * 5, [0, 1e-7, math.pi * 1e-7, 1e6, 0], [4.5],
    ),
    # Weightless, and worth a lot: no quotient overflows.
    "free and dear": TeamOrienteering(np.zeros((4, 4)), [0] * 4, [0, 1e9, 3e9, 0], [0.0]),
    # Data without any value.
    "worthless": TeamOrienteering(np.ones((4, 4)), [0] * 4, [0] * 4, [3.0]),
}  # fmt: skip


@st.composite
def problems(draw: st.DrawFn) -> TeamOrienteering:
    """Small problems without any structure: asymmetric, non-metric, with ties and zeros."""
    n = draw(st.integers(0, 5))
    times = st.one_of(st.integers(0, 9).map(float), st.floats(0.0, 10.0, width=32))
    travel = draw(arrays(np.float64, (n + 2, n + 2), elements=times))
    service = draw(arrays(np.float64, n, elements=st.integers(0, 3).map(float)))
    data = st.one_of(st.integers(0, 9).map(float), st.floats(0.125, 8.0, width=32))
    profit = draw(arrays(np.float64, n, elements=data))
    budgets = draw(st.lists(st.integers(0, 25).map(float), min_size=1, max_size=3))
    return TeamOrienteering(travel, np.pad(service, 1), np.pad(profit, 1), budgets)


def truth(problem: TeamOrienteering) -> Result:
    return METHODS["brute-force"](problem)


def require_truth(problem: TeamOrienteering, result: Result) -> None:
    expected = truth(problem)
    assert result.status == expected.status
    if expected.status is Status.INFEASIBLE:
        assert (result.plan, result.objective, result.bound) == (None, 0.0, 0.0)
    else:
        assert result.objective == pytest.approx(expected.objective, rel=1e-6, abs=0.0)
    require_sound(problem, result)


def require_sound(problem: TeamOrienteering, result: Result) -> None:
    """Plan, objective, bound and status agree with each other, whatever the limits were."""
    assert result.bound is not None
    if result.plan is None:
        assert result.status in (Status.NO_SOLUTION, Status.INFEASIBLE)
        return
    assert check(problem, result.plan) == []
    assert result.objective == result.plan.objective(problem)
    assert result.bound >= result.objective
    proved = result.bound <= result.objective * (1.0 + PROOF_TOLERANCE)
    assert result.status is (Status.OPTIMAL if proved else Status.FEASIBLE)


method = pytest.mark.parametrize("name", METHODS)
named = pytest.mark.parametrize("title", BANK)


@method
@named
def test_agrees_with_brute_force(name: str, title: str) -> None:
    require_truth(BANK[title], METHODS[name](BANK[title]))


@method
@settings(max_examples=25, deadline=None)
@given(problem=problems())
def test_agrees_with_brute_force_on_anything(name: str, problem: TeamOrienteering) -> None:
    if METHODS[name].supports(problem):
        require_truth(problem, METHODS[name](problem))


@method
def test_says_its_name_and_repeats_itself(name: str) -> None:
    problem = BANK["different budgets"]
    first, second = METHODS[name](problem), METHODS[name](problem)
    assert first.method == second.method == name
    assert first.plan == second.plan
    assert first.bound == second.bound
    assert first.seconds >= 0.0


@method
def test_leaves_its_input_alone(name: str) -> None:
    problem = scattered(5, [120.0, 90.0], seed=8)
    arrays_before = [getattr(problem, f).copy() for f in ("travel", "service", "profit", "budgets")]
    METHODS[name](problem)
    for field, before in zip(
        ("travel", "service", "profit", "budgets"), arrays_before, strict=True
    ):
        np.testing.assert_array_equal(getattr(problem, field), before)
        assert not getattr(problem, field).flags.writeable


@method
@named
@pytest.mark.parametrize("time", [0.0, 1e-3])
def test_is_sound_when_stopped_early(name: str, title: str, time: float) -> None:
    problem, expected = BANK[title], truth(BANK[title])
    result = METHODS[name](problem, Limits(time=time))
    require_sound(problem, result)
    if expected.plan is None:
        assert result.plan is None
    else:
        assert expected.objective is not None
        assert result.bound is not None
        assert result.status is not Status.INFEASIBLE
        assert result.bound >= expected.objective * (1.0 - PROOF_TOLERANCE)


@method
def test_an_interrupt_set_beforehand_stops_at_once(name: str) -> None:
    limits = Limits()
    limits.interrupt.set()
    problem = BANK["equal budgets"]
    result = METHODS[name](problem, limits)
    require_sound(problem, result)
    assert result.plan == Plan.empty(2)
    assert result.status is Status.FEASIBLE


@method
@settings(max_examples=5, deadline=None)
@given(gap=st.floats(0.0, 1.0))
def test_a_gap_is_kept(name: str, gap: float) -> None:
    problem = BANK["equal budgets"]
    result = METHODS[name](problem, Limits(gap=gap))
    require_sound(problem, result)
    assert result.gap is not None
    assert result.gap <= gap + 1e-6
    best = truth(problem).objective
    assert best is not None
    assert result.bound is not None
    assert result.bound >= best - PROOF_TOLERANCE


@method
@pytest.mark.parametrize("time", [0.0, math.inf])
def test_a_warm_start_is_never_worsened(name: str, time: float) -> None:
    problem = BANK["equal budgets"]
    best = truth(problem)
    assert best.plan is not None
    for start in (best.plan, Plan(best.plan.routes[::-1]), Plan((best.plan.routes[1], ()))):
        result = METHODS[name](problem, Limits(time=time), warm_start=start)
        require_sound(problem, result)
        assert result.objective is not None
        assert result.objective >= start.objective(problem)


@method
@pytest.mark.parametrize("routes", [[[1, 1], []], [[99], []], [[]], [[1, 2, 3, 4, 5, 6], []]])
def test_a_wrong_warm_start_is_left_aside(name: str, routes: list[list[int]]) -> None:
    problem = BANK["equal budgets"]
    require_truth(problem, METHODS[name](problem, warm_start=Plan.of(routes)))


@method
@pytest.mark.parametrize(
    "title", ["different budgets", "equal budgets", "shortcut", "traces of data"]
)
def test_progress_only_improves(name: str, title: str) -> None:
    told: list[Progress] = []
    result = METHODS[name](BANK[title], progress=told.append)
    objectives = [p.objective for p in told if p.objective is not None]
    bounds = [p.bound for p in told if p.bound is not None]
    assert objectives == sorted(objectives)
    assert bounds == sorted(bounds, reverse=True)
    assert all(o <= (result.objective or 0.0) for o in objectives)
    assert all(b >= (result.objective or 0.0) * (1.0 - PROOF_TOLERANCE) for b in bounds)


@settings(max_examples=15, deadline=None)
@given(
    problem=problems(),
    time=st.sampled_from([1e-3, 1.0, 1e3, 1e9]),
    data=st.sampled_from([1e-9, 1e-6, 1e-3, 1e3, 1e9]),
)
def test_units_do_not_matter(problem: TeamOrienteering, time: float, data: float) -> None:
    scaled = TeamOrienteering(
        problem.travel * time, problem.service * time, problem.profit * data,
        problem.budgets * time,
    )  # fmt: skip
    for method in METHODS.values():
        if method.supports(scaled):
            require_truth(scaled, method(scaled))


def test_auto_says_what_it_chose() -> None:
    problem = BANK["equal budgets"]
    assert choose(problem) == "branch-price"
    assert solve(problem).method == "branch-price"
    assert choose(scattered(60, [100.0], seed=1)) == "flow"


def test_an_unknown_method_is_refused() -> None:
    with pytest.raises(InputError, match=r"method: 'magic': no such method; choose auto"):
        solve(BANK["line"], "magic")


def test_what_is_no_problem_is_refused() -> None:
    mission: Any = "small-06.json"
    for call in (solve, METHODS["flow"]):
        with pytest.raises(InputError, match=r"instance\.problem\(\)"):
            call(mission)


def test_limits_may_be_seconds() -> None:
    assert solve(BANK["line"], "circuit", 60).status is Status.OPTIMAL


def test_importing_the_methods_is_light() -> None:
    heavy = ("highspy", "numba", "ortools", "pyomo", "scipy")
    code = (
        "import json, sys, fiveroute.models; "
        f"print(json.dumps([m for m in {heavy} if m in sys.modules]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == []
