r"""The flow relaxation without directions and clock: half the size, for thousands of nodes.

With x_e the number of times that the fleet sails the edge e, c_e its time
(`fiveroute.models.symmetric_graph`) and y_j whether the node j is visited, every plan fulfils

    sum of x_e at j = 2 y_j  for every sensor node                        (degree)  u_j
    sum of x_e at start = sum of x_e at destination = M                   (ends)    u_0, u_d
    sum_e c_e x_e <= sum_m T_m                                            (budget)  lambda >= 0
    sum of x_e out of S >= 2 y_k, k in S, both ends outside               (sets)    omega_S >= 0
    sum of x_e out of S >= M, destination in S, start outside             (sets)    omega_S >= 0
    0 <= x_e <= 1, 0 <= y_j <= 1                    (x_e <= M for the direct leg)

and collects sum_j rho_j y_j. The programme begins with edges to the nearest neighbours; edges enter
when their reduced cost promises a gain, sets when they are violated. After every pricing the
multipliers give a bound by weak duality (`fiveroute.models.symmetric_duality`), so that
the relaxation may be left at any time.

References
----------
M. Fischetti, J. J. Salazar González and P. Toth, "Solving the orienteering problem through
branch-and-cut", INFORMS Journal on Computing 10 (1998), doi 10.1287/ijoc.10.2.133.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, hstack, vstack

from fiveroute.limits import Clock
from fiveroute.models.highs import Outcome, Program
from fiveroute.models.max_flow_cuts import violated_sets
from fiveroute.models.network import Network
from fiveroute.models.symmetric_duality import SymmetricMultipliers, symmetric_bound
from fiveroute.models.symmetric_graph import SymmetricGraph

__all__ = ["SymmetricRelaxation"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_NEIGHBOURS = 5  # edges from every node that are there from the start
_VIOLATION = 0.02  # least violation of a set worth a row
_SETS = 1000  # rows that one round adds at most
_EDGES_A_NODE = 2  # edges with the best reduced costs that one pricing adds
_GAIN = 1e-7  # least reduced cost of an edge worth adding, in units of the largest profit


class SymmetricRelaxation:
    """The relaxation of one network, to be tightened with `solve`.

    Attributes
    ----------
    bound
        The least upper bound found so far.
    """

    def __init__(self, network: Network, clock: Clock) -> None:
        self.network, self.bound = network, network.problem.total_profit
        self._unit = float(network.profit.max()) or 1.0
        self._graph = SymmetricGraph.of(network)
        self._direct = float(self._graph.costs(np.array([[0], [network.n + 1]]))[0])
        self._edges, self._times = np.zeros((2, 0), dtype=np.int64), np.zeros(0)
        self._sets = np.zeros((0, network.n + 2), dtype=np.bool_)
        self._served = np.zeros(0, dtype=np.int64)
        self._duals = np.zeros(network.n + 3)
        self._program = Program(clock, maximise=True)
        self._add_base()
        self._add_edges(self._graph.nearest(_NEIGHBOURS))

    def solve(self, *, tail: float = 0.0) -> bool:
        """Add rows and edges until none is missing; return whether that point was reached.

        Parameters
        ----------
        tail
            Relative gain of the objective below which no more rows are looked for, and distance
            of bound and objective below which no more edges are.
        """
        while self._cut(tail):
            objective = self._program.objective * self._unit
            if not self._price() or self.bound <= (1.0 + tail) * objective:
                return True
        self._price()
        return False

    def _cut(self, tail: float) -> bool:
        """Solve and add violated rows until there are none; False when stopped before."""
        last = np.inf
        while self._program.solve() is Outcome.OPTIMAL:
            values, objective = self._program.values, self._program.objective
            self._duals = self._program.row_duals * self._unit
            if last - objective < tail * abs(objective):
                return True
            last = objective
            if not self._add_violated(values[: self.network.n], values[self.network.n :]):
                return True
        return False

    def _price(self) -> bool:
        """Bound by weak duality, and let promising edges enter; False when there are none."""
        network, size = self.network, self.network.n + 2
        multipliers = SymmetricMultipliers.of(
            node=-self._duals[:size],
            price=float(self._duals[size]) / network.horizon,
            sets=self._sets[: len(self._duals) - size - 1],
            served=self._served[: len(self._duals) - size - 1],
            weight=-self._duals[size + 1 :],
        )
        present = csr_array((np.ones(self._edges.shape[1]), self._edges), (size, size))
        present = (present + present.T).tocsr()
        others, wanted = np.zeros(size), [np.zeros((2, 0), dtype=np.int64)]
        for vertices, times in self._graph.blocks():
            gain = multipliers.gains(vertices, times)
            gain[present[vertices].nonzero()] = -np.inf
            others[vertices] = gain.max(axis=1)
            best = np.argpartition(gain, -_EDGES_A_NODE, axis=1)[:, -_EDGES_A_NODE:]
            worth = np.take_along_axis(gain, best, axis=1) > _GAIN * self._unit
            ones = np.broadcast_to(vertices[:, None], best.shape)[worth]
            wanted.append(np.stack([ones, best[worth]]))
        inside = multipliers.gains_of(self._edges, self._times)
        inside[0] *= network.problem.fleet_size if np.isfinite(self._direct) else 0.0
        self.bound = min(self.bound, symmetric_bound(network, multipliers, inside, others))
        entering = np.concatenate(wanted, axis=1)
        self._add_edges(entering)
        return bool(entering.size)

    def _add_violated(self, visits: Floats, flow: Floats) -> bool:
        """Let violated sets enter; False when there are none."""
        n, fleet = self.network.n, float(self.network.problem.fleet_size)
        of_node, of_destination = np.zeros((2, n + 2))
        of_node[1:-1], of_destination[-1] = 2.0 * visits, fleet
        at_one = np.where(self._edges == n + 1, 0, self._edges)  # both ends of routes in one
        sets = np.concatenate(
            [
                _violated(at_one, flow, of_node),
                _violated(self._edges, flow, of_destination),
            ]
        )
        if not len(sets):
            return False
        served = np.argmax(np.where(sets, of_node + of_destination, -1.0), axis=1)
        served[sets[:, -1]] = n + 1
        rows = np.flatnonzero(served <= n)
        visited = coo_array((np.full(len(rows), -2.0), (rows, served[rows] - 1)), (len(sets), n))
        crossed = csr_array(sets[:, self._edges[0]] != sets[:, self._edges[1]], dtype=np.float64)
        lower = np.where(served <= n, 0.0, fleet)
        self._program.add_rows(hstack([visited, crossed], format="csr"), lower, np.inf)
        self._sets = np.concatenate([self._sets, sets])
        self._served = np.concatenate([self._served, served])
        return True

    def _add_base(self) -> None:
        """Degree, end and budget rows, the columns y, and the direct leg.

        Where that takes too long, it stands for a missing route, at more than all data can
        make good.
        """
        network, n, size = self.network, self.network.n, self.network.n + 2
        fleet = float(network.problem.fleet_size)
        equal = np.zeros(size)
        equal[[0, -1]] = fleet
        budget = float(network.budgets @ network.routes) / network.horizon
        self._program.add_rows(
            csr_array((size + 1, 0)), np.append(equal, -np.inf), np.append(equal, budget)
        )
        nodes = np.arange(n)
        degree = coo_array((np.full(n, -2.0), (nodes + 1, nodes)), (size + 1, n))
        profit = network.problem.profit[1:-1] / self._unit
        self._program.add_columns(profit, 0.0, 1.0, degree.tocsc())
        exists = bool(np.isfinite(self._direct))
        self._enter(
            np.array([[0], [n + 1]]),
            np.array([self._direct if exists else 0.0]),
            0.0 if exists else -n - 1.0,
            fleet,
        )

    def _add_edges(self, edges: Integers) -> None:
        """Let edges enter that are not there yet; each may be given in both directions."""
        size = self.network.n + 2
        codes = np.unique(edges.min(axis=0) * size + edges.max(axis=0))
        known = self._edges.min(axis=0) * size + self._edges.max(axis=0)
        new = np.stack(np.divmod(np.setdiff1d(codes, known), size))
        self._enter(new, self._graph.costs(new), 0.0, 1.0)

    def _enter(self, edges: Integers, times: Floats, profit: float, most: float) -> None:
        count, size = edges.shape[1], self.network.n + 2
        columns = np.arange(count)
        ends = coo_array((np.ones(2 * count), (edges.ravel(), np.tile(columns, 2))), (size, count))
        crossed = self._sets[:, edges[0]] != self._sets[:, edges[1]]
        blocks = [ends, csr_array([times / self.network.horizon]), csr_array(crossed, dtype=float)]
        matrix = vstack(blocks, format="csc")
        self._program.add_columns(np.full(count, profit), 0.0, most, matrix)
        self._edges = np.concatenate([self._edges, edges], axis=1)
        self._times = np.concatenate([self._times, times])


def _violated(edges: Integers, flow: Floats, demand: Floats) -> Booleans:
    """Sets that the edges leave less often than some vertex in them demands."""
    return violated_sets(
        np.concatenate([edges[0], edges[1]]),
        np.concatenate([edges[1], edges[0]]),
        np.tile(flow, 2),
        demand,
        tolerance=_VIOLATION,
        most=_SETS,
    )
