"""Column generation: bring the bound of the master problem down as far as it goes.

Multipliers of the master problem jump about while few routes are known. Pricing therefore works
at a point between them and the multipliers of the best bound so far (P. Wentges 1997, doi
10.1016/S0969-6016(97)00001-4). Quick pricings that keep one label for many come first; an exact one
follows when they find nothing, and gives a bound whatever the point is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock
from fiveroute.models.branch_price.duals import Cut, Duals
from fiveroute.models.branch_price.inspection import Inspector
from fiveroute.models.branch_price.master import Master
from fiveroute.models.branch_price.pricing import Priced, Pricer

__all__ = ["LOOSE", "TIGHT", "Relaxation", "generate"]

Floats = NDArray[np.float64]

LOOSE, TIGHT = 0.15, 0.02
"""Distances of bound and master objective that count as converged, as shares of the distance from
the bound to the target."""

_SMOOTHING = 0.3  # weight of the best multipliers so far
_ROUTES = 150  # routes that one pricing adds
_MANY = 20  # new routes that make another quick pricing worth while
_CLOSE = 1e-7  # relative distance of bound and master objective that counts as converged


@dataclass(frozen=True, slots=True, eq=False)
class Relaxation:
    """A bound and what proves it.

    Parameters
    ----------
    value
        Bound on the data of all plans.
    duals
        Multipliers.
    best
        Bounds on best_c, shape (C,).
    has_converged
        Whether the value is that of the master problem over all ng-routes.
    """

    value: float
    duals: Duals
    best: Floats
    has_converged: bool = False

    @classmethod
    def of(cls, pricer: Pricer | Inspector, duals: Duals, best: Floats) -> Relaxation:
        """The bound that multipliers and a pricing give."""
        return cls(duals.bound(pricer.roads.routes, best, pricer.roads.refund), duals, best)

    def with_cuts(self, cuts: Sequence[Cut]) -> Relaxation | None:
        """The same bound, new cuts having no price; None if a cut that has one is missing."""
        price = dict(zip(self.duals.cuts, self.duals.price.tolist(), strict=True))
        now = np.array([price.pop(cut, 0.0) for cut in cuts])
        if any(price.values()) or len(set(self.duals.cuts)) < len(self.duals.cuts):
            return None
        duals = replace(self.duals, cuts=tuple(cuts), price=now)
        return replace(self, duals=duals, has_converged=False)


def generate(
    master: Master,
    pricer: Pricer | Inspector,
    clock: Clock,
    *,
    start: Relaxation | None = None,
    share: float = TIGHT,
    target: Callable[[], float],
    on_bound: Callable[[float], None],
) -> Relaxation | None:
    """Add routes until none is missing, the bound is low enough, or time is up.

    Parameters
    ----------
    master, pricer
        The known routes and where others come from.
    clock
        When to stop.
    start
        A bound that holds for these routes as well, with the cuts of the master problem.
    share
        How close bound and master objective shall come, see `LOOSE` and `TIGHT`.
    target
        Tells which bound is low enough: what a better plan collects more than.
    on_bound
        Told of the bounds.

    Returns
    -------
    Relaxation or None
        The lowest bound; None if not even one was computed.
    """
    best = start
    smoothing = _SMOOTHING
    while not clock.expired:
        duals = master.solve()
        if duals is None:
            break
        if best is None:
            best = Relaxation.of(pricer, duals, pricer.walk_bound(duals))
            on_bound(best.value)
        point, added = best.duals.between(duals, smoothing), 0
        if (priced := pricer.price(point, clock, exact=False)) is not None:
            best = _lower(best, Relaxation.of(pricer, point, priced.best), on_bound)
            added = _added(master, priced, duals)
            if added >= _MANY or clock.expired:
                continue
        priced = pricer.price(point, clock)
        if priced is None:
            break
        best = _lower(best, Relaxation.of(pricer, point, priced.best), on_bound)
        rest = max(_CLOSE * abs(best.value), share * (best.value - target()))
        if priced.is_exact and best.value - master.objective <= rest:
            return replace(best, has_converged=True)
        if best.value <= target():
            break
        if added + _added(master, priced, duals) > 0:
            smoothing = _SMOOTHING
        elif not priced.is_exact or smoothing == 0.0:
            break
        else:
            smoothing = 0.0
    return best


def _lower(best: Relaxation, other: Relaxation, on_bound: Callable[[float], None]) -> Relaxation:
    """The lower of two bounds; `on_bound` is told where it is the other one."""
    if other.value >= best.value:
        return best
    on_bound(other.value)
    return other


def _added(master: Master, priced: Priced, duals: Duals) -> int:
    """Add routes; how many of them improve the master problem."""
    before = len(master.routes)
    master.add(priced.routes[:_ROUTES])
    least = 1e-9 * (1.0 + abs(duals.floor).max())
    return sum(master.reduced_profit(k, duals) > least for k in range(before, len(master.routes)))
