"""Bounds of column generation, from nothing and from an earlier bound."""

from __future__ import annotations

import numpy as np
import pytest

from fiveroute.limits import Limits
from fiveroute.models.branch_price.column_generation import Relaxation, generate
from fiveroute.models.branch_price.duals import Cut, Duals
from fiveroute.models.branch_price.master import Master
from fiveroute.models.branch_price.neighbourhoods import nearest
from fiveroute.models.branch_price.pricing import Pricer
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.network import Network
from fiveroute.problem import TeamOrienteering

CUTS = tuple(Cut((1, 2, k), frozenset({1, 2, k})) for k in (3, 4, 5))


def field(seed: int) -> Roads:
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0.0, 10.0, (14, 2))
    legs = np.hypot(*(xy[:, None] - xy).transpose(2, 0, 1))
    profit = np.pad(rng.uniform(0.1, 1.0, 12), 1)
    return Roads.of(Network.of(TeamOrienteering(legs, 0.0 * profit, profit, (18.0, 18.0))))


def relaxed(roads: Roads, near: np.ndarray, start: Relaxation | None = None) -> Relaxation:
    clock = Limits().start()
    master = Master(roads, clock)
    master.add([()])
    found = generate(
        master,
        Pricer(roads, near),
        clock,
        start=start,
        target=lambda: 0.0,
        on_bound=lambda _: None,
        share=0.0,
    )
    assert found is not None
    return found


@pytest.mark.parametrize("seed", range(4))
def test_a_bound_is_the_same_from_an_earlier_one(seed: int) -> None:
    """Of small neighbourhoods, whose bound is valid and seldom the same."""
    roads = field(seed)
    loose, tight = (relaxed(roads, nearest(roads, count)) for count in (2, 8))
    again = relaxed(roads, nearest(roads, 8), start=loose)
    assert tight.has_converged
    assert again.has_converged
    assert again.value == pytest.approx(tight.value, rel=1e-6)
    assert loose.value >= tight.value * (1.0 - 1e-6)


def test_a_bound_holds_with_more_cuts_but_not_without_one_that_has_a_price() -> None:
    duals = Duals(np.zeros(7), np.zeros(1), CUTS[:2], np.array([0.0, 0.5]))
    bound = Relaxation(3.0, duals, np.ones(1), has_converged=True)
    more = bound.with_cuts(CUTS[1:])
    assert more is not None
    assert more.duals.cuts == CUTS[1:]
    assert more.duals.price.tolist() == [0.5, 0.0]
    assert more.value == 3.0
    assert not more.has_converged
    assert bound.with_cuts(CUTS[:1]) is None
