"""The operator T against complete enumeration, with planned and with sampled times."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.heuristics.sggarp import Genetics, optimise_route
from fiveroute.instance import Uncertainty
from fiveroute.limits import Limits
from fiveroute.models.stochastic import solve_sampled
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route
from fiveroute.sampling import RouteStatistic, SampledLegs, sample_legs


@st.composite
def problems(draw: st.DrawFn, most: int = 6) -> TeamOrienteering:
    """One AUV, asymmetric times without the triangle inequality, a direct leg in time."""
    n = draw(st.integers(0, most))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    travel = rng.random((n + 2, n + 2)) * 100.0
    if draw(st.booleans()):
        travel = np.floor(travel / 30.0)
    travel[0, -1] = 0.0
    service = np.array([0.0, *rng.random(n) * 5.0, 0.0])
    profit = np.array([0.0, *np.floor(rng.random(n) * 4.0), 0.0])
    return TeamOrienteering(travel, service, profit, [draw(st.floats(0.0, 300.0))])


def scattered(n: int, seed: int) -> TeamOrienteering:
    """A scenario of the paper's kind: 10 km x 10 km, 1 m/s, five hours."""
    rng = np.random.default_rng(seed)
    points = np.vstack([[3e3, 5e3], rng.random((n, 2)) * 1e4, [7e3, 5e3]])
    profit = np.array([0.0, *1.0 - rng.random(n), 0.0])
    travel = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    return TeamOrienteering(travel, np.where(profit > 0, 5 + 20 * profit, 0), profit, [18_000.0])


def every_route(n: int) -> list[Route]:
    return [
        order for size in range(n + 1) for order in itertools.permutations(range(1, n + 1), size)
    ]


def gga(problem: TeamOrienteering, route: Route = (), seed: int = 0, **kwargs: object) -> Route:
    idle = [node for node in range(1, problem.n + 1) if node not in route]
    return optimise_route(problem, 0, route, idle, rng=np.random.default_rng(seed), **kwargs)  # type: ignore[arg-type]


@settings(deadline=None, max_examples=40, derandomize=True)
@given(problems())
def test_gga_finds_the_optimum_of_small_problems(problem: TeamOrienteering) -> None:
    in_time = [
        route for route in every_route(problem.n) if problem.duration(route) <= problem.allowed[0]
    ]
    most = max(map(problem.collected, in_time))
    found = gga(problem)
    assert problem.duration(found) <= problem.allowed[0]
    assert problem.collected(found) == pytest.approx(most)


@settings(deadline=None, max_examples=25, derandomize=True)
@given(problems(most=5), st.sampled_from([None, 0.5, 0.8, 1.0]))
def test_s_ggarp_finds_the_optimum_of_small_sampled_problems(
    problem: TeamOrienteering, quantile: float | None
) -> None:
    noise = Uncertainty(drift=0.3, manoeuvres_per_km=0.5, manoeuvre_time=20.0)
    km = problem.travel / 50.0
    legs = sample_legs(problem.travel, km, noise, 15, np.random.default_rng(0))
    sampled = SampledLegs(legs, RouteStatistic(quantile))
    values = [
        problem.collected(route)
        for route in every_route(problem.n)
        if sampled.duration(problem.service, route) <= problem.allowed[0]
    ]
    found = gga(problem, sampled=sampled)
    assert sampled.duration(problem.service, found) <= problem.allowed[0]
    assert problem.collected(found) == pytest.approx(max(values))


@pytest.mark.parametrize("seed", range(3))
def test_s_ggarp_reaches_the_exact_sampled_optimum(seed: int) -> None:
    problem = scattered(10, seed).with_budgets([14_000.0])
    noise = Uncertainty(drift=0.2, manoeuvres_per_km=0.5, manoeuvre_time=60.0)
    km = problem.travel / 1e3
    legs = sample_legs(problem.travel, km, noise, 20, np.random.default_rng(seed))
    for quantile in (None, 0.8):
        statistic = RouteStatistic(quantile)
        exact = solve_sampled(legs, problem.service, problem.profit, 14_000.0, statistic)
        found = gga(problem, sampled=SampledLegs(legs, statistic))
        assert exact.profit is not None
        assert problem.collected(found) == pytest.approx(exact.profit)


def test_sampling_makes_routes_more_robust() -> None:
    """A route planned for the 90 % quantile is in time in fresh samples, most of the time."""
    problem = scattered(40, 3)
    noise = Uncertainty(drift=0.2, manoeuvres_per_km=0.5, manoeuvre_time=60.0)
    rng = np.random.default_rng(5)
    planned, fresh = (
        sample_legs(problem.travel, problem.travel / 1e3, noise, 200, rng) for _ in range(2)
    )
    late = {}
    for name, sampled in (
        ("gga", None),
        ("mean", SampledLegs(planned, RouteStatistic())),
        ("quantile", SampledLegs(planned, RouteStatistic(0.9))),
    ):
        route = gga(problem, sampled=sampled)
        stops = [0, *route, problem.destination]
        times = fresh[:, stops[:-1], stops[1:]].sum(axis=1) + problem.service[stops].sum()
        late[name] = float((times > problem.budgets[0]).mean())
    assert late["quantile"] < 0.2 < late["mean"] < late["gga"]


def test_samples_without_noise_plan_what_gga_plans() -> None:
    problem = scattered(20, 1)
    legs = np.repeat(problem.travel[None], 3, axis=0)
    for quantile in (None, 0.9):
        sampled = SampledLegs(legs, RouteStatistic(quantile))
        assert problem.collected(gga(problem, sampled=sampled)) == pytest.approx(
            problem.collected(gga(problem))
        )


@pytest.mark.parametrize("seed", range(3))
def test_the_present_route_never_gets_worse(seed: int) -> None:
    problem = scattered(25, 7)
    little = Genetics(population=4, generations=1)
    good = gga(problem)
    again = gga(problem, good, seed=seed, genetics=little)
    assert problem.collected(again) >= problem.collected(good)


def test_only_own_and_offered_nodes_are_visited() -> None:
    problem = scattered(25, 2)
    found = optimise_route(problem, 0, (3, 4), (5, 6, 7), rng=np.random.default_rng(0))
    assert set(found) <= {3, 4, 5, 6, 7}


def test_the_seed_decides() -> None:
    problem = scattered(40, 4)
    assert gga(problem, seed=1) == gga(problem, seed=1)


def test_a_route_without_better_ones_comes_back() -> None:
    """No route is in time here; T says so by returning what it got."""
    problem = TeamOrienteering(np.full((3, 3), 9.0), np.zeros(3), [0.0, 1.0, 0.0], [5.0])
    assert gga(problem, (1,)) == (1,)
    assert gga(problem) == ()


def test_an_expired_clock_returns_the_route() -> None:
    problem = scattered(25, 5)
    assert gga(problem, (1, 2), clock=Limits(time=0.0).start()) == (1, 2)


def test_budgets_are_those_of_the_auv() -> None:
    problem = scattered(25, 6).with_budgets([18_000.0, 6_000.0])
    short = optimise_route(problem, 1, (), range(1, 26), rng=np.random.default_rng(0))
    assert problem.duration(short) <= problem.allowed[1]
