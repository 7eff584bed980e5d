"""The two-index time-flow model as an integer programme, and the plans in its answers.

The rows are those of `fiveroute.models.flow`, over the arcs that are still wanted. The arrival
z_ij = a_ij x_ij + (b_ij - a_ij) w_ij is held by its late share w_ij, 0 <= w_ij <= x_ij, which
takes one row an arc instead of two.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, eye_array, hstack

from fiveroute.limits import Clock
from fiveroute.models.common_divisor import common_divisor
from fiveroute.models.flow_relaxation import crossing, incidence
from fiveroute.models.highs import Outcome, Program
from fiveroute.models.legs import Leg, legs_of
from fiveroute.models.network import Network
from fiveroute.models.unreduced import UNREDUCED
from fiveroute.routes import Plan, Route

__all__ = ["FlowProgram", "Routes", "arcs_of"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_TOLERANCE = 1e-8  # of integrality and of rows, in units of 1 and of the horizon
_MARGIN = 1e-7  # by which the solver's bound may be too low, in units of the objective


@dataclass(frozen=True, slots=True)
class Routes:
    """What the arcs of an integer point make up.

    Parameters
    ----------
    routes
        Classes of AUVs and their routes.
    cycles
        Nodes of cycles apart from the start, in order.
    """

    routes: list[tuple[int, Route]]
    cycles: list[Route]


class FlowProgram:
    """The model over some arcs of a network; columns x and w of every arc, then y of every node.

    Parameters
    ----------
    network
        The network.
    arcs
        Arcs that a route may use, shape (n + 1, size).
    needed
        Nodes that must be visited, shape (size,).
    clock
        When to stop.
    on_bound
        Told bounds while a solve runs, in data.
    on_routes
        Told the routes and cycles of better points while a solve runs.
    """

    def __init__(
        self,
        network: Network,
        arcs: Booleans,
        needed: Booleans,
        clock: Clock,
        on_bound: Callable[[float], None],
        on_routes: Callable[[Routes], object],
    ) -> None:
        self.network = network
        self.tails, self.heads = np.nonzero(arcs)
        self._unit = common_divisor(network.profit) or float(network.profit.max()) or 1.0
        pairs = zip(self.tails.tolist(), self.heads.tolist(), strict=True)
        self._places = {arc: place for place, arc in enumerate(pairs)}
        self._legs = network.legs(self.tails, self.heads)
        self._early = network.earliest[self.tails] + self._legs
        self._spread = np.where(self.tails > 0, network.latest[self.heads] - self._early, 0.0)

        def tell_bound(_: float | None, bound: float | None) -> None:
            if bound is not None:
                on_bound((bound + _MARGIN) * self._unit)

        def tell_routes(values: Floats) -> None:
            on_routes(self._decode(values))

        self._program = Program(
            clock, maximise=True, on_progress=tell_bound, on_solution=tell_routes
        )
        self._add_columns(needed)
        self._add_rows()

    @property
    def bound(self) -> float:
        """What no objective of the model exceeds, with a margin for the tolerances of HiGHS."""
        return (self._program.bound + _MARGIN) * self._unit

    def solve(self, gap: float) -> Outcome:
        """Solve until the relative gap is at most `gap`."""
        self._program.require_integers(True)
        self._program.set("mip_rel_gap", gap)
        self._program.set("mip_abs_gap", 0.0)
        for option, value in UNREDUCED.items():
            self._program.set(option, value)
        self._program.set("mip_feasibility_tolerance", _TOLERANCE)
        self._program.set("primal_feasibility_tolerance", _TOLERANCE)
        return self._program.solve()

    def stop_after(self, nodes: int) -> None:
        """Limit the branch-and-bound tree of every later solve."""
        self._program.set("mip_max_nodes", nodes)

    def routes(self) -> Routes | None:
        """Routes and cycles of the last point; None where there is none."""
        return self._decode(self._program.values) if self._program.has_solution else None

    def add_sets(self, sets: Booleans, served: Integers) -> None:
        """Let rows of connectivity enter; shapes (c, n + 1) and (c,)."""
        rest = csr_array((len(sets), len(self.tails) + self.network.n))
        rows = crossing(sets, served, self.tails, self.heads)
        self._program.add_rows(hstack([rows, rest], format="csr"), 0.0, np.inf)

    def forbid(self, auv_class: int, route: Route) -> None:
        """Cut off a route that takes too long: not all of its arcs together again."""
        places = [self._places[arc] for arc in _arcs(self.network, route, auv_class)]
        row = np.zeros((1, self._program.highs.getNumCol()))
        row[0, places] = 1.0
        self._program.add_rows(csr_array(row), -np.inf, len(places) - 1.0)

    def forbid_cycle(self, cycle: Route) -> None:
        """Cut off a cycle apart from the start."""
        members = np.zeros((len(cycle), self.network.n + 1), dtype=np.bool_)
        members[:, cycle] = True
        self.add_sets(members, np.array(cycle))

    def start_from(self, plan: Plan) -> None:
        """Hand a feasible plan to the solver; all of its arcs must be wanted."""
        network, service = self.network, self.network.service
        x, w, y = np.zeros(len(self.tails)), np.zeros(len(self.tails)), np.zeros(network.n)
        for auv_class, route in _by_class(network, plan):
            arrival = 0.0
            for tail, head in _arcs(network, route, auv_class):
                place = self._places[tail, head]
                arrival += float(service[tail] + self._legs[place])
                late, spread = arrival - self._early[place], self._spread[place]
                x[place] += 1.0
                w[place] = min(max(late / spread, 0.0), 1.0) if spread > 0.0 else 0.0
        y[[node - 1 for node in plan.visited]] = 1.0
        self._program.start_from(np.concatenate([x, w, y]))

    def _decode(self, values: Floats) -> Routes:
        count = np.rint(values[: len(self.tails)]).astype(np.int64)
        used = np.repeat(np.arange(len(count)), count)
        firsts = [int(self.heads[k]) for k in used if self.tails[k] == 0]
        follower = {int(self.tails[k]): int(self.heads[k]) for k in used if self.tails[k] > 0}
        routes, cycles = [], []
        for first in firsts:
            route, end = _chain(first, follower)
            routes.append((end - self.network.n - 1, route))
        while follower:
            cycles.append(_chain(next(iter(follower)), follower)[0])
        return Routes(routes, cycles)

    def _add_columns(self, needed: Booleans) -> None:
        network, program = self.network, self._program
        inner = slice(1, network.n + 1)
        most = np.ones(len(self.tails))  # an AUV may sail straight to the destination
        direct = (self.tails == 0) & (self.heads > network.n)
        most[direct] = network.routes[self.heads[direct] - network.n - 1]
        program.add_columns(np.zeros(len(most)), 0.0, most, integer=True)
        program.add_columns(np.zeros(len(most)), 0.0, np.sign(self._spread))
        lower = needed[inner].astype(np.float64)
        program.add_columns(network.profit[inner] / self._unit, lower, 1.0, integer=True)

    def _add_rows(self) -> None:
        network, n, arcs = self.network, self.network.n, len(self.tails)
        inner, ends = slice(1, n + 1), slice(n + 1, None)
        one, horizon = np.ones(arcs), network.horizon
        into, out = (
            incidence(self.heads, one, network.size),
            incidence(self.tails, one, network.size),
        )
        departure = network.earliest[self.tails] - network.service[self.tails]
        early = incidence(self.heads, self._early, network.size) - incidence(
            self.tails, departure, network.size
        )
        late = incidence(self.heads, self._spread, network.size) - incidence(
            self.tails, self._spread, network.size
        )
        none, nodes, share = csr_array((n, arcs)), csr_array((n, n)), eye_array(arcs)
        single, several = csr_array((1, arcs + n)), csr_array((network.classes, arcs + n))
        rows = [
            (hstack([into[inner], none, -eye_array(n)]), np.zeros(n)),  # degree
            (hstack([into[inner] - out[inner], none, nodes]), np.zeros(n)),  # balance
            (hstack([out[[0]], single]), np.array([float(network.problem.fleet_size)])),  # fleet
            (hstack([into[ends], several]), network.routes),  # class
            (hstack([early[inner] / horizon, late[inner] / horizon, nodes]), np.zeros(n)),  # clock
        ]
        for matrix, equal in rows:
            self._program.add_rows(csr_array(matrix), equal, equal)
        window = hstack([-share, share, csr_array((arcs, n))])
        self._program.add_rows(csr_array(window), -np.inf, 0.0)


def arcs_of(network: Network, plan: Plan) -> Booleans:
    """Arcs that a plan uses, shape (n + 1, size)."""
    used = np.zeros((network.n + 1, network.size), dtype=np.bool_)
    for auv_class, route in _by_class(network, plan):
        used[tuple(np.array(_arcs(network, route, auv_class)).T)] = True
    return used


def _by_class(network: Network, plan: Plan) -> list[tuple[int, Route]]:
    """Classes of AUVs and their routes."""
    return [(c, plan.routes[auv]) for c, auvs in enumerate(network.members) for auv in auvs]


def _arcs(network: Network, route: Route, auv_class: int) -> list[Leg]:
    """Arcs of a route that ends in the copy of the destination of a class."""
    return legs_of(route, network.n + 1 + auv_class)


def _chain(first: int, follower: dict[int, int]) -> tuple[Route, int]:
    """Nodes from `first` on, taken out of `follower`, and the vertex where they end."""
    nodes, vertex = [], first
    while vertex in follower:
        nodes.append(vertex)
        vertex = follower.pop(vertex)
    return tuple(nodes), vertex
