"""Linear relaxation of the giant route over a chosen set of links, in HiGHS.

    minimise    sum_l t_l x_l                                    (13), less the services
    subject to  every node is left once and entered once         (3), (5), (14)
                the start is left once, the destination entered once          (3)
                cuts, see `fiveroute.models.tour_cuts`                   (7), (8)
                0 <= x_l <= 1

Where the nodes are symmetric, a link between two of them is an undirected edge, and every
node has degree two.

What HiGHS calls optimal or infeasible it has checked to a tolerance. The answers given here
do not rest on that. For *any* row multipliers y of the right sign, weak duality gives

    sum_r y_r b_r + sum_l min over the range of x_l of (t_l - y A_l) x_l

as a lower bound, summed up anew from the multipliers that HiGHS returns. The same sum with
t = 0 is above zero for some y if and only if the relaxation is infeasible.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, vstack

from fiveroute.limits import Clock
from fiveroute.models.highs import Outcome, Program, highspy
from fiveroute.models.tour_cuts import Cut

__all__ = ["Links", "TourRelaxation"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_TRIAL = 20
"""Simplex steps of a trial solve."""


@dataclass(frozen=True, slots=True)
class Links:
    """Arcs, or edges, that a route may use.

    Parameters
    ----------
    tails, heads
        Vertices from 0 to n + 1, shape (m,).
    times
        Leg times in seconds, shape (m,).
    nodes
        Number n of nodes.
    symmetric
        Whether a link between nodes stands for both directions.
    """

    tails: Integers
    heads: Integers
    times: Floats
    nodes: int
    symmetric: bool

    def __len__(self) -> int:
        return len(self.times)

    def take(self, places: Integers) -> Links:
        """Some of the links."""
        return replace(
            self, tails=self.tails[places], heads=self.heads[places], times=self.times[places]
        )

    def degrees(self) -> tuple[csr_array, Floats]:
        """Rows and right sides of the degree equations."""
        if self.symmetric:
            rows = np.concatenate((self.tails, self.heads))
            sides = np.full(self.nodes + 2, 2.0)
            sides[[0, -1]] = 1.0
        else:  # leaving 0 to n, then entering 1 to n + 1
            rows = np.concatenate((self.tails, self.heads + self.nodes))
            sides = np.ones(2 * self.nodes + 2)
        columns = np.tile(np.arange(len(self)), 2)
        shape = (len(sides), len(self))
        return csr_array((np.ones(len(rows)), (rows, columns)), shape=shape), sides


class TourRelaxation:
    """The relaxation, which grows by cuts and is solved again and again.

    Parameters
    ----------
    links
        Its columns.
    clock
        When to stop.
    """

    def __init__(self, links: Links, clock: Clock) -> None:
        self.links = links
        self._lower, self._upper = np.zeros(len(links)), np.ones(len(links))
        self._unit = float(links.times.mean()) or 1.0
        self._rows, self._sides = links.degrees()
        self._equations = len(self._sides)
        self._program = Program(clock)
        self._program.set("primal_feasibility_tolerance", 1e-9)
        self._program.set("dual_feasibility_tolerance", 1e-9)
        self._program.add_columns(links.times / self._unit, self._lower, self._upper)
        self._program.add_rows(self._rows, self._sides, self._sides)

    def restrict(self, lower: Floats, upper: Floats) -> None:
        """Set the range of every link."""
        changed = (lower != self._lower) | (upper != self._upper)
        places = np.flatnonzero(changed).astype(np.int32)
        bounds = (np.ascontiguousarray(values[places]) for values in (lower, upper))
        self._program.highs.changeColsBounds(len(places), places, *bounds)
        self._lower, self._upper = lower.copy(), upper.copy()

    def keep(self, places: Integers) -> None:
        """Drop all links but these, which must be in ascending order."""
        gone = np.setdiff1d(np.arange(len(self.links)), places).astype(np.int32)
        self._program.highs.deleteCols(len(gone), gone)
        self.links = self.links.take(places)
        self._rows = csr_array(self._rows[:, places])
        self._lower, self._upper = self._lower[places], self._upper[places]

    def add(self, cuts: Sequence[Cut]) -> None:
        """Append cuts."""
        entries = np.concatenate([cut.weights for cut in cuts])
        columns = np.concatenate([cut.links for cut in cuts])
        starts = np.cumsum([0, *(len(cut.links) for cut in cuts)])
        rows = csr_array((entries, columns, starts), shape=(len(cuts), len(self.links)))
        least = np.array([cut.least for cut in cuts])
        self._program.add_rows(rows, least, highspy.kHighsInf)
        self._rows = csr_array(vstack((self._rows, rows)))
        self._sides = np.concatenate((self._sides, least))

    def solve(self) -> Outcome:
        """Solve from the last basis."""
        return self._program.solve()

    @property
    def values(self) -> Floats:
        """Link values of the last solve, shape (m,)."""
        return self._program.values

    def certify(self) -> tuple[float, Floats]:
        """Bound proved by the last solve's multipliers, and the reduced costs, shape (m,)."""
        return self._priced(self._program.row_duals * self._unit, self.links.times)

    def proves_infeasibility(self) -> bool:
        """Whether the last solve left multipliers that exclude every point."""
        _, exists, ray = self._program.highs.getDualRay()
        free = np.zeros(len(self.links))
        return exists and any(
            self._priced(multipliers, free)[0] > 1e-6 * np.abs(multipliers).max()
            for multipliers in (np.array(ray), -np.array(ray))
        )

    def trial(self, place: int, value: float) -> float:
        """Bound with one link fixed, after a few simplex steps; all is as before afterwards."""
        lower, upper = self._lower, self._upper
        basis = self._program.highs.getBasis()
        fixed = np.arange(len(lower)) == place
        self.restrict(np.where(fixed, value, lower), np.where(fixed, value, upper))
        self._program.set("simplex_iteration_limit", _TRIAL)
        infeasible = self._program.solve() is Outcome.INFEASIBLE
        bound = np.inf if infeasible else self.certify()[0]
        self._program.set("simplex_iteration_limit", highspy.kHighsIInf)
        self.restrict(lower, upper)
        self._program.highs.setBasis(basis)
        return bound

    def _priced(self, multipliers: Floats, times: Floats) -> tuple[float, Floats]:
        cuts = slice(self._equations, None)
        multipliers[cuts] = np.maximum(multipliers[cuts], 0.0)
        reduced = times - self._rows.T @ multipliers
        cheapest = np.where(reduced > 0.0, self._lower, self._upper)
        return float(multipliers @ self._sides + reduced @ cheapest), reduced
