import numpy as np
import pytest

from fiveroute.heuristics.fleet.archipelago import (
    COLD,
    FIRST,
    HOT,
    REHEATED,
    ROUNDS,
    Archipelago,
    crew,
    stage,
)
from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan


def problem() -> TeamOrienteering:
    rng = np.random.default_rng(5)
    points = rng.uniform(0.0, 100.0, (42, 2))
    travel = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    return TeamOrienteering(travel, np.zeros(42), np.pad(rng.random(40), 1), [150.0] * 2)


def test_every_round_cools_down_from_its_own_temperature() -> None:
    parts = np.linspace(0.0, 1.0, 2001)
    rounds, temperatures, _ = zip(*map(stage, parts), strict=True)
    assert sorted(set(rounds)) == list(range(ROUNDS))
    assert list(rounds) == sorted(rounds)
    for number in range(ROUNDS):
        inside = [t for r, t in zip(rounds, temperatures, strict=True) if r == number]
        assert inside == sorted(inside, reverse=True)
        assert inside[0] == pytest.approx(HOT if number == 0 else REHEATED, rel=0.05)
        assert inside[-1] == pytest.approx(COLD, rel=0.05)


@pytest.mark.parametrize(("part", "cold"), [(0.0, False), (0.6 * FIRST, True), (1.0, True)])
def test_the_second_half_of_a_round_is_cold(part: float, cold: bool) -> None:
    assert stage(part)[2] is cold


def test_a_new_round_starts_from_combinations_and_loses_nothing() -> None:
    islands = Archipelago.around(Plan.empty(2), problem(), np.random.default_rng(1))
    with crew(2) as for_each:
        for part in np.linspace(0.0, FIRST, 30, endpoint=False):
            islands.run(200, part, for_each)
        before, known = islands.objective, len(islands.pool)
        assert before > 0.0
        assert known > 2
        islands.run(200, FIRST, for_each)
    assert islands.round == 1
    assert islands.objective >= before
