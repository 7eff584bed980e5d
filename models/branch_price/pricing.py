"""The pricing problem: routes that are worth more than the AUV that sails them costs.

Given multipliers pi_i of the nodes, sigma_S of the cuts and a floor nu_c for every class c of equal
AUVs, a route r is worth

    v(r) = sum over visits of (rho_i - pi_i) - what it pays for the cuts,

and best_c is the most that any ng-route within the budget of class c is worth. The bound that
follows (`Duals.bound`) is valid for all multipliers:

    sum_i pi_i + sum_S sigma_S + sum_c M_c best_c.

A search with floors finds routes worth more than nu_c, or proves that best_c <= nu_c. One labelling
does for all classes, because a route is in time for every class whose budget is long enough.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.limits import Clock
from fiveroute.models.branch_price import labels as lb
from fiveroute.models.branch_price.buckets import new_buckets, with_room
from fiveroute.models.branch_price.completion import Completion, complete, nearest_nodes, over_legs
from fiveroute.models.branch_price.duals import Duals
from fiveroute.models.branch_price.join import join_at, labels_at
from fiveroute.models.branch_price.roads import Roads, is_mirrored
from fiveroute.routes import Route

__all__ = ["Priced", "Pricer"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Booleans = NDArray[np.bool_]

_STEPS = 500  # of the completion bounds
_MEMORY, _QUICK_MEMORY = 5, 2  # nodes that the walks of exact and of quick pricing remember
_BUCKETS = 64
_WORK = 3_000_000  # extensions and comparisons between two looks at the clock
_FIRST_LABELS = 1 << 14
_JOINS = 8  # routes kept for every node at which halves meet
_WHOLE = 40  # routes kept of those that need no joining
_BALANCE = 1.3  # ratio of labels of both halves above which the half-way point moves
_SHIFT = 0.03  # share of the horizon by which it moves


@dataclass(frozen=True, slots=True, eq=False)
class Priced:
    """What a pricing found.

    Parameters
    ----------
    routes
        Routes worth more than their floor, varied ones first; ng-routes may come back to a node.
    best
        Proven bounds on best_c, shape (C,).
    is_exact
        Whether the search ended, so that `best` is what the ng-routes attain or the floor.
    """

    routes: list[Route]
    best: Floats
    is_exact: bool


class Pricer:
    """Finds valuable routes over the roads; remembers neighbourhoods and the half-way point.

    Parameters
    ----------
    roads
        Legs and limits.
    near
        Neighbourhoods: `near[i, j]` tells whether j is in N_i, shape (n + 2, n + 2).
    """

    def __init__(self, roads: Roads, near: Booleans) -> None:
        self.roads, self.near = roads, near
        self.half = 0.5
        self.most_labels = 3_000_000
        self.labels = 0

    def price(self, duals: Duals, clock: Clock, *, exact: bool = True) -> Priced | None:
        """Search for routes; None if the clock or the room for labels ends an inexact search."""
        gain = self.roads.profit - duals.node
        graph = _graph_of(self.roads, gain, self.near, duals)
        horizon = float(self.roads.limits[-1])
        memory = _MEMORY if exact else _QUICK_MEMORY
        end = len(graph.gain) - 1
        behind = _walks(graph, 0, horizon, memory)
        walks = behind.of_routes(self.roads.limits, end)
        floor = np.nextafter(duals.floor, np.inf)
        if (walks <= floor).all():
            return Priced([], walks, True)
        if clock.expired:
            return Priced([], walks, False)
        alike = is_mirrored(graph.leg)
        ahead = behind.mirrored() if alike else _walks(graph, end, horizon, memory)
        half = (0.5 if alike else self.half) * horizon
        most_labels = min(self.most_labels, clock.work_left)
        search = _Search(graph, self.roads.limits, floor, exact, clock, most_labels)
        forward = search.start(0)
        backward = forward if alike else search.start(end)
        done = search.grow(forward, graph.leg, ahead, half)
        if done and not alike:
            done = search.grow(backward, graph.leg.T.copy(), behind, horizon - half)
        self.labels = forward.count + backward.count
        clock.spend(self.labels + len(self.roads.leg) ** 2)
        if not done:
            return Priced([], walks, False) if exact else None
        self._balance(forward.count, backward.count)
        found, routes = search.join(forward, backward, half)
        if found is None:
            return Priced(routes, walks, False)
        best = np.minimum(np.maximum.accumulate(np.maximum(found, floor)), walks)
        return Priced(routes, best if exact else walks, exact)

    def walk_bound(self, duals: Duals) -> Floats:
        """Bounds on best_c from walks alone."""
        graph = _graph_of(self.roads, self.roads.profit - duals.node, self.near, duals)
        horizon = float(self.roads.limits[-1])
        behind = _walks(graph, 0, horizon, _MEMORY)
        return behind.of_routes(self.roads.limits, len(graph.gain) - 1)

    def remembered_by_walks(self, duals: Duals) -> Booleans:
        """Nodes that the walks behind `best` remember at every vertex, shape (n + 2, n + 2)."""
        graph = _graph_of(self.roads, self.roads.profit - duals.node, self.near, duals)
        nearest = nearest_nodes(graph.leg, _MEMORY)
        near = np.zeros(self.near.shape, dtype=np.bool_)
        rows, bits = np.nonzero(nearest >= 0)
        near[graph.nodes[rows], graph.nodes[nearest[rows, bits]]] = True
        return near

    def useless_legs(self, duals: Duals, floors: Floats) -> Booleans:
        """Legs on no route that is worth more than its floor, by walks, shape (n + 2, n + 2)."""
        leg, gain, toll = self.roads.leg, self.roads.profit - duals.node, self.roads.toll
        horizon = float(self.roads.limits[-1])
        behind = complete(leg, gain, 0, horizon, _STEPS, _MEMORY, toll)
        ahead = behind.mirrored()
        if not is_mirrored(leg):
            ahead = complete(leg.T, gain, len(gain) - 1, horizon, _STEPS, _MEMORY, toll)
        useless = np.ones(leg.shape, dtype=np.bool_)
        for limit, floor in zip(self.roads.limits.tolist(), floors.tolist(), strict=True):
            most = over_legs(leg, behind.value, ahead.value, behind.step, limit, toll)
            useless &= most <= floor
        return useless

    def _balance(self, forward: int, backward: int) -> None:
        if forward > _BALANCE * backward:
            self.half = max(self.half - _SHIFT, 0.2)
        elif backward > _BALANCE * forward:
            self.half = min(self.half + _SHIFT, 0.8)


def _graph_of(roads: Roads, gain: Floats, near: Booleans, duals: Duals) -> lb.Graph:
    """The nodes worth a visit, numbered anew."""
    nodes = roads.worth_a_visit(gain)
    both = np.ix_(nodes, nodes)
    close = near[both]
    place = np.where(close, np.cumsum(close, axis=1) - 1, -1)
    members = np.full((len(nodes), max(int(close.sum(axis=1).max(initial=0)), 1)), -1)
    rows, heads = np.nonzero(close)
    members[rows, place[rows, heads]] = heads
    in_cut, recall, sigma = duals.cut_masks()
    return lb.Graph(
        nodes,
        np.ascontiguousarray(roads.leg[both]),
        gain[nodes],
        members.astype(np.int64),
        place.astype(np.int64),
        in_cut[nodes],
        recall[nodes],
        sigma,
        roads.toll,
    )


def _walks(graph: lb.Graph, origin: int, horizon: float, memory: int) -> Completion:
    """All walks from one of the ends."""
    leg = graph.leg if origin == 0 else graph.leg.T
    return complete(leg, graph.gain, origin, horizon, _STEPS, memory, graph.toll)


class _Labels:
    """The label store of one direction; it grows by doubling."""

    def __init__(self, origin: int, size: int) -> None:
        self.time, self.value = np.zeros(_FIRST_LABELS), np.zeros(_FIRST_LABELS)
        self.masks = np.zeros((_FIRST_LABELS, 2), dtype=np.int64)
        self.links = np.full((_FIRST_LABELS, 3), -1, dtype=np.int64)
        self.kept = np.zeros(_FIRST_LABELS, dtype=np.int64)
        self.buckets = new_buckets(size, _BUCKETS)
        self.waiting = np.full(_BUCKETS, -1, dtype=np.int64)
        self.state = np.array([1, 0], dtype=np.int64)
        self.links[0, lb.NODE], self.kept[0] = origin, 1
        self.waiting[0] = 0

    @property
    def count(self) -> int:
        return int(self.state[lb.COUNT])

    def make_room(self) -> None:
        size = len(self.buckets.first)
        self.buckets = with_room(self.buckets, size)
        if self.count + size <= len(self.time):
            return
        for name in ("time", "value", "masks", "links", "kept"):
            old = getattr(self, name)
            setattr(self, name, np.concatenate([old, np.zeros_like(old)]))

    def path(self, label: int) -> list[int]:
        """Nodes of a label, its own first, without the origin."""
        nodes = []
        while self.links[label, lb.PARENT] >= 0:
            nodes.append(int(self.links[label, lb.NODE]))
            label = int(self.links[label, lb.PARENT])
        return nodes


class _Search:
    """One pricing: grow both halves, join them."""

    def __init__(
        self,
        graph: lb.Graph,
        limits: Floats,
        floors: Floats,
        exact: bool,
        clock: Clock,
        most_labels: float,
    ) -> None:
        self.graph, self.limits, self.floors, self.exact = graph, limits, floors, exact
        self.clock, self.most_labels = clock, most_labels
        self.scale = max(float(np.abs(graph.gain).sum()), 1e-300)

    def start(self, origin: int) -> _Labels:
        return _Labels(origin, len(self.graph.gain))

    def grow(self, side: _Labels, leg: Floats, rest: Completion, half: float) -> bool:
        """Grow all labels up to `half`; return whether that came to an end."""
        graph = self.graph._replace(leg=leg)
        places = np.take_along_axis(graph.place, np.maximum(rest.nearest, 0), axis=1)
        places = np.where(rest.nearest >= 0, places, -1)
        while True:
            outcome = lb.extend_labels(
                graph, rest.value, places, rest.step, self.limits, self.floors, half, self.exact,
                self.scale, side.time, side.value, side.masks, side.links, side.kept,
                side.buckets, side.waiting, side.state, _WORK,
            )  # fmt: skip
            if outcome == lb.DONE:
                return True
            if self.clock.expired or side.count > self.most_labels:
                return False
            if outcome == lb.FULL:
                side.make_room()

    def join(
        self, forward: _Labels, backward: _Labels, half: float
    ) -> tuple[Floats | None, list[Route]]:
        """Highest value of every class, None when stopped; and the routes found."""
        found = np.full(len(self.limits), -np.inf)
        priced = self._whole(forward, found)
        for node, heads, tails in self._meetings(forward, backward, half):
            best, pairs = np.full(_JOINS, -np.inf), np.zeros((_JOINS, 2), dtype=np.int64)
            at = 0
            while at < len(heads):
                at = join_at(
                    node, self.graph.gain[node], 1 << int(self.graph.place[node, node]),
                    int(self.graph.in_cut[node]), self.graph.sigma, self.limits, self.floors,
                    forward.time, forward.value, forward.masks, heads, backward.time,
                    backward.value, backward.masks, tails, at, _WORK, found, best, pairs,
                )  # fmt: skip
                if self.clock.expired:
                    return None, self._routes(priced)
            for rank, k in enumerate(np.flatnonzero(best > -np.inf)[::-1]):
                head, tail = (int(label) for label in pairs[k])
                path = forward.path(head)[::-1] + backward.path(tail)[1:]
                priced.append((rank, float(best[k]), path))
        return found, self._routes(priced)

    def _whole(self, forward: _Labels, found: Floats) -> list[tuple[int, float, list[int]]]:
        """Routes that the labels from the start are by themselves."""
        target = len(self.graph.gain) - 1
        kept = forward.links[: forward.count]
        priced = []
        for label in np.flatnonzero(kept[:, lb.NODE] == target):
            auv_class = int(np.searchsorted(self.limits, forward.time[label]))
            value = float(forward.value[label])
            found[auv_class] = max(found[auv_class], value)
            if value > self.floors[auv_class]:
                priced.append((value, int(label)))
        best = sorted(priced, reverse=True)[:_WHOLE]
        return [
            (rank * _JOINS // _WHOLE, value, forward.path(label)[:0:-1])
            for rank, (value, label) in enumerate(best)
        ]

    def _meetings(
        self, forward: _Labels, backward: _Labels, half: float
    ) -> Iterator[tuple[int, Ints, Ints]]:
        """Nodes with the labels of both halves there."""
        heads = labels_at(
            forward.value, forward.time, forward.links, forward.kept, forward.count, half
        )
        tails = labels_at(
            backward.value, backward.time, backward.links, backward.kept, backward.count, -1.0
        )
        at_head, at_tail = forward.links[heads, lb.NODE], backward.links[tails, lb.NODE]
        for node in range(1, len(self.graph.gain) - 1):
            a = slice(*np.searchsorted(at_head, [node, node + 1]))
            b = slice(*np.searchsorted(at_tail, [node, node + 1]))
            if a.start < a.stop and b.start < b.stop:
                yield node, heads[a], tails[b]

    def _routes(self, priced: list[tuple[int, float, list[int]]]) -> list[Route]:
        """Routes in the numbers of the problem: the best of every node, then the second best."""
        priced.sort(key=lambda entry: (entry[0], -entry[1]))
        return [tuple(int(k) for k in self.graph.nodes[path]) for _, _, path in priced]
