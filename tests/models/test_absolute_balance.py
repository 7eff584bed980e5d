"""Branch and bound over the mean: proofs, and what happens when the work runs out."""

import itertools

import numpy as np
import pytest

from fiveroute.models.absolute_balance import AbsoluteSearch


def route_like(nodes: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Times as a route through random points has them, all legs 1 on average."""
    rng = np.random.default_rng(seed)
    arrival = np.concatenate(([0.0], np.cumsum(rng.uniform(0.0, 2.0, nodes - 1))))
    enter, leave = rng.uniform(0.0, 6.0, (2, nodes))
    return enter - arrival, leave + arrival


def spread(times: np.ndarray) -> float:
    return float(np.abs(times - times.mean()).sum())


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize(("nodes", "segments"), [(12, 2), (12, 5), (10, 9)])
def test_proved_cuts_are_the_best_of_all(nodes: int, segments: int, seed: int) -> None:
    """The start is the worst cut of all."""
    enter, leave = route_like(nodes, seed)
    width = nodes - segments + 1
    cuts = [
        np.array([*ends, width - 1])
        for ends in itertools.combinations_with_replacement(range(width), segments - 1)
    ]
    searches = [AbsoluteSearch(enter, leave, ends) for ends in cuts]
    values = [search.value for search in searches]
    search = searches[int(np.argmax(values))]
    assert search.run()
    assert search.value == pytest.approx(min(values))


def test_a_hundred_nodes_are_proved() -> None:
    enter, leave = route_like(100, 1)
    ends = np.concatenate((np.arange(1, 8) * 11, [92]))
    search = AbsoluteSearch(enter, leave, ends)
    before = search.value
    assert search.run()
    assert search.value < before


def test_without_work_the_start_stays() -> None:
    enter, leave = route_like(30, 2)
    ends = np.array([3, 8, 27])
    search = AbsoluteSearch(enter, leave, ends, steps=-1)
    assert not search.run()
    assert search.ends is ends
