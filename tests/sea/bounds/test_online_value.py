"""What an AUV that pays is worth: recursion over all routes, what is chosen, and known luck."""

from functools import cache

import numpy as np
import pytest

from fiveroute.generate import generate
from fiveroute.sea.bounds.online_value import (
    Chart,
    chart,
    expectations,
    look_ahead,
    look_behind,
    usage,
)
from fiveroute.sea.luck import Luck
from fiveroute.sea.world import World

STEPS, PRICE = 60, 3.0


@pytest.fixture(scope="module")
def few() -> World:
    return World.of(generate(nodes=5, seed=8), 1)


def worth(sea: Chart, gain: tuple[float, ...], steps: int) -> float:
    """What an AUV can expect that remembers all nodes, by the definition."""

    @cache
    def best(i: int, k: int, seen: frozenset[int]) -> float:
        if k < 0:
            return -PRICE
        most = -PRICE * float(sea.late[i, k])
        for j in set(range(1, len(gain) - 1)) - seen:
            law = sea.share[sea.begin[i, j] :][: sea.width[i, j]].tolist()
            then = k - int(sea.first[i, j])
            after = sum(p * best(j, then - x, seen | {j}) for x, p in enumerate(law) if x <= then)
            late = sum(p for x, p in enumerate(law) if x > then)
            most = max(most, gain[j] + after - PRICE * late)
        return most

    return best(0, steps, frozenset())


def test_with_the_memory_of_all_nodes_it_is_what_the_definition_says(few: World) -> None:
    gain = few.problem.profit
    expected = worth(chart(few, STEPS, 1), tuple(gain.tolist()), STEPS)
    values = []
    for memory in (0, 2, 4):
        sea = chart(few, STEPS, memory)
        value, choice = sea.new_values()
        look_ahead(sea, gain, PRICE, value, choice)
        values.append(value[0, -1, 0])
    assert values[2] == pytest.approx(expected, abs=1e-9)
    assert values[0] >= values[1] - 1e-9 >= values[2] - 2e-9


def test_laws_keep_their_means_but_for_rounding_down(world: World) -> None:
    steps = 900
    sea = chart(world, steps, 0)
    step = float(world.problem.allowed[0]) / steps
    real = np.mean([Luck(world.law, 5, run).matrix() for run in range(2000)], axis=0)
    for i, j in ((0, 3), (4, 9), (20, 1)):
        law = sea.share[sea.begin[i, j] :][: sea.width[i, j]]
        assert law.sum() == pytest.approx(1.0, abs=1e-9)
        mean = float(law @ (sea.first[i, j] + np.arange(len(law)))) * step
        taken = real[i, j] + world.problem.service[j]
        assert mean == pytest.approx(taken - 0.5 * step, rel=0.03)


def test_usage_is_what_the_value_is_made_of(world: World) -> None:
    gain = 0.4 * world.problem.profit
    sea = chart(world, 300, 2)
    value, choice = sea.new_values()
    look_ahead(sea, gain, PRICE, value, choice)
    visits, late = usage(sea, choice)
    assert 0.0 < late < 0.1
    assert visits @ gain - PRICE * late == pytest.approx(value[0, -1, 0], abs=1e-6)


def test_who_pays_for_his_luck_gains_nothing_by_knowing_it(world: World) -> None:
    gain = 0.4 * world.problem.profit
    sea = chart(world, 300, 2)
    value, choice = sea.new_values()
    look_ahead(sea, gain, PRICE, value, choice)
    expected = expectations(sea, gain, PRICE, value, np.inf)
    for run in range(3):
        legs = np.maximum(Luck(world.law, 1, run).matrix() / 60.0, 1.0).astype(np.int64)
        best, way = sea.new_values()
        look_behind(sea, legs, gain, PRICE, value, expected, best, way)
        assert best[0, -1, 0] == pytest.approx(value[0, -1, 0], abs=1e-9)
