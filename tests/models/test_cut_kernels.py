"""Each kernel against the enumeration of all cuts, for times that are no times of a route."""

import itertools
from collections.abc import Callable

import numpy as np
import pytest

from fiveroute.models.cut_kernels import (
    cut_at_target,
    cut_below,
    cut_least_squares,
    segment_times,
)

NODES, SEGMENTS = 9, 4


def drawn(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    enter, leave = rng.normal(size=(2, NODES)) * 10.0
    return (np.round(enter), np.round(leave)) if seed % 2 else (enter, leave)


def best(enter: np.ndarray, leave: np.ndarray, value: Callable[[np.ndarray], float]) -> float:
    offsets = itertools.combinations_with_replacement(range(NODES - SEGMENTS + 1), SEGMENTS - 1)
    cuts = (np.array([*ends, NODES - SEGMENTS]) for ends in offsets)
    return min(value(segment_times(enter, leave, ends)) for ends in cuts)


@pytest.mark.parametrize("seed", range(10))
def test_least_squares_about_a_target(seed: int) -> None:
    enter, leave = drawn(seed)
    for target in (-30.0, 0.0, 7.5):
        ends = cut_at_target(enter, leave, SEGMENTS, target)
        reached = ((segment_times(enter, leave, ends) - target) ** 2).sum()
        least = best(enter - target, leave, lambda away: float((away**2).sum()))
        assert reached == pytest.approx(least)


@pytest.mark.parametrize("seed", range(10))
def test_all_below_a_limit_if_possible(seed: int) -> None:
    enter, leave = drawn(seed)
    least = best(enter, leave, np.max)
    ends = cut_below(enter, leave, SEGMENTS, least)
    assert segment_times(enter, leave, ends).max() == least
    assert len(cut_below(enter, leave, SEGMENTS, np.nextafter(least, -np.inf))) == 0


@pytest.mark.parametrize("seed", range(10))
def test_least_squares_below_a_limit(seed: int) -> None:
    enter, leave = drawn(seed)
    limit = best(enter, leave, np.max) + 2.0
    times = segment_times(enter, leave, cut_least_squares(enter, leave, SEGMENTS, limit))
    assert times.max() <= limit

    def squares(times: np.ndarray) -> float:
        return float(times @ times) if times.max() <= limit else np.inf

    assert times @ times == pytest.approx(best(enter, leave, squares))


def test_times_by_hand() -> None:
    """Nodes at 1, 2, 3 on a line from 0 and home to 0: 1 alone, then 2 and 3."""
    enter, leave = np.array([1.0, 1.0, 1.0]), np.array([1.0, 3.0, 5.0])
    assert segment_times(enter, leave, np.array([0, 1])).tolist() == [2.0, 6.0]
