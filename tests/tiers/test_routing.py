"""Algorithm 1: what comes out is feasible, no worse than what went in, and terminates."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.check import check
from fiveroute.heuristics.sggarp import Genetics
from fiveroute.heuristics.shortest_routes import shortest_routes
from fiveroute.instance import Uncertainty
from fiveroute.limits import Limits
from fiveroute.models.segmentation import segment
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan
from fiveroute.sampling import RouteStatistic, SampledLegs, sample_legs
from fiveroute.tiers.routing import RouteSearch, best_routing, plan_routes

QUICK = RouteSearch(Genetics(population=6, generations=10))


def scattered(n: int, seed: int, fleet_size: int = 3) -> TeamOrienteering:
    """A scenario of the paper's kind: 10 km x 10 km, 1 m/s, five hours."""
    rng = np.random.default_rng(seed)
    points = np.vstack([[3e3, 5e3], rng.random((n, 2)) * 1e4, [7e3, 5e3]])
    profit = np.array([0.0, *1.0 - rng.random(n), 0.0])
    travel = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    service = np.where(profit > 0, 5 + 20 * profit, 0)
    return TeamOrienteering(travel, service, profit, [18_000.0] * fleet_size)


@st.composite
def problems(draw: st.DrawFn) -> TeamOrienteering:
    """Anything: asymmetric, no triangle inequality, different budgets, perhaps infeasible."""
    n = draw(st.integers(0, 8))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    travel = rng.random((n + 2, n + 2)) * 100.0
    if draw(st.booleans()):
        travel = np.floor(travel / 30.0)
    service = np.array([0.0, *rng.random(n) * 5.0, 0.0])
    profit = np.array([0.0, *np.floor(rng.random(n) * 4.0), 0.0])
    return TeamOrienteering(travel, service, profit, rng.random(draw(st.integers(1, 3))) * 300.0)


@settings(deadline=None, max_examples=40)
@given(problems(), st.booleans())
def test_whatever_the_problem_the_plan_is_feasible(
    problem: TeamOrienteering, literal: bool
) -> None:
    start = segment(problem, tuple(range(1, problem.n + 1)), problem.fleet_size)
    search = RouteSearch(QUICK.genetics, literal=literal)
    routing = plan_routes(problem, start, search, rng=np.random.default_rng(0))
    if routing is None:
        assert shortest_routes(problem) is None
        return
    assert check(problem, routing.plan) == []
    trimmed = Plan(routing.trimmed)
    if not check(problem, trimmed):
        assert routing.plan.objective(problem) >= trimmed.objective(problem) - 1e-9


def test_the_stages_are_those_of_the_picture() -> None:
    problem = scattered(60, 1)
    start = segment(problem, tuple(range(1, 61)), 3)
    routing = plan_routes(problem, start, QUICK, rng=np.random.default_rng(0))
    assert routing is not None
    assert routing.sub_routes == start
    for before, after in zip(start, routing.trimmed, strict=True):
        assert [node for node in before if node in after] == list(after)
    assert routing.dropped == set(range(1, 61)) - Plan(routing.trimmed).visited
    assert routing.dropped & routing.plan.visited  # some come back


def test_the_exchange_collects_more_than_the_letter() -> None:
    """Over a few scenarios: own nodes only < own and idle ones < the best of several starts."""
    totals = np.zeros(3)
    for seed in range(4):
        problem = scattered(60, seed)
        rng = np.random.default_rng(seed)
        by_angle = sorted(range(1, 61), key=lambda node: (problem.travel[0, node], node))
        starts = [segment(problem, tuple(rng.permutation(by_angle).tolist()), 3) for _ in range(4)]
        for kind, (some, literal) in enumerate(
            ((starts[:1], True), (starts[:1], False), (starts, False))
        ):
            search = RouteSearch(literal=literal)
            routing = best_routing(problem, some, search, rng=np.random.default_rng(0))
            assert routing is not None
            totals[kind] += routing.plan.objective(problem)
    assert totals[0] < totals[1] < totals[2]


def test_to_the_letter_every_auv_visits_its_own_or_idle_nodes() -> None:
    """Nodes of another AUV's sub-route come in by pick-up only, once that AUV has left them."""
    problem = scattered(40, 2)
    start = segment(problem, tuple(range(1, 41)), 3)
    routing = plan_routes(problem, start, RouteSearch(literal=True), rng=np.random.default_rng(0))
    assert routing is not None
    for own, route in zip(start, routing.plan.routes, strict=True):
        assert set(route) & set(own)


def test_nothing_changes_when_run_again() -> None:
    """The loop ends where neither T nor pick-up changes anything, with the same random numbers."""
    problem = scattered(30, 3)
    start = segment(problem, tuple(range(1, 31)), 3)
    once, twice = (
        plan_routes(problem, start, QUICK, rng=np.random.default_rng(5)) for _ in range(2)
    )
    assert once == twice


def test_sampled_routes_keep_to_the_statistic_and_to_the_plan() -> None:
    problem = scattered(40, 4)
    noise = Uncertainty(drift=0.2, manoeuvres_per_km=0.5, manoeuvre_time=60.0)
    legs = sample_legs(problem.travel, problem.travel / 1e3, noise, 40, np.random.default_rng(1))
    start = segment(problem, tuple(range(1, 41)), 3)
    objectives = []
    for quantile in (None, 0.9):
        sampled = SampledLegs(legs, RouteStatistic(quantile))
        search = RouteSearch(QUICK.genetics, sampled=sampled)
        routing = plan_routes(problem, start, search, rng=np.random.default_rng(0))
        assert routing is not None
        assert check(problem, routing.plan) == []
        for route in routing.plan.routes:
            assert sampled.duration(problem.service, route) <= problem.allowed[0]
        objectives.append(routing.plan.objective(problem))
    assert objectives[0] > objectives[1]


@pytest.mark.parametrize("genetics", [None, QUICK.genetics])
def test_out_of_time_or_without_t_routes_are_trimmed_at_least(genetics: Genetics | None) -> None:
    problem = scattered(40, 5)
    start = segment(problem, tuple(range(1, 41)), 3)
    routing = plan_routes(
        problem,
        start,
        RouteSearch(genetics),
        rng=np.random.default_rng(0),
        clock=Limits(time=0.0).start(),
    )
    assert routing is not None
    assert check(problem, routing.plan) == []
    assert routing.plan.visited >= Plan(routing.trimmed).visited


def test_starts_are_taken_only_as_long_as_there_is_time() -> None:
    problem = scattered(20, 6)
    start = segment(problem, tuple(range(1, 21)), 3)
    endless = itertools.repeat(start)
    clock = Limits(time=0.0).start()
    assert best_routing(problem, endless, QUICK, rng=np.random.default_rng(0), clock=clock)


def test_few_offered_nodes_are_those_worth_most() -> None:
    problem = scattered(60, 7)
    start = segment(problem, tuple(range(1, 61)), 3)
    search = RouteSearch(QUICK.genetics, offered=3)
    routing = plan_routes(problem, start, search, rng=np.random.default_rng(0))
    assert routing is not None
    assert check(problem, routing.plan) == []
