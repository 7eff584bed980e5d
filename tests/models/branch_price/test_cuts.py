"""Subset-row cuts are found where they are violated."""

import numpy as np

from fiveroute.models.branch_price.cuts import separate
from fiveroute.models.branch_price.master import coefficient


def test_the_odd_triangle_is_found() -> None:
    routes = [(1, 4, 2), (2, 3), (3, 1)]
    cuts = separate(routes, np.array([0.5, 0.5, 0.5]), 6, 5)
    assert [set(cut.nodes) for cut in cuts] == [{1, 2, 3}]
    assert cuts[0].memory == {1, 2, 3, 4}
    assert [coefficient(route, cuts[0]) for route in routes] == [1, 1, 1]


def test_whole_solutions_violate_nothing() -> None:
    assert separate([(1, 2, 3), (4, 5)], np.ones(2), 7, 5) == []
    assert separate([()], np.ones(1), 7, 5) == []


def test_every_cut_is_violated_as_it_stands() -> None:
    rng = np.random.default_rng(1)
    routes = [tuple(int(k) for k in rng.permutation(np.arange(1, 9))[:4]) for _ in range(12)]
    shares = rng.random(12)
    cuts = separate(routes, shares, 10, 10)
    assert 0 < len(cuts) <= 10
    for cut in cuts:
        paid = sum(
            share * coefficient(route, cut) for route, share in zip(routes, shares, strict=True)
        )
        assert paid > 1.0
