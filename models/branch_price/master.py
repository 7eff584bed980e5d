r"""The master problem: which routes to sail, as a linear programme over those known so far.

    max  sum_r rho_r lambda_r
    s.t. sum_r a_ir lambda_r <= 1            for every sensor node i             pi_i
         sum over r of class >= c of lambda_r <= sum_(c' >= c) M_c'   for every class c   mu_c
         sum_r floor(sum_(i in S) a_ir / 2) lambda_r <= 1     for every cut S    sigma_S
         lambda >= 0,

a_ir being how often route r visits node i. The class of a route is the first whose budget is long
enough for it, so that the second family lets every route be sailed by any AUV that can. A
route of class c costs nu_c = mu_1 + ... + mu_c. Where some AUV cannot sail straight to the
destination, every AUV needs a column, c = 1 is an equation, and slack in it is heavily fined.

Where time has a price (`fiveroute.models.branch_price.roads`), columns are worth rho_r - theta t_r,
and plans that save time by collecting little are kept out by one more row,

    sum_r rho_r lambda_r >= what is known to be collected                           tau,

whose multiplier makes every node worth (1 + tau) rho_i: `Duals.node` is pi_i - tau rho_i.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array

from fiveroute.limits import Clock
from fiveroute.models.branch_price.duals import Cut, Duals
from fiveroute.models.branch_price.roads import Roads
from fiveroute.models.highs import Outcome, Program
from fiveroute.routes import Route

__all__ = ["Master"]

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]

_FINE = 10.0  # times all data, for an AUV without a route
_SHORT_FINE = 100.0  # for what a plan collects less than the target


class Master:
    """The linear programme over known routes.

    Parameters
    ----------
    roads
        Legs, limits and AUVs.
    clock
        When to stop.
    required
        Nodes that must be visited: their rows are equations.
    target
        Tells what a better plan collects more than; only asked where there is a toll.
    """

    def __init__(
        self,
        roads: Roads,
        clock: Clock,
        required: frozenset[int] = frozenset(),
        target: Callable[[], float] = lambda: -np.inf,
    ) -> None:
        self.roads, self.required, self.target = roads, required, target
        self.routes: list[Route] = []
        self.classes: list[int] = []
        self._allowed: list[bool] = []
        self.cuts: list[Cut] = []
        self._known: set[tuple[Route, int]] = set()
        self.objective = 0.0
        self.shares = np.zeros(0)
        n, count = roads.problem.n, len(roads.limits)
        self._program = Program(clock, maximise=True)
        most = np.concatenate([np.ones(n), roads.routes[::-1].cumsum()[::-1]])
        owed = [node - 1 for node in sorted(required)] + [n] * roads.must_detour
        least = np.full(n + count, -np.inf)
        least[owed] = most[owed]
        self._program.add_rows(csr_array((n + count, 0)), least, most)
        self._program.add_rows(csr_array((1, 0)), -np.inf, np.inf)
        self._head = n + count + 1  # rows before those of the cuts
        self._first = len(owed)
        if owed:
            fine = -_FINE * max(roads.problem.total_profit, 1.0)
            entries = np.ones(len(owed)), (owed, np.arange(len(owed)))
            slack = csc_array(entries, shape=(self._head, len(owed)))
            self._program.add_columns(np.full(len(owed), fine), 0.0, np.inf, slack)
        if roads.toll:
            short = csc_array(([1.0], [n + count], [0, 1]), shape=(self._head, 1))
            self._program.add_columns([-_SHORT_FINE], 0.0, np.inf, short)
            self._first += 1

    def add(self, routes: Iterable[Route]) -> int:
        """Add the routes that are new; return how many."""
        new = []
        for route in routes:
            auv_class = self.roads.class_of(self.roads.duration(route))
            key = self._key(route), auv_class
            if auv_class == len(self.roads.limits) or key in self._known:
                continue
            self._known.add(key)
            new.append((route, auv_class))
        if new:
            self.routes += [route for route, _ in new]
            self.classes += [auv_class for _, auv_class in new]
            self._allowed += [True] * len(new)
            matrix = self._columns([route for route, _ in new], [k for _, k in new])
            worth = [self.roads.worth(route) for route, _ in new]
            self._program.add_columns(worth, 0.0, np.inf, matrix)
        return len(new)

    def _key(self, route: Route) -> Route:
        """What makes a route another column: its nodes, and with cuts their order too."""
        if self.roads.toll:
            return route
        return min(route, route[::-1]) if self.cuts else tuple(sorted(route))

    def ban(self, is_banned: Callable[[Route], bool]) -> list[int]:
        """Leave routes out from now on; return their places."""
        banned = [k for k, route in enumerate(self.routes) if self._allowed[k] and is_banned(route)]
        for k in banned:
            self._allowed[k] = False
            self._known.discard((self._key(self.routes[k]), self.classes[k]))
            self._program.highs.changeColBounds(self._first + k, 0.0, 0.0)
        return banned

    def _columns(self, routes: Sequence[Route], classes: Sequence[int]) -> csc_array:
        n = self.roads.problem.n
        rows: list[int] = []
        entries: list[float] = []
        starts = [0]
        for route, auv_class in zip(routes, classes, strict=True):
            visits: dict[int, float] = {}
            for node in route:
                visits[node - 1] = visits.get(node - 1, 0.0) + 1.0
            for c in range(auv_class + 1):
                visits[n + c] = 1.0
            if self.roads.toll:
                visits[self._head - 1] = float(self.roads.profit[list(route)].sum())
            for k, cut in enumerate(self.cuts):
                if (taken := coefficient(route, cut)) > 0:
                    visits[self._head + k] = float(taken)
            rows += visits
            entries += visits.values()
            starts.append(len(rows))
        shape = (self._head + len(self.cuts), len(routes))
        return csc_array((entries, rows, starts), shape=shape)

    def reduced_profit(self, k: int, duals: Duals) -> float:
        """What route k is worth beyond its floor."""
        visits = list(self.routes[k])
        value = self.roads.worth(self.routes[k]) - float(duals.node[visits].sum())
        paid: float = sum(
            price * coefficient(self.routes[k], cut)
            for cut, price in zip(duals.cuts, duals.price.tolist(), strict=True)
            if price > 0.0
        )
        return value - paid - float(duals.floor[self.classes[k]])

    def add_cuts(self, cuts: Sequence[Cut]) -> None:
        """Add subset-row cuts."""
        entries = [
            (k, column + self._first, float(taken))
            for k, cut in enumerate(cuts)
            for column, route in enumerate(self.routes)
            if (taken := coefficient(route, cut)) > 0
        ]
        rows, columns, values = zip(*entries, strict=True) if entries else ((), (), ())
        width = self._first + len(self.routes)
        matrix = csr_array((values, (rows, columns)), shape=(len(cuts), width))
        self._program.add_rows(matrix, -np.inf, 1.0)
        self.cuts += cuts
        self._know_anew()

    def remove_cuts(self, places: Sequence[int]) -> None:
        """Remove cuts by their places in `cuts`."""
        self._program.delete_rows([self._head + k for k in places])
        self.cuts = [cut for k, cut in enumerate(self.cuts) if k not in set(places)]
        self._know_anew()

    def _know_anew(self) -> None:
        """Tell routes apart as the present cuts do: two orders of the same nodes may differ now."""
        columns = zip(self.routes, self.classes, self._allowed, strict=True)
        self._known = {(self._key(route), k) for route, k, is_allowed in columns if is_allowed}

    def trial(self, banned: Booleans, required: frozenset[int]) -> float | None:
        """Objective over the known routes without some, with some nodes; None when stopped."""
        places = [self._first + k for k in np.flatnonzero(banned) if self._allowed[k]]
        highs = self._program.highs
        for place in places:
            highs.changeColBounds(place, 0.0, 0.0)
        for node in required:
            highs.changeRowBounds(node - 1, 1.0, 1.0)
        outcome = self._program.solve()
        value = self._program.objective + self.roads.refund
        for place in places:
            highs.changeColBounds(place, 0.0, np.inf)
        for node in required:
            highs.changeRowBounds(node - 1, -np.inf, 1.0)
        if outcome is Outcome.INFEASIBLE:
            return -np.inf
        return value if outcome is Outcome.OPTIMAL else None

    def solve(self) -> Duals | None:
        """Solve; the multipliers, or None when stopped."""
        target = self.target() if self.roads.toll else -np.inf
        self._program.highs.changeRowBounds(self._head - 1, target, np.inf)
        if self._program.solve() is not Outcome.OPTIMAL:
            return None
        n, count = self.roads.problem.n, len(self.roads.limits)
        self.objective = self._program.objective + self.roads.refund
        self.shares = self._program.values[self._first :]
        duals = self._program.row_duals
        node, floor = duals[:n].copy(), np.maximum(duals[n : n + count], 0.0)
        free = np.zeros(n, dtype=np.bool_)
        free[[i - 1 for i in self.required]] = True
        node[~free] = np.maximum(node[~free], 0.0)
        if self.roads.must_detour:
            floor[0] = duals[n]
        urge, surplus = 0.0, 0.0
        if np.isfinite(target):
            urge = max(-float(duals[n + count]), 0.0)
            surplus = urge * max(self.roads.problem.total_profit - target, 0.0)
        return Duals(
            np.pad(node, 1) - urge * self.roads.profit,
            floor.cumsum(),
            tuple(self.cuts),
            np.maximum(duals[self._head :], 0.0),
            surplus,
        )


def coefficient(route: Route, cut: Cut) -> int:
    """How often a route pays for a cut of limited memory."""
    taken, half = 0, 0
    for node in route:
        if node not in cut.memory:
            half = 0
        elif node in cut.nodes:
            taken, half = taken + half, 1 - half
    return taken
