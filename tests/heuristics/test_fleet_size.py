"""The estimate of the fleet, worked out by hand."""

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.heuristics.fleet_size import estimate_fleet_size
from fiveroute.problem import TeamOrienteering


def line(places: list[float], budget: float, service: float = 0.0) -> TeamOrienteering:
    """Nodes on a line, start and destination both at 0, speed 1."""
    at = np.array([0.0, *places, 0.0])
    times = np.array([0.0, *[service] * len(places), 0.0])
    return TeamOrienteering(np.abs(at[:, None] - at), times, np.sign(times), [budget])


def test_the_printed_formula() -> None:
    """Out to 10, 20, 30 and home: T_0 = 60, t~ = 10 + 30, T_max = 50."""
    estimate = estimate_fleet_size(line([10.0, 20.0, 30.0], 50.0), (1, 2, 3))
    assert estimate.t_tilde == 40.0
    assert estimate.value == (60.0 - 40.0) / (50.0 - 40.0)
    assert estimate.size == 2


def test_services_count_in_t0_and_not_in_t_tilde() -> None:
    estimate = estimate_fleet_size(line([10.0, 20.0, 30.0], 50.0, service=5.0), (1, 2, 3))
    assert estimate.value == (75.0 - 40.0) / (50.0 - 40.0)


def test_mean_cut_averages_over_the_cuts() -> None:
    """A cut after 10 costs 10 + 20 - 10, a cut after 20 costs 20 + 30 - 10."""
    estimate = estimate_fleet_size(line([10.0, 20.0, 30.0], 50.0), (1, 2, 3), "mean-cut")
    assert estimate.t_tilde == 30.0
    assert estimate.value == (60.0 - 30.0) / (50.0 - 30.0)


def test_mean_cut_balances_exactly_where_all_cuts_cost_the_same() -> None:
    """T_0 + (M - 1) t~ = M T_max with M = 2: two routes that use up their time."""
    problem = line([10.0, -10.0], 20.0)
    assert estimate_fleet_size(problem, (1, 2), "mean-cut", least=1).value == pytest.approx(
        (40.0 - 0.0) / (20.0 - 0.0)
    )


def test_mean_cut_of_a_single_node_is_its_two_legs() -> None:
    assert estimate_fleet_size(line([10.0], 50.0), (1,), "mean-cut").t_tilde == 20.0


@pytest.mark.parametrize(
    ("budget", "size"), [(30.0 + 10.0 / 2.49, 2), (30.0 + 10.0 / 2.5, 3), (30.0 + 10.0 / 3.51, 4)]
)
def test_halves_are_rounded_up(budget: float, size: int) -> None:
    """T_0 - t~ = 10 and t~ = 30, so that M = 10 / (T_max - 30)."""
    problem = TeamOrienteering(
        [[0.0, 10.0, 99.0, 99.0], [99.0, 0.0, 10.0, 99.0], [99.0, 99.0, 0.0, 20.0], [0.0] * 4],
        np.zeros(4),
        np.zeros(4),
        [budget],
    )
    estimate = estimate_fleet_size(problem, (1, 2))
    assert estimate.value == pytest.approx(10.0 / (budget - 30.0))
    assert estimate.size == size


def test_the_paper_sends_two_at_least_unless_told_otherwise() -> None:
    problem = line([10.0, 20.0, 30.0], 1000.0)
    assert estimate_fleet_size(problem, (1, 2, 3)).size == 2
    assert estimate_fleet_size(problem, (1, 2, 3), least=1).size == 1
    assert estimate_fleet_size(problem, (1, 2, 3), least=1).value < 1.0


def test_without_nodes_one_auv_is_enough() -> None:
    estimate = estimate_fleet_size(TeamOrienteering(np.ones((2, 2)), [0, 0], [0, 0], [0.5]), ())
    assert (estimate.value, estimate.size) == (0.0, 1)


def test_different_budgets_count_by_their_mean() -> None:
    problem = line([10.0, 20.0, 30.0], 50.0)
    mixed = problem.with_budgets([45.0, 55.0])
    assert estimate_fleet_size(mixed, (1, 2, 3)) == estimate_fleet_size(problem, (1, 2, 3))


@pytest.mark.parametrize("budget", [40.0, 39.0])
def test_too_short_an_endurance_is_refused(budget: float) -> None:
    with pytest.raises(InputError, match=r"fleet.endurance.*40 s.*fleet size"):
        estimate_fleet_size(line([10.0, 20.0, 30.0], budget), (1, 2, 3))
