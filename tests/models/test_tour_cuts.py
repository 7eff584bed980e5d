"""Cuts hold for every tour, and known fractional points violate them."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fiveroute.limits import Clock, Limits
from fiveroute.models.tour_cuts import Pairs, violated_cuts


def unlimited() -> Clock:
    return Limits().start()


def all_links(nodes: int, symmetric: bool) -> np.ndarray:
    inner = itertools.combinations if symmetric else itertools.permutations
    links = [(0, node) for node in range(1, nodes + 1)]
    links += list(inner(range(1, nodes + 1), 2))
    links += [(node, nodes + 1) for node in range(1, nodes + 1)]
    return np.array(links).T


def at(links: np.ndarray) -> dict[tuple[int, int], int]:
    """Place of every link."""
    return {(tail, head): k for k, (tail, head) in enumerate(links.T.tolist())}


def point(links: np.ndarray, *routes: tuple[int, ...], nodes: int, symmetric: bool) -> np.ndarray:
    """Mean of the incidence vectors of routes."""
    values = np.zeros(links.shape[1])
    place = at(links)
    for route in routes:
        for i, j in itertools.pairwise((0, *route, nodes + 1)):
            inside = symmetric and 0 < j < i
            values[place[(j, i) if inside else (i, j)]] += 1.0 / len(routes)
    return values


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.integers(2, 6), st.booleans())
def test_every_route_satisfies_every_cut(seed: int, nodes: int, symmetric: bool) -> None:
    """Cuts are made for random points and tried on all routes."""
    rng = np.random.default_rng(seed)
    links = all_links(nodes, symmetric)
    pairs = Pairs.of(links[0], links[1], nodes)
    kinds = rng.choice([0.0, 0.5, 1.0, rng.random()], links.shape[1], p=[0.5, 0.3, 0.1, 0.1])
    cuts = violated_cuts(pairs, kinds, unlimited())
    for cut in cuts:
        assert cut.weights @ kinds[cut.links] < cut.least
        for route in itertools.permutations(range(1, nodes + 1)):
            values = point(links, route, nodes=nodes, symmetric=symmetric)
            assert cut.weights @ values[cut.links] >= cut.least


def test_a_cycle_apart_is_cut_off() -> None:
    """Start - 1 - destination, and the triangle 2, 3, 4: one set, {2, 3, 4}."""
    links = all_links(4, symmetric=True)
    values = np.zeros(links.shape[1])
    for used in ((0, 1), (1, 5), (2, 3), (3, 4), (2, 4)):
        values[at(links)[used]] = 1.0
    (cut,) = violated_cuts(Pairs.of(links[0], links[1], 4), values, unlimited())
    outside = {tuple(link) for link in links[:, cut.links].T.tolist()}
    assert outside == {(i, j) for i in (0, 1) for j in (2, 3, 4)} | {(2, 5), (3, 5), (4, 5)}
    assert cut.least == 2.0


def test_two_triangles_of_halves_violate_a_blossom() -> None:
    """Triangles 1, 2, 3 and 4, 5, 6 of halves, joined by 1 - 4, 2 - 5 and by the depot.

    Three ones cross from a triangle; a tour crosses two or four times.
    """
    links = all_links(6, symmetric=True)
    values = np.zeros(links.shape[1])
    halves = ((1, 2), (1, 3), (2, 3), (4, 5), (4, 6), (5, 6))
    ones = ((1, 4), (2, 5), (0, 3), (6, 7))
    for share, used in ((0.5, halves), (1.0, ones)):
        for link in used:
            values[at(links)[link]] = share
    cuts = violated_cuts(Pairs.of(links[0], links[1], 6), values, unlimited())
    assert cuts
    for cut in cuts:
        assert sorted(cut.weights)[:3] == [-1.0] * 3
        assert cut.least - cut.weights @ values[cut.links] == pytest.approx(1.0)


def test_a_route_violates_nothing() -> None:
    links = all_links(6, symmetric=False)
    values = point(links, (3, 1, 6, 2, 5, 4), nodes=6, symmetric=False)
    assert violated_cuts(Pairs.of(links[0], links[1], 6), values, unlimited()) == []


def test_start_and_destination_are_one_depot() -> None:
    pairs = Pairs.of(np.array([0, 1, 1, 2]), np.array([1, 3, 2, 1]), nodes=2)
    assert pairs.ends.T.tolist() == [[0, 1], [1, 2]]
    assert pairs.total(np.array([1.0, 0.5, 0.25, 0.25])).tolist() == [1.5, 0.5]
