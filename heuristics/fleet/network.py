"""The problem as the kernels of the fleet search see it.

The k nodes that some AUV has time for are stops 0 to k - 1. AUV m has a pair of end stops
of its own, k + m at the start and k + M + m at the destination, so that every node on a
route has a stop before and a stop behind it and no kernel treats the ends of a route
specially. Half of a service time goes into every leg that meets its node,

    leg_ij = t_ij + (t_i + t_j) / 2,

so that the legs of a route add up to its duration (the ends have no service), and legs
are symmetric where times are. leg_ii is minus infinity: going by way of a stop next to
itself then costs infinitely much, which keeps nodes from being put before a start or
behind a destination.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.problem import TeamOrienteering
from fiveroute.routes import Plan

__all__ = ["Floats", "Ints", "Network", "Trail", "build_network", "part_of", "trails_in"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

Trail = tuple[int, ...]
"""A route by the numbers of its nodes in the network."""

_ROUNDING = 1e-12
"""Share of a budget by which kernels stay below it: legs add up in another order than in
`TeamOrienteering.duration`, and its verdict is the one that counts."""


class Network(NamedTuple):
    """Stops, legs and limits; K = k + 2M stops in all.

    Parameters
    ----------
    nodes
        Vertex of the problem for each of the k nodes, shape (k,).
    leg
        Leg times in seconds with half the services at both sides, shape (K, K).
    back
        Its transpose, contiguous as well (`leg` itself where times are symmetric).
    profit
        Data of the nodes, shape (k,).
    limit
        Longest duration of every AUV in seconds, shape (M,).
    near
        Stops nearest to every node in either direction, nearest first, shape (k, K').
    """

    nodes: Ints
    leg: Floats
    back: Floats
    profit: Floats
    limit: Floats
    near: Ints


def build_network(problem: TeamOrienteering, reach: int) -> Network:
    """Number the stops, fold the services into the legs, and look up near stops.

    Parameters
    ----------
    problem
        The problem.
    reach
        Number of near nodes to list for every node, besides the ends.
    """
    nodes = _side_by_side(problem, np.flatnonzero(_in_time(problem)[1:-1]) + 1)
    fleet_size = problem.fleet_size
    vertices = np.concatenate(
        [nodes, np.zeros(fleet_size, np.int64), np.full(fleet_size, problem.destination)]
    )
    half = problem.service[vertices] / 2.0
    leg = problem.travel[np.ix_(vertices, vertices)]
    leg += half[:, None]
    leg += half
    np.fill_diagonal(leg, -np.inf)
    back = leg if problem.is_symmetric else np.ascontiguousarray(leg.T)
    return Network(
        nodes=nodes,
        leg=leg,
        back=back,
        profit=problem.profit[nodes],
        limit=problem.allowed - _ROUNDING * np.maximum(1.0, problem.budgets),
        near=_nearest(leg, back, len(nodes), min(reach, len(nodes) - 1) + 2 * fleet_size),
    )


def part_of(network: Network, nodes: Ints, auvs: Ints) -> Network:
    """The network of some of its nodes and AUVs, with as many near nodes."""
    size, fleet_size = len(network.nodes), len(network.limit)
    stops = np.concatenate([nodes, size + auvs, size + fleet_size + auvs])
    leg = network.leg[np.ix_(stops, stops)]
    back = leg if network.back is network.leg else np.ascontiguousarray(leg.T)
    reach = network.near.shape[1] - 2 * fleet_size
    return Network(
        nodes=network.nodes[nodes],
        leg=leg,
        back=back,
        profit=network.profit[nodes],
        limit=network.limit[auvs],
        near=_nearest(leg, back, len(nodes), min(reach, len(nodes) - 1) + 2 * len(auvs)),
    )


def trails_in(network: Network, plan: Plan) -> list[Trail]:
    """The routes of a plan; nodes that are not in the network are left out."""
    stop_of = {vertex: stop for stop, vertex in enumerate(network.nodes.tolist())}
    return [
        tuple(stop_of[vertex] for vertex in route if vertex in stop_of) for route in plan.routes
    ]


def _side_by_side(problem: TeamOrienteering, nodes: Ints) -> Ints:
    """The nodes in the order of a walk to the nearest of the rest.

    What lies together in space then lies together in memory, where thousands of nodes
    have more legs than the processor's cache can hold.
    """
    waiting = np.full(problem.n + 2, np.inf)
    waiting[nodes] = 0.0
    walk, here = np.empty_like(nodes), 0
    for step in range(len(nodes)):
        here = int((problem.travel[here] + waiting).argmin())
        waiting[here] = np.inf
        walk[step] = here
    return walk


def _in_time(problem: TeamOrienteering) -> NDArray[np.bool_]:
    """Vertices that the AUV with most time can visit, were it only for them."""
    there = _fastest(problem.travel, problem.service, 0)
    onward = _fastest(problem.travel.T, problem.service, problem.destination)
    in_time: NDArray[np.bool_] = there + onward - problem.service <= problem.allowed.max() * (
        1.0 + _ROUNDING
    )
    return in_time


def _fastest(travel: Floats, service: Floats, origin: int) -> Floats:
    """Least time from the origin to every vertex, its service included (Dijkstra)."""
    time = np.full(len(travel), np.inf)
    time[origin] = 0.0
    waiting = time.copy()
    for _ in range(len(travel)):
        vertex = int(waiting.argmin())
        waiting[vertex] = np.inf
        arrival = time[vertex] + travel[vertex] + service
        sooner = arrival < time
        time[sooner] = waiting[sooner] = arrival[sooner]
    return time


def _nearest(leg: Floats, back: Floats, size: int, count: int) -> Ints:
    """The `count` stops nearest to each of the first `size` stops, block by block."""
    near = np.empty((size, count), np.int64)
    for first in range(0, size, 256):
        rows = np.arange(first, min(first + 256, size))
        distance = np.minimum(leg[rows], back[rows])
        distance[rows - first, rows] = np.inf
        chosen = np.argpartition(distance, count - 1, axis=1)[:, :count]
        ranks = np.argsort(np.take_along_axis(distance, chosen, axis=1), axis=1, kind="stable")
        near[rows] = np.take_along_axis(chosen, ranks, axis=1)
    return near
