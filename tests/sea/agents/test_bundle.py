"""Bundles and consensus together, where the worth of nodes is plain numbers."""

import itertools
from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from fiveroute.sea.agents.bundle import Bundle
from fiveroute.sea.agents.consensus import NOBODY, Beliefs


class Carrier:
    """Takes a stated number of nodes; what it has left makes the next ones worth less."""

    def __init__(self, worth: NDArray[np.float64], room: int, decay: float) -> None:
        self.values, self.room, self.decay, self.has = worth, room, decay, list[int]()

    def worth(self, nodes: Sequence[int]) -> list[float]:
        factor = self.decay ** len(self.has) if len(self.has) < self.room else 0.0
        return [factor * float(self.values[node]) for node in nodes]

    def add(self, node: int) -> None:
        self.has.append(node)

    def remove(self, node: int) -> None:
        self.has.remove(node)


def fleet(worth: NDArray[np.float64], room: int, decay: float = 1.0) -> list[Bundle]:
    size, vertices = worth.shape
    return [
        Bundle(
            Carrier(worth[m], room, decay),
            Beliefs(m, [NOBODY] * vertices, [0.0] * vertices, [0.0] * size),
        )
        for m in range(size)
    ]


def agree(bundles: list[Bundle], links: set[tuple[int, int]], rng: np.random.Generator) -> int:
    """Let all tell their beliefs over the links, in any order, until nothing changes; rounds."""
    for bundle in bundles:
        bundle.build()
    for r in range(1, 100):
        has_changed = False
        views = [bundle.beliefs.view(float(r)) for bundle in bundles]
        for k in rng.permutation(len(links)):
            sender, receiver = sorted(links)[k]
            has_changed |= bundles[receiver].hear(views[sender])
        if not has_changed:
            return r
    raise AssertionError("no consensus")


def random_links(size: int, rng: np.random.Generator) -> set[tuple[int, int]]:
    """A chain through all AUVs, and some links more."""
    chain = rng.permutation(size)
    pairs = [*itertools.pairwise(chain), *rng.integers(size, size=(size, 2))]
    return {(int(a), int(b)) for x, y in pairs if x != y for a, b in ((x, y), (y, x))}


def random_worth(rng: np.random.Generator) -> NDArray[np.float64]:
    size, nodes = int(rng.integers(1, 6)), int(rng.integers(1, 13))
    worth = np.zeros((size, nodes + 2))
    worth[:, 1:-1] = rng.random((size, nodes)) * (rng.random((size, nodes)) < 0.8)
    return worth


def test_all_come_to_believe_the_same_without_conflict() -> None:
    for seed in range(150):
        rng = np.random.default_rng(seed)
        worth = random_worth(rng)
        bundles = fleet(worth, int(rng.integers(1, 6)), float(rng.uniform(0.3, 1.0)))
        rounds = agree(bundles, random_links(len(worth), rng), rng)
        assert rounds <= worth.shape[1] * len(worth) + 1  # nodes times diameter
        believed = {tuple(bundle.beliefs.winners) for bundle in bundles}
        assert len(believed) == 1
        has = Counter(node for bundle in bundles for node in bundle.nodes)
        assert max(has.values(), default=1) == 1
        (winners,) = believed
        for m, bundle in enumerate(bundles):
            assert sorted(bundle.nodes) == [n for n, w in enumerate(winners) if w == m]


def test_the_bundles_are_worth_half_of_the_best_at_least() -> None:
    """Room for a stated number of nodes, each worth the same whenever: marginal worth diminishes,
    and the best is an assignment to as many copies of every AUV as it has room."""
    ratios = []
    for seed in range(300):
        rng = np.random.default_rng(seed)
        worth, room = random_worth(rng), int(rng.integers(1, 4))
        bundles = fleet(worth, room)
        size = len(worth)
        agree(bundles, {(a, b) for a in range(size) for b in range(size) if a != b}, rng)
        got = sum(float(worth[m, node]) for m, b in enumerate(bundles) for node in b.nodes)
        copies = np.repeat(worth, room, axis=0)
        best = float(copies[linear_sum_assignment(copies, maximize=True)].sum())
        ratios.append(got / best if best else 1.0)
    assert min(ratios) >= 0.5
    assert max(ratios) <= 1.0 + 1e-9
    assert np.mean(ratios) > 0.9


def test_who_is_outbid_gives_up_what_it_added_later() -> None:
    first, second = fleet(np.array([[0.0, 5.0, 4.0, 0.0], [0.0, 9.0, 0.0, 0.0]]), 2)
    first.build()
    second.build()
    assert first.nodes == [1, 2]
    assert first.hear(second.beliefs.view(1.0))
    assert first.nodes == [2]
    assert first.beliefs.winners[1] == 1


def test_a_bid_is_never_above_the_one_before() -> None:
    class Growing(Carrier):
        """Worth more the more it has."""

        def worth(self, nodes: Sequence[int]) -> list[float]:
            return [float(self.values[node]) * (1.0 + len(self.has)) for node in nodes]

    values = np.array([0.0, 3.0, 2.0, 2.5, 0.0])
    bundle = Bundle(Growing(values, 9, 1.0), Beliefs(0, [NOBODY] * 5, [0.0] * 5, [0.0]))
    assert bundle.build()
    bids = [bundle.beliefs.bids[node] for node in bundle.nodes]
    assert bids == sorted(bids, reverse=True)
    assert bids[0] == 3.0
