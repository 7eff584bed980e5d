"""Who sails which leg when: the plan as filed, and what an event log tells of a run.

A leg is left, ends when its head is reached, and is done when the data there are collected.
Its shape is the path of the plan between the same two stops, or the straight line where the
plan has none, since a log does not tell where an AUV was between its stops.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Instance
from fiveroute.metric import Metric, distances
from fiveroute.ocean.currents import Current
from fiveroute.routes import Plan
from fiveroute.sea.events import Event

__all__ = [
    "Leg",
    "Shape",
    "Shapes",
    "leg_lengths",
    "planned_legs",
    "sailed_legs",
    "shapes_of",
    "track_of",
]

Floats = NDArray[np.float64]


class Leg(NamedTuple):
    """A leg of one AUV.

    Parameters
    ----------
    tail, head
        Vertices: 0 is the start, n + 1 the destination.
    left, reached, done
        When it left the tail, reached the head, and was done there, in seconds.
    """

    tail: int
    head: int
    left: float
    reached: float
    done: float


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """The path of a leg.

    Parameters
    ----------
    points
        Waypoints in metres, shape (k, 2).
    share
        Share of the leg's time that has passed at each of them, shape (k,).
    """

    points: Floats
    share: Floats


_ANYBODY = -1

_BLOCK = 64  # legs that are measured at once: all distances between their ends are


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """The paths of a plan.

    Parameters
    ----------
    paths
        All of them.
    places
        Where among them a path is, by AUV, tail and head.
    """

    paths: tuple[Shape, ...] = ()
    places: Mapping[tuple[int, int, int], int] = field(default_factory=dict)

    def place(self, auv: int, leg: Leg) -> int | None:
        """Where the path of an AUV's leg is: its own, or else another AUV's between these stops."""
        own = self.places.get((auv, leg.tail, leg.head))
        return self.places.get((_ANYBODY, leg.tail, leg.head)) if own is None else own


def shapes_of(plan: PlanFile, routes: Plan, current: Current | None) -> Shapes:
    """The planned paths.

    Parameters
    ----------
    plan
        The plan as filed.
    routes
        Its routes.
    current
        The current, which tells how time goes by along a path; None takes a steady pace.
    """
    shapes: list[Shape] = []
    places: dict[tuple[int, int, int], int] = {}
    ends = len(plan.instance.nodes) + 1
    for auv, (route, paths) in enumerate(zip(routes.routes, plan.tracks or (), strict=False)):
        for leg, points in zip(itertools.pairwise((0, *route, ends)), paths, strict=False):
            times = _cumulative(points, current, plan.instance.fleet.speed)
            places[auv, *leg] = len(shapes)
            places.setdefault((_ANYBODY, *leg), len(shapes))
            shapes.append(Shape(points, times / (times[-1] or 1.0)))
    return Shapes(tuple(shapes), places)


def _cumulative(points: Floats, current: Current | None, speed: float) -> Floats:
    """Seconds to each waypoint, (11) and (22), by the midpoint rule; a steady pace if it fails."""
    steps = np.diff(points, axis=0)
    lengths = np.hypot(*steps.T)
    pace = np.full(len(lengths), speed)
    if current is not None:
        east, north = steps.T / np.where(lengths > 0.0, lengths, 1.0)
        x, y = ((points[:-1] + points[1:]) / 2.0).T
        u, v = current(x, y, 0.0)
        across, along = v * east - u * north, u * east + v * north
        made_good = along + np.sqrt(np.maximum(speed**2 - across**2, 0.0))
        if (made_good[lengths > 0.0] > 0.0).all():
            pace = np.where(lengths > 0.0, made_good, speed)
    return np.concatenate([[0.0], np.cumsum(lengths / pace)])


def planned_legs(
    plan: PlanFile, routes: Plan, current: Current | None = None
) -> tuple[tuple[Leg, ...], ...]:
    """The legs of every AUV as the plan has them.

    Their travel times are stretched together so that each route takes as long as is filed:
    where its ocean is not at hand nobody knows what each leg takes.
    """
    service, points = plan.instance.service_times, plan.instance.points
    legs = []
    for auv, route in enumerate(routes.routes):
        stops = [0, *route, len(plan.instance.nodes) + 1]
        travel = _travel_times(plan, points, auv, stops, current)
        rest = max(plan.durations[auv] - float(service[stops].sum()), 0.0)
        travel *= rest / (travel.sum() or 1.0)
        legs.append(_timed(stops, travel, service))
    return tuple(legs)


def _travel_times(
    plan: PlanFile, points: Floats, auv: int, stops: Sequence[int], current: Current | None
) -> Floats:
    instance, tracks = plan.instance, plan.tracks
    if tracks is not None and len(tracks[auv]) == len(stops) - 1:
        speed = instance.fleet.speed
        return np.array([_cumulative(path, current, speed)[-1] for path in tracks[auv]])
    if instance.travel_times is not None:
        pairs = itertools.pairwise(stops)
        return np.array([instance.travel_times[tail][head] for tail, head in pairs])
    return leg_lengths(instance.metric, points[stops])


def leg_lengths(metric: Metric, points: Floats) -> Floats:
    """Distances from each point to the next.

    Parameters
    ----------
    metric
        How distances are measured.
    points
        Positions, shape (k, 2).
    """
    blocks = [points[k : k + _BLOCK + 1] for k in range(0, len(points) - 1, _BLOCK)]
    return np.concatenate([np.diagonal(distances(metric, block), 1) for block in blocks])


def _timed(stops: Sequence[int], travel: Floats, service: Floats) -> tuple[Leg, ...]:
    legs, t = [], 0.0
    for (tail, head), time in zip(itertools.pairwise(stops), travel, strict=True):
        reached = t + float(time)
        done = reached + float(service[head])
        legs.append(Leg(tail, head, t, reached, done))
        t = done
    return tuple(legs)


def sailed_legs(
    instance: Instance, fleet_size: int, events: Sequence[Event]
) -> tuple[tuple[Leg, ...], ...]:
    """The legs of every AUV in one run.

    A leg that an AUV failed on is missing: its head is not in the log.

    Parameters
    ----------
    instance
        The instance.
    fleet_size
        Number of AUVs.
    events
        What happened, in the order of time.
    """
    service = instance.service_times
    legs: list[list[Leg]] = [[] for _ in range(fleet_size)]
    for event in events:
        if event.kind not in ("collect", "arrive"):
            continue
        own = legs[event.auv]
        tail, left = (own[-1].head, own[-1].done) if own else (0, 0.0)
        head = len(instance.nodes) + 1 if event.kind == "arrive" else event.node
        if head is None:
            raise InputError("a collection needs the node that was collected", field="node")
        reached = max(event.t - float(service[head]), left)
        own.append(Leg(tail, head, left, reached, event.t))
    return tuple(tuple(own) for own in legs)


def track_of(auv: int, legs: Sequence[Leg], shapes: Shapes, points: Floats) -> Floats:
    """Positions and times along an AUV's legs: metres and seconds x, y, t, shape (k, 3)."""
    pieces = [np.array([(*points[0], 0.0)])]
    for leg in legs:
        place = shapes.place(auv, leg)
        shape = _straight(points, leg) if place is None else shapes.paths[place]
        times = leg.left + shape.share * (leg.reached - leg.left)
        pieces.append(np.column_stack([shape.points, times]))
        if leg.done > leg.reached:
            pieces.append(np.array([(*shape.points[-1], leg.done)]))
    return np.concatenate(pieces)


def _straight(points: Floats, leg: Leg) -> Shape:
    return Shape(points[[leg.tail, leg.head]], np.array([0.0, 1.0]))
