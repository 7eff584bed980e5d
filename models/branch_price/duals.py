"""Multipliers of the master problem: what a route must earn, and the bound that follows from it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["Cut", "Duals"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SAFE = 1e-9  # share of the terms of a sum that its rounding errors stay far below
_IDLE = 1e-9  # price of a cut that is as good as none


@dataclass(frozen=True, slots=True)
class Cut:
    """A subset-row cut over three nodes, and the nodes at which routes remember it."""

    nodes: tuple[int, int, int]
    memory: frozenset[int]


@dataclass(frozen=True, slots=True, eq=False)
class Duals:
    """Multipliers of the master problem.

    Parameters
    ----------
    node
        pi, shape (n + 2,); 0 at both ends.
    floor
        nu_c of every class, ascending, shape (C,).
    cuts
        Subset-row cuts.
    price
        sigma, shape (len(cuts),), not negative.
    surplus
        Constant part of the bound, not negative.
    """

    node: Floats
    floor: Floats
    cuts: tuple[Cut, ...] = ()
    price: Floats = field(default_factory=lambda: np.zeros(0))
    surplus: float = 0.0

    def between(self, other: Duals, share: float) -> Duals:
        """`share` of these and the rest of others with the same cuts."""
        rest = 1.0 - share
        price = share * self.price + rest * other.price
        return replace(
            self,
            node=share * self.node + rest * other.node,
            floor=share * self.floor + rest * other.floor,
            price=np.where(price > _IDLE, price, 0.0),
            surplus=share * self.surplus + rest * other.surplus,
        )

    def at_no_floor(self) -> Duals:
        """The same multipliers, all routes being welcome."""
        return replace(self, floor=np.full(len(self.floor), -np.inf))

    def cut_masks(self) -> tuple[Ints, Ints, Floats]:
        """Cuts in bits, those of no price left out.

        Returns
        -------
        in_cut, recall : Ints
            The cuts that contain a vertex, and those that remember at it, shape (n + 2,).
        sigma : Floats
            Price of the cut of every bit.
        """
        in_cut, recall = (np.zeros(len(self.node), dtype=np.int64) for _ in range(2))
        valued = np.flatnonzero(self.price > 0.0)
        for bit, k in enumerate(valued.tolist()):
            in_cut[list(self.cuts[k].nodes)] |= 1 << bit
            recall[list(self.cuts[k].memory)] |= 1 << bit
        return in_cut, recall, self.price[valued]

    def bound(self, routes: Floats, best: Floats, refund: float = 0.0) -> float:
        """Bound on the data of all plans, rounded up.

        Parameters
        ----------
        routes
            Number of AUVs M_c of every class, shape (C,).
        best
            best_c, or bounds on it, shape (C,).
        refund
            What all routes together pay in toll at most.
        """
        if best.min() == -np.inf:  # some class has no route at all
            return -np.inf
        terms = np.concatenate([self.node, self.price, routes * best, [refund, self.surplus]])
        return float(terms.sum()) + _SAFE * float(np.abs(terms).sum())
