import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.problem import TeamOrienteering

# Start, two nodes and destination; the way back is longer than the way out.
TRAVEL = [[0, 1, 4, 9], [2, 0, 1, 5], [9, 3, 0, 2], [9, 9, 9, 0]]
SERVICE = [0, 10, 20, 0]
PROFIT = [0, 0.5, 0.25, 0]


def problem(**changes: object) -> TeamOrienteering:
    parts = {"travel": TRAVEL, "service": SERVICE, "profit": PROFIT, "budgets": [40, 50]}
    return TeamOrienteering(**(parts | changes))  # type: ignore[arg-type]


def test_sizes_and_totals() -> None:
    p = problem()
    assert (p.n, p.fleet_size, p.destination) == (2, 2, 3)
    assert p.total_profit == 0.75
    assert not p.is_symmetric
    assert not p.has_equal_budgets


def test_duration_follows_the_direction_of_the_legs() -> None:
    p = problem()
    assert p.duration([]) == 9
    assert p.duration([1, 2]) == 1 + 10 + 1 + 20 + 2
    assert p.duration([2, 1]) == 4 + 20 + 3 + 10 + 5


def test_collected_sums_the_data_of_a_route() -> None:
    assert problem().collected((2,)) == 0.25
    assert problem().collected(()) == 0.0


def test_arrays_are_read_only_copies() -> None:
    travel = np.array(TRAVEL, dtype=float)
    p = problem(travel=travel)
    travel[0, 1] = 77.0
    assert p.travel[0, 1] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        p.travel[0, 1] = 5.0


def test_the_diagonal_is_ignored() -> None:
    travel = np.array(TRAVEL, dtype=float)
    np.fill_diagonal(travel, 3.0)
    assert not problem(travel=travel).travel.diagonal().any()


def test_allowed_adds_only_rounding() -> None:
    p = problem(budgets=[0.5, 1000.0])
    assert p.allowed == pytest.approx([0.5 + 1e-9, 1000.0 + 1e-6], abs=1e-15)


def test_with_budgets_changes_the_fleet_alone() -> None:
    p = problem().with_budgets([7.0])
    assert p.fleet_size == 1
    assert p.travel.tolist() == problem().travel.tolist()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"travel": [[0, 1], [1, 0], [1, 1]]}, r"travel: \(3, 2\).*square"),
        ({"travel": np.full((4, 4), -1.0)}, r"travel\[0, 1\]: -1.0.*not negative"),
        ({"profit": [0, float("nan"), 1, 0]}, r"profit\[1\]: nan.*finite"),
        ({"profit": [0, 1, 1]}, r"profit: \(3,\).*shape must be \(4,\)"),
        ({"profit": [1, 1, 1, 0]}, "start and destination have no profit"),
        ({"service": [0, 1, 1, 2]}, "start and destination have no service"),
        ({"budgets": []}, "at least one AUV"),
        ({"budgets": [float("inf")]}, r"budgets\[0\]: inf"),
    ],
)
def test_what_makes_no_sense_is_refused(changes: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        problem(**changes)


def test_no_nodes_at_all_is_a_problem_too() -> None:
    p = TeamOrienteering([[0, 3], [3, 0]], [0, 0], [0, 0], [5])
    assert (p.n, p.total_profit, p.duration(())) == (0, 0.0, 3.0)
