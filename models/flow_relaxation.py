"""The linear relaxation of the two-index flow model, by columns and rows.

    max  sum rho_j x_ij
    s.t. sum_i x_ij <= 1                                              (degree)
         balance, fleet, clock or budget, and sets as in `fiveroute.models.weak_duality`,
         sum_i x_ic = M_c for the destination's copy of every class c    (class)
         a_ij x_ij <= z_ij <= b_ij x_ij, x >= 0                       (window)

An arc x_ij with its arrival z_ij is two non-negative columns, the arc at either end of its
window, x = x^a + x^b and z = a x^a + b x^b, so that the windows need no rows.

Arcs enter the programme when their reduced cost promises a gain (it begins with the legs to and
from the nearest neighbours), rows of connectivity when they are violated (see
`fiveroute.models.max_flow_cuts`). After every pricing the multipliers give a bound by weak
duality, so that the relaxation may be left at any time.

Without the clock rows the budgets enter through their sum alone; that is quicker by far and a
little weaker.

References
----------
N. Bianchessi, R. Mansini and M. G. Speranza, "A branch-and-cut algorithm for the Team
Orienteering Problem", International Transactions in Operational Research 25 (2018),
doi 10.1111/itor.12422.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, hstack, vstack

from fiveroute.limits import Clock
from fiveroute.models.highs import Outcome, Program
from fiveroute.models.max_flow_cuts import violated_sets
from fiveroute.models.network import Network
from fiveroute.models.weak_duality import Dual, Multipliers, gains, price

__all__ = ["FlowRelaxation", "crossing", "incidence", "relax"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_GAIN = 1e-7  # least reduced cost of an arc worth adding, in units of the largest profit
_BLOCK = 64  # rows of connectivity whose dense form is in memory at once
_ARCS_A_TAIL = 4  # arcs with the best reduced costs that one pricing adds


class FlowRelaxation:
    """The relaxation of one network, to be tightened with `solve`.

    Parameters
    ----------
    network
        The network.
    clock
        When to stop.
    timed
        Whether the clock rows are there.
    arcs
        Arcs to begin with, shape (n + 1, size); None for the nearest neighbours.

    Attributes
    ----------
    dual, multipliers
        The best bound found, and what proves it.
    visits
        How often every sensor node is visited in the last point, y, shape (size,).
    tails, heads
        Arcs of the columns; an arc may have two.
    present
        The same arcs, shape (n + 1, size).
    sets, served
        Rows of connectivity, shapes (c, n + 1) and (c,).
    """

    def __init__(
        self, network: Network, clock: Clock, *, timed: bool = True, arcs: Booleans | None = None
    ) -> None:
        self.network, self.timed = network, timed
        self._unit = float(network.profit.max()) or 1.0
        self.tails, self.heads = np.zeros((2, 0), dtype=np.int64)
        self.present = np.zeros((network.n + 1, network.size), dtype=np.bool_)
        self.sets = np.zeros((0, network.n + 1), dtype=np.bool_)
        self.served = np.zeros(0, dtype=np.int64)
        self.multipliers = self._proposed = Multipliers.zero(network.n)
        self.dual = price(network, self.multipliers)
        self._degree, self.visits = np.zeros((2, network.size))
        self._program = Program(clock, maximise=True)
        self._add_base_rows()
        self._add_missing_routes()
        self.add_arcs(nearest_arcs(network) if arcs is None else arcs)

    def solve(self, *, tail: float = 0.0) -> bool:
        """Add rows and arcs until none is missing; return whether that point was reached.

        Parameters
        ----------
        tail
            Relative gain of the objective below which no more rows are looked for, and distance
            of bound and objective below which no more arcs are.
        """
        while self._cut(tail):
            objective = self._program.objective * self._unit
            if not self._price() or self.dual.value <= (1.0 + tail) * objective:
                return True
        self._price()
        return False

    def add_arcs(self, wanted: Booleans) -> None:
        """Let arcs enter; `wanted` has shape (n + 1, size)."""
        tails, heads = np.nonzero(wanted & ~self.present)
        self.present[tails, heads] = True
        early = self.network.earliest[tails] + self.network.legs(tails, heads)
        self._add_columns(tails, heads, early)
        if self.timed:
            inner = tails > 0  # a leg from the start arrives when it arrives
            self._add_columns(tails[inner], heads[inner], self.network.latest[heads[inner]])

    def add_sets(self, sets: Booleans, served: Integers) -> None:
        """Let rows of connectivity enter; shapes (c, n + 1) and (c,)."""
        self.sets = np.concatenate([self.sets, sets])
        self.served = np.concatenate([self.served, served])
        rows = crossing(sets, served, self.tails, self.heads)
        padding = csr_array((len(sets), self.network.classes))
        self._program.add_rows(hstack([padding, rows], format="csr"), 0.0, np.inf)

    def _cut(self, tail: float) -> bool:
        """Solve and add violated rows until there are none; False when stopped before."""
        last = np.inf
        while self._program.solve() is Outcome.OPTIMAL:
            flow = self._program.values[self.network.classes :]
            self._read_duals()
            self._read_visits(flow)
            objective = self._program.objective
            if last - objective < tail * abs(objective):
                return True
            last = objective
            sets = violated_sets(self.tails, self.heads, flow, self.visits)
            if not len(sets):
                return True
            served = np.argmax(np.where(sets, self.visits, -1.0), axis=1)
            self.add_sets(sets[:, : self.network.n + 1], served)
        return False

    def _price(self) -> bool:
        """Bound by weak duality, and let promising arcs enter; False when there are none."""
        best = np.full(self.network.size, -np.inf)
        wanted, many = np.zeros_like(self.present), min(_ARCS_A_TAIL, self.network.size)
        for tails, gain in gains(self.network, self._proposed):
            np.maximum(best, gain.max(axis=0), out=best)
            gain -= self._degree
            gain[self.present[tails]] = -np.inf
            kth = np.partition(gain, -many, axis=1)[:, [-many]]
            wanted[tails] = (gain >= kth) & (gain > _GAIN * self._unit)
        dual = Dual.of(self.network, self._proposed, best)
        if dual.value < self.dual.value:
            self.dual, self.multipliers = dual, self._proposed
        self.add_arcs(wanted)
        return bool(wanted.any())

    def _read_visits(self, flow: Floats) -> None:
        self.visits = np.zeros(self.network.size)
        np.add.at(self.visits, self.heads, flow)
        self.visits[self.network.n + 1 :] = 0.0  # nothing is collected at the destination

    def _read_duals(self) -> None:
        """Take the multipliers of the degree and class rows, and all others, from the solver."""
        network, n = self.network, self.network.n
        duals = self._program.row_duals * self._unit
        first = 2 * n + 1 + network.classes
        last = len(duals) - len(self.sets)
        by_time = duals[first:last] / network.horizon
        self._degree = np.concatenate([[0.0], duals[:n], duals[2 * n + 1 : first]])
        self._proposed = Multipliers(
            balance=np.concatenate([-duals[[2 * n]], duals[n : 2 * n]]),
            clock=np.concatenate([[0.0], by_time]) if self.timed else np.zeros(n + 1),
            price=0.0 if self.timed else float(by_time[0]),
            sets=self.sets,
            served=self.served,
            weight=-duals[last:],
        ).admissible()

    def _add_base_rows(self) -> None:
        """Degree, balance, fleet, class, and clock or budget rows, in this order."""
        network, n = self.network, self.network.n
        fleet = [float(network.problem.fleet_size)]
        whole = float(network.budgets @ network.routes) / network.horizon
        equal = np.concatenate([np.zeros(n), fleet, network.routes])
        last = np.zeros(n) if self.timed else np.array([whole])
        lower = np.concatenate([np.full(n, -np.inf), equal, last if self.timed else [-np.inf]])
        upper = np.concatenate([np.ones(n), equal, last])
        self._program.add_rows(csr_array((len(lower), 0)), lower, upper)

    def _add_missing_routes(self) -> None:
        """A column a class for routes that do not exist, at more than all data can make good.

        Where the direct leg fits the budget there is no need for it, and its bound is zero.
        """
        network, n = self.network, self.network.n
        needless = network.problem.travel[0, -1] <= network.budgets
        classes = np.arange(network.classes)
        rows = np.concatenate([np.full(network.classes, 2 * n), 2 * n + 1 + classes])
        matrix = coo_array(
            (np.ones(len(rows)), (rows, np.tile(classes, 2))),
            shape=(self._program.highs.getNumRow(), network.classes),
        )
        upper = np.where(needless, 0.0, network.routes)
        self._program.add_columns(-n - 1.0, 0.0, upper, matrix.tocsc())

    def _add_columns(self, tails: Integers, heads: Integers, arrivals: Floats) -> None:
        """Let arcs with a fixed arrival enter."""
        network = self.network
        inner, ends = slice(1, network.n + 1), slice(network.n + 1, None)
        legs, one = network.legs(tails, heads), np.ones(len(tails))
        into, out = incidence(heads, one, network.size), incidence(tails, one, network.size)
        blocks = [
            into[inner],  # degree
            into[inner] - out[inner],  # balance
            out[[0]],  # fleet
            into[ends],  # class
        ]
        if self.timed:
            departures = arrivals - legs - network.service[tails]
            arrive = incidence(heads, arrivals / network.horizon, network.size)
            blocks.append(
                (arrive - incidence(tails, departures / network.horizon, network.size))[inner]
            )
        else:
            blocks.append(csr_array([(legs + network.service[heads]) / network.horizon]))  # budget
        blocks.append(crossing(self.sets, self.served, tails, heads))
        cost = network.profit[heads] / self._unit
        self._program.add_columns(cost, 0.0, np.inf, vstack(blocks, format="csc"))
        self.tails = np.concatenate([self.tails, tails])
        self.heads = np.concatenate([self.heads, heads])


def relax(network: Network, clock: Clock, *, tail: float = 0.0) -> FlowRelaxation:
    """Solve without the clock rows, then with them, from the arcs and sets found before."""
    rough = FlowRelaxation(network, clock, timed=False)
    rough.solve(tail=tail)
    if clock.expired:
        return rough
    fine = FlowRelaxation(network, clock, arcs=rough.present)
    fine.add_sets(rough.sets, rough.served)
    fine.solve(tail=tail)
    return fine if fine.dual.value < rough.dual.value else rough


def nearest_arcs(network: Network, neighbours: int = 8) -> Booleans:
    """All usable arcs from the start and to the destination, and those between neighbours."""
    tails = np.arange(network.n + 1)
    usable = network.usable(tails)
    near = np.zeros_like(usable)
    near[0], near[:, network.n + 1 :] = True, True
    between = np.where(usable, network.legs(tails[:, None], np.arange(network.size)), np.inf)
    between[:, network.n + 1 :] = np.inf
    places = np.arange(min(neighbours, network.n))
    np.put_along_axis(near, np.argsort(between, axis=1)[:, places], True, axis=1)
    np.put_along_axis(near, np.argsort(between, axis=0)[places], True, axis=0)
    return near & usable


def incidence(vertices: Integers, values: Floats, size: int) -> csr_array:
    """Values in a row a vertex and a column an arc, shape (size, arcs)."""
    shape = (size, len(vertices))
    matrix: csr_array = coo_array((values, (vertices, np.arange(len(vertices)))), shape).tocsr()
    return matrix


def crossing(sets: Booleans, served: Integers, tails: Integers, heads: Integers) -> csr_array:
    """Coefficients of arcs in rows of connectivity, shape (sets, arcs)."""
    inside = np.zeros((len(sets), max(sets.shape[1], int(heads.max(initial=0)) + 1)), np.bool_)
    inside[:, : sets.shape[1]] = sets
    rows = [csr_array((0, len(heads)))]
    for first in range(0, len(sets), _BLOCK):
        block = slice(first, first + _BLOCK)
        entering = inside[block][:, heads] & ~inside[block][:, tails]
        rows.append(csr_array(entering.astype(np.float64) - (heads == served[block, None])))
    whole: csr_array = vstack(rows, format="csr")
    return whole
