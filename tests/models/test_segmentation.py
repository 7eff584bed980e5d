"""Every cut against complete enumeration, and what the measures mean by hand."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.errors import InputError
from fiveroute.models.segmentation import Balance, imbalance, segment
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Route


def line(places: list[float], service: float = 0.0) -> TeamOrienteering:
    """Nodes on a line, start and destination both at 0."""
    at = np.array([0.0, *places, 0.0])
    times = np.array([0.0, *[service] * len(places), 0.0])
    return TeamOrienteering(np.abs(at[:, None] - at), times, np.zeros_like(at), [1.0])


def times_of(problem: TeamOrienteering, routes: tuple[Route, ...]) -> np.ndarray:
    return np.array([problem.duration(route) for route in routes])


def least_imbalance(
    problem: TeamOrienteering, route: Route, fleet_size: int, balance: Balance
) -> float:
    """Complete enumeration of all C(n - 1, M - 1) cuts."""
    every_cut = itertools.combinations(range(1, len(route)), fleet_size - 1)
    return min(
        imbalance(
            np.array([problem.duration(route[a:b]) for a, b in itertools.pairwise(stops)]), balance
        )
        for stops in ([0, *cut, len(route)] for cut in every_cut)
    )


@st.composite
def giant_routes(draw: st.DrawFn) -> tuple[TeamOrienteering, Route, int]:
    """Asymmetric problems without the triangle inequality, some of them full of ties."""
    n = draw(st.integers(1, 8))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    travel = rng.random((n + 2, n + 2)) * 100.0
    if draw(st.booleans()):
        travel = np.floor(travel / 25.0)
    service = np.array([0.0, *rng.random(n) * draw(st.sampled_from([0.0, 30.0])), 0.0])
    problem = TeamOrienteering(travel, service, np.zeros(n + 2), [1.0])
    route = tuple(int(node) for node in rng.permutation(n) + 1)
    return problem, route, draw(st.integers(1, n))


@settings(deadline=None, max_examples=150)
@given(giant_routes(), st.sampled_from(Balance))
def test_no_cut_is_more_even(
    given_route: tuple[TeamOrienteering, Route, int], balance: Balance
) -> None:
    problem, giant_route, fleet_size = given_route
    routes = segment(problem, giant_route, fleet_size, balance)
    assert len(routes) == fleet_size
    assert all(routes)
    assert sum(routes, ()) == giant_route
    reached = imbalance(times_of(problem, routes), balance)
    least = least_imbalance(problem, giant_route, fleet_size, balance)
    assert reached == pytest.approx(least, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("balance", list(Balance))
def test_middle_size_against_enumeration(balance: Balance) -> None:
    """A geometric route of 30 nodes, 4 AUVs, 3654 cuts."""
    rng = np.random.default_rng(5)
    points = rng.random((32, 2)) * 1e4
    travel = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    service = np.array([0.0, *rng.random(30) * 20.0, 0.0])
    problem = TeamOrienteering(travel, service, np.zeros(32), [1.0])
    giant_route = tuple(int(node) for node in 1 + np.argsort(points[1:-1, 0]))
    reached = imbalance(times_of(problem, segment(problem, giant_route, 4, balance)), balance)
    assert reached == pytest.approx(least_imbalance(problem, giant_route, 4, balance), rel=1e-12)


def test_by_hand() -> None:
    """Out to 1, 2, 4, home in between: 2 + 8 after one node, 4 + 8 after two."""
    assert segment(line([1.0, 2.0, 4.0]), (1, 2, 3), 2) == ((1, 2), (3,))


def test_services_count() -> None:
    """Legs alone would cut after the second node; 10 s at each node forbid it for minmax."""
    problem = line([1.0, 1.0, 1.0, 4.0], service=10.0)
    assert segment(problem, (1, 2, 3, 4), 2, Balance.MINMAX) == ((1, 2), (3, 4))


def test_measures_differ() -> None:
    times = np.array([1.0, 2.0, 6.0])
    assert imbalance(times, Balance.SQUARED) == pytest.approx(14.0)
    assert imbalance(times, Balance.ABSOLUTE) == pytest.approx(6.0)
    assert imbalance(times, Balance.MINMAX) == 6.0


def test_ties_of_minmax_go_to_the_squares() -> None:
    """The node at 50 fixes the longest time; the six others are still shared evenly."""
    problem = line([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 50.0], service=2.0)
    routes = segment(problem, (1, 2, 3, 4, 5, 6, 7), 3, Balance.MINMAX)
    assert routes == ((1, 2, 3), (4, 5, 6), (7,))


@pytest.mark.parametrize("balance", list(Balance))
@pytest.mark.parametrize("n", [0, 1, 3])
def test_more_auvs_than_nodes(balance: Balance, n: int) -> None:
    problem = line([float(i + 1) for i in range(n)])
    route = tuple(range(1, n + 1))
    assert segment(problem, route, n + 2, balance) == (*((i,) for i in route), (), ())


@pytest.mark.parametrize("balance", list(Balance))
def test_one_auv_takes_all(balance: Balance) -> None:
    assert segment(line([3.0, 1.0, 2.0]), (2, 3, 1), 1, balance) == ((2, 3, 1),)


def test_a_fleet_is_not_empty() -> None:
    with pytest.raises(InputError, match="fleet_size: 0: a fleet has at least one AUV"):
        segment(line([1.0]), (1,), 0)
