import numpy as np
import pytest

from fiveroute.heuristics.fleet.schedule import COLD, FIRST, HOT, REHEATED, ROUNDS, stage


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


def test_only_the_first_round_knows_how_hot_to_begin() -> None:
    assert stage(0.0, 7.0)[1] == 7.0
    assert stage(FIRST, 7.0)[1] == REHEATED
