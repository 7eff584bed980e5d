"""Column generation: bring the bound of the master problem down as far as it goes.

Multipliers of the master problem jump about while few routes are known. Pricing therefore works
at a point between them and the multipliers of the best bound so far (P. Wentges 1997, doi
10.1016/S0969-6016(97)00001-4). Quick pricings that keep one label for many come first; an exact one
follows when they find nothing, and gives a bound whatever the point is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock
from fiveroute.models.branch_price.inspection import Inspector
from fiveroute.models.branch_price.master import Master
from fiveroute.models.branch_price.pricing import Duals, Priced, Pricer

__all__ = ["Relaxation", "generate"]

Floats = NDArray[np.float64]

_SMOOTHING = 0.3  # weight of the best multipliers so far
_ROUTES = 150  # routes that one pricing adds
_CLOSE = 1e-7  # relative distance of bound and master objective that counts as converged
_SHARE = 0.02  # or this share of the distance to the target


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


def generate(
    master: Master,
    pricer: Pricer | Inspector,
    clock: Clock,
    *,
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
    target
        Tells which bound is low enough: what a better plan collects more than.
    on_bound
        Told of the bounds.

    Returns
    -------
    Relaxation or None
        The lowest bound; None if not even one was computed.
    """
    best: Relaxation | None = None
    smoothing, quick = _SMOOTHING, True
    while not clock.expired:
        duals = master.solve()
        if duals is None:
            break
        if best is None:
            best = Relaxation.of(pricer, duals, pricer.walk_bound(duals))
            on_bound(best.value)
        point = best.duals.between(duals, smoothing)
        if quick:
            priced = pricer.price(point, clock, exact=False)
            if priced is not None:
                relaxation = Relaxation.of(pricer, point, priced.best)
                if relaxation.value < best.value:
                    best = relaxation
                    on_bound(best.value)
                if _added(master, priced, duals) or clock.expired:
                    continue
        priced = pricer.price(point, clock)
        if priced is None:
            break
        relaxation = Relaxation.of(pricer, point, priced.best)
        if relaxation.value < best.value:
            best = relaxation
            on_bound(best.value)
        rest = max(_CLOSE * abs(best.value), _SHARE * (best.value - target()))
        if priced.is_exact and best.value - master.objective <= rest:
            return replace(best, has_converged=True)
        if best.value <= target():
            break
        if _added(master, priced, duals):
            smoothing = _SMOOTHING
        elif not priced.is_exact or smoothing == 0.0:
            break
        else:
            smoothing = 0.0 if smoothing < 0.1 else smoothing / 4.0
    return best


def _added(master: Master, priced: Priced, duals: Duals) -> bool:
    """Add routes; whether one of them improves the master problem."""
    before = len(master.routes)
    master.add(priced.routes[:_ROUTES])
    return any(
        master.reduced_profit(k, duals) > 1e-9 * (1.0 + abs(duals.floor).max())
        for k in range(before, len(master.routes))
    )
