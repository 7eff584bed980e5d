from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.check import check
from fiveroute.errors import InputError
from fiveroute.heuristics.fleet_search import default_trials, fleet_search
from fiveroute.limits import Limits, Progress
from fiveroute.models.brute_force import solve as brute_force
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan, Route


def random_problem(seed: int, most: int = 8) -> TeamOrienteering:
    """Asymmetric or not, metric or not, with zeros, closed or open, budgets equal or not."""
    rng = np.random.default_rng(seed)
    n, size = int(rng.integers(0, most + 1)), int(rng.integers(1, 4))
    points = rng.uniform(0.0, 100.0, (n + 2, 2))
    if rng.random() < 0.3:
        points[-1] = points[0]
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    if rng.random() < 0.5:
        travel *= rng.uniform(0.5, 1.5, travel.shape)
    if rng.random() < 0.2:
        travel *= rng.random(travel.shape) < 0.8
    service = np.pad(rng.uniform(0.0, 20.0, n) * (rng.random() < 0.7), 1)
    profit = np.pad(rng.random(n) * (rng.random(n) < 0.9), 1)
    budgets = travel[0, -1] + rng.uniform(10.0, 250.0, size)
    return TeamOrienteering(travel, service, profit, budgets)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1))
def test_every_plan_is_feasible_and_none_beats_the_optimum(seed: int) -> None:
    problem = random_problem(seed)
    plan = fleet_search(problem, rng=np.random.default_rng(seed), iterations=300)
    assert check(problem, plan) == []
    best = brute_force(problem).objective
    assert best is not None
    assert plan.objective(problem) <= best + 1e-9


@pytest.mark.parametrize("seed", range(20))
def test_small_problems_are_solved_to_the_optimum(seed: int) -> None:
    problem = random_problem(seed)
    plan = fleet_search(problem, rng=np.random.default_rng(1), iterations=5_000)
    assert plan.objective(problem) == pytest.approx(brute_force(problem).objective, abs=1e-9)


def big_problem() -> TeamOrienteering:
    rng = np.random.default_rng(7)
    points = rng.uniform(0.0, 100.0, (82, 2))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    return TeamOrienteering(travel, np.zeros(82), np.pad(rng.random(80), 1), [200.0] * 3)


def test_the_answer_is_never_worse_than_the_plan_to_start_from() -> None:
    problem = big_problem()
    rough = fleet_search(problem, rng=np.random.default_rng(1), iterations=200)
    for seed in range(3):
        better = fleet_search(
            problem, rng=np.random.default_rng(seed), warm_start=rough, iterations=50
        )
        assert better.objective(problem) >= rough.objective(problem)


def test_the_routes_it_came_across_are_told() -> None:
    """Different ones, each in time, and with those of the plan among them."""
    problem = big_problem()
    routes: list[Route] = []
    plan = fleet_search(
        problem, rng=np.random.default_rng(1), iterations=20_000, remember=routes.extend
    )
    assert len({frozenset(route) for route in routes}) == len(routes) > problem.fleet_size
    assert all(problem.duration(route) <= 200.0 for route in routes)
    assert {frozenset(route) for route in plan.routes} <= {frozenset(route) for route in routes}


def test_same_seed_same_plan() -> None:
    problem = big_problem()
    first, second = (
        fleet_search(problem, rng=np.random.default_rng(3), iterations=2_000) for _ in range(2)
    )
    assert first == second


@pytest.mark.parametrize("exponent", [-60, 40])
@pytest.mark.parametrize("seed", [3, 4, 5])
def test_the_unit_of_data_does_not_change_the_plan(seed: int, exponent: int) -> None:
    """A power of two loses no bit."""
    problem = random_problem(seed, most=40)
    other = replace(problem, profit=problem.profit * 2.0**exponent)
    plans = [
        fleet_search(each, rng=np.random.default_rng(7), iterations=3_000)
        for each in (problem, other)
    ]
    assert plans[0] == plans[1]


@pytest.mark.parametrize("workers", [1, 2, 3, 8])
def test_the_number_of_workers_does_not_change_the_plan(workers: int) -> None:
    """Long enough to recombine; one worker does without threads."""
    problem = big_problem()
    plans = [
        fleet_search(problem, rng=np.random.default_rng(3), iterations=30_000, workers=number)
        for number in (1, workers)
    ]
    assert plans[0] == plans[1]


def test_enough_is_enough() -> None:
    """A plan that reaches what is enough ends the search before its time."""
    problem = big_problem()
    enough = 0.5 * fleet_search(problem, rng=np.random.default_rng(1), iterations=5_000).objective(
        problem
    )
    plan = fleet_search(problem, Limits(time=1000.0), rng=np.random.default_rng(1), enough=enough)
    assert plan.objective(problem) >= enough


def test_the_problem_is_left_as_it_was() -> None:
    problem = big_problem()
    before = problem.travel.copy(), problem.profit.copy(), problem.budgets.copy()
    fleet_search(problem, rng=np.random.default_rng(3), iterations=500)
    after = problem.travel, problem.profit, problem.budgets
    assert all(np.array_equal(a, b) for a, b in zip(before, after, strict=True))


def test_an_infeasible_plan_to_start_from_is_refused() -> None:
    problem = big_problem()
    with pytest.raises(InputError, match="feasible plan"):
        fleet_search(problem, rng=np.random.default_rng(1), warm_start=Plan.of([[1], [1], []]))


def test_a_destination_out_of_reach_has_no_plan() -> None:
    far = TeamOrienteering([[0.0, 9.0], [9.0, 0.0]], [0, 0], [0, 0], [5.0])
    with pytest.raises(ValueError, match="no feasible plan"):
        fleet_search(far, rng=np.random.default_rng(1))


def test_a_detour_is_taken_where_the_direct_leg_is_too_long() -> None:
    """The direct leg takes 9 s of 5 s; by way of the node it takes 2 s."""
    detour = TeamOrienteering([[0, 1, 9], [1, 0, 1], [9, 1, 0]], [0, 0, 0], [0, 1, 0], [5.0])
    assert fleet_search(detour, rng=np.random.default_rng(1), iterations=10).routes == ((1,),)


def test_an_interrupt_gives_the_best_so_far_at_once() -> None:
    problem, limits = big_problem(), Limits(time=1000.0)
    limits.interrupt.set()
    plan = fleet_search(problem, limits, rng=np.random.default_rng(1))
    assert check(problem, plan) == []


def test_no_time_is_no_search_but_still_a_plan() -> None:
    problem = big_problem()
    plan = fleet_search(problem, Limits(time=0.0), rng=np.random.default_rng(1))
    assert check(problem, plan) == []


def test_progress_tells_of_better_and_better_plans() -> None:
    told: list[Progress] = []
    fleet_search(
        big_problem(), rng=np.random.default_rng(1), iterations=5_000, progress=told.append
    )
    objectives = [progress.objective or 0.0 for progress in told]
    assert len(objectives) > 1
    assert objectives == sorted(set(objectives))


def test_more_nodes_get_more_trials() -> None:
    assert default_trials(5_000) > default_trials(60) > 0
