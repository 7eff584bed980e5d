"""Buckets of labels against a plain list of them."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.models.branch_price.buckets import (
    enter,
    is_replaced,
    new_buckets,
    priced,
    replace,
    with_room,
)

BUCKETS, HORIZON = 4, 8.0
SIGMA = np.array([0.3, 0.05])

Label = tuple[float, float, int, int]


def replaces(one: Label, other: Label, exact: bool) -> bool:
    """Whether a label is as good as another, whatever comes."""
    if one[0] > other[0] or one[1] < other[1]:
        return False
    if not exact:
        return True
    return one[2] & ~other[2] == 0 and one[1] - priced(one[3] & ~other[3], SIGMA) >= other[1]


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize("seed", range(3))
def test_replaces_as_a_list_does(seed: int, exact: bool) -> None:
    rng = np.random.default_rng(seed)
    count, nodes = 3_000, 3
    shelf = new_buckets(nodes, BUCKETS)
    kept = np.ones(count, dtype=np.int64)
    known: list[dict[int, Label]] = [{} for _ in range(nodes)]
    for number in range(count):
        node = int(rng.integers(nodes))
        t = float(rng.integers(0, 160)) / 20.0
        label = (
            t,
            t / 4.0 + float(rng.normal(0.0, 1.0)),
            int(rng.integers(64)),
            int(rng.integers(4)),
        )
        bucket = min(int(t / HORIZON * BUCKETS), BUCKETS - 1)
        looks = is_replaced(shelf, SIGMA, exact, *label, node, bucket)
        assert (looks < 0) == any(replaces(one, label, exact) for one in known[node].values())
        if looks < 0:
            kept[number] = 0
            continue
        replace(shelf, SIGMA, exact, *label, node, bucket, kept)
        worse = [k for k, one in known[node].items() if replaces(label, one, exact)]
        for k in worse:
            assert kept[k] == 0
            del known[node][k]
        shelf = with_room(shelf, 1)
        enter(shelf, node, bucket, *label, number)
        known[node][number] = label
    assert sorted(np.flatnonzero(kept).tolist()) == sorted(k for one in known for k in one)
    assert sum(map(len, known)) > 20


def test_used_blocks_are_used_again() -> None:
    shelf = new_buckets(1, 1)
    kept = np.ones(5_000, dtype=np.int64)
    for number in range(5_000):
        value = float(number)
        replace(shelf, SIGMA, True, 1.0, value, 0, 0, 0, 0, kept)
        enter(shelf, 0, 0, 1.0, value, 0, 0, number)
    assert kept.sum() == 1
    assert shelf.state[0] <= 2
