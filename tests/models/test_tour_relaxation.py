"""The relaxation's certified figures: bounds, infeasibility, trials."""

import itertools

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.highs import Outcome
from fiveroute.models.tour_cuts import Cut
from fiveroute.models.tour_relaxation import Links, TourRelaxation

SQUARE = {(0, 1): 1.0, (0, 2): 5.0, (0, 3): 5.0, (1, 2): 1.0, (1, 3): 5.0, (2, 3): 1.0}
"""Four stops in a row; node 3 is next to the destination 4."""


def row_of_three(symmetric: bool) -> Links:
    ends = dict(SQUARE)
    if not symmetric:
        ends |= {(j, i): time for (i, j), time in SQUARE.items() if i > 0}
    ends |= {(1, 4): 5.0, (2, 4): 5.0, (3, 4): 1.0}
    tails, heads = np.array(list(ends)).T
    return Links(tails, heads, np.array(list(ends.values())), 3, symmetric)


def started(links: Links) -> TourRelaxation:
    relaxation = TourRelaxation(links, Limits().start())
    assert relaxation.solve() is Outcome.OPTIMAL
    return relaxation


@pytest.mark.parametrize("symmetric", [True, False])
def test_degrees_alone_suffice_for_a_row(symmetric: bool) -> None:
    relaxation = started(row_of_three(symmetric))
    bound, reduced = relaxation.certify()
    assert bound == pytest.approx(4.0)
    used = relaxation.values > 0.5
    chain = {(0, 1), (1, 2), (2, 3), (3, 4)}
    links = relaxation.links
    assert set(zip(links.tails[used].tolist(), links.heads[used].tolist(), strict=True)) == chain
    assert (reduced[used] <= 1e-9).all()


def test_reduced_costs_bound_what_a_link_costs() -> None:
    relaxation = started(row_of_three(symmetric=True))
    bound, reduced = relaxation.certify()
    links = relaxation.links
    for place in range(len(links)):
        through = min(
            length(links, route)
            for route in itertools.permutations((1, 2, 3))
            if place in set(places(links, route))
        )
        assert through >= bound + reduced[place] - 1e-9


def places(links: Links, route: tuple[int, ...]) -> list[int]:
    where = {
        frozenset(ends): place
        for place, ends in enumerate(zip(links.tails.tolist(), links.heads.tolist(), strict=True))
    }
    return [where[frozenset(leg)] for leg in itertools.pairwise((0, *route, links.nodes + 1))]


def length(links: Links, route: tuple[int, ...]) -> float:
    return float(links.times[places(links, route)].sum())


def test_the_bound_holds_for_the_range_in_force() -> None:
    relaxation = started(row_of_three(symmetric=True))
    lower, upper = np.zeros(9), np.ones(9)
    upper[3] = 0.0  # not from 1 to 2
    relaxation.restrict(lower, upper)
    assert relaxation.solve() is Outcome.OPTIMAL
    bound, _ = relaxation.certify()
    best = min(
        length(relaxation.links, route)
        for route in itertools.permutations((1, 2, 3))
        if 3 not in places(relaxation.links, route)
    )
    assert 4.0 < bound <= best + 1e-9


def test_a_trial_leaves_no_trace() -> None:
    relaxation = started(row_of_three(symmetric=True))
    before = relaxation.certify()[0]
    assert relaxation.trial(3, 0.0) > before
    assert relaxation.trial(3, 1.0) == pytest.approx(before)
    assert relaxation.solve() is Outcome.OPTIMAL
    assert relaxation.certify()[0] == pytest.approx(before)


@pytest.mark.parametrize("symmetric", [True, False])
def test_infeasibility_is_proved(symmetric: bool) -> None:
    """Node 2 may not be used by any link."""
    links = row_of_three(symmetric)
    relaxation = started(links)
    upper = np.where((links.tails == 2) | (links.heads == 2), 0.0, 1.0)
    relaxation.restrict(np.zeros(len(links)), upper)
    assert relaxation.solve() is Outcome.INFEASIBLE
    assert relaxation.proves_infeasibility()


def test_a_feasible_one_is_not_disproved() -> None:
    assert not started(row_of_three(symmetric=True)).proves_infeasibility()


def test_cuts_and_dropped_links() -> None:
    """The link 1 - 2 is forbidden by a cut, then the links to both ends of node 1 are dropped."""
    relaxation = started(row_of_three(symmetric=True))
    relaxation.add([Cut(np.array([3]), np.array([-1.0]), 0.0)])
    assert relaxation.solve() is Outcome.OPTIMAL
    with_cut, _ = relaxation.certify()
    assert with_cut > 4.0
    relaxation.keep(np.array([0, 1, 2, 4, 5, 6, 7, 8]))
    assert len(relaxation.links) == 8
    assert relaxation.solve() is Outcome.OPTIMAL
    assert relaxation.certify()[0] == pytest.approx(with_cut)
