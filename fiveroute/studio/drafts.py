"""What is left of a plan when its mission is edited: routes to look at until it is planned anew.

A draft keeps the order of the nodes that remain. Legs whose ends stay where they were keep their
paths, the others are straight lines; times are rough. Nobody has judged a draft: it has no bound
and can be neither saved nor exported.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import fiveroute
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Instance
from fiveroute.result import Status
from fiveroute.view.timed_legs import leg_lengths

__all__ = ["blank", "drafted"]

METHOD = "draft"

_Track = tuple[tuple[float, float], ...]


def blank(instance: Instance) -> PlanFile:
    """A mission without any route."""
    return PlanFile(
        instance,
        routes=(),
        durations=(),
        objective=0.0,
        status=Status.NO_SOLUTION,
        bound=None,
        method=METHOD,
        seed=None,
        version=fiveroute.__version__,
        paths=(),
    )


def drafted(before: PlanFile, instance: Instance, ids: Mapping[str, str]) -> PlanFile:
    """Carry a plan over to an edited mission.

    Parameters
    ----------
    before
        The plan, or an earlier draft.
    instance
        The mission now.
    ids
        What the nodes that remain are called now, by their ids in the plan.
    """
    if not before.routes:
        return blank(instance)
    size = instance.fleet_size or len(before.routes)
    kept = [tuple(ids[name] for name in route if name in ids) for route in before.routes]
    routes = (*kept, *[()] * size)[:size]
    paths = None if before.paths is None else _paths(before, instance, routes, ids)
    data = {node.id: node.data for node in instance.nodes}
    return replace(
        before,
        instance=instance,
        routes=routes,
        durations=_durations(instance, routes, paths),
        objective=sum(data[name] for route in routes for name in route),
        status=Status.NO_SOLUTION,
        bound=None,
        method=METHOD,
        seed=None,
        paths=paths,
        currents_hash=None,
    )


def _paths(
    before: PlanFile,
    instance: Instance,
    routes: Sequence[tuple[str, ...]],
    ids: Mapping[str, str],
) -> tuple[tuple[_Track, ...], ...]:
    known = {
        (ids.get(tail, tail), ids.get(head, head), path[0], path[-1]): path
        for route, paths in zip(before.routes, before.paths or (), strict=True)
        for (tail, head), path in zip(itertools.pairwise(("", *route, "")), paths, strict=False)
    }
    points = _positions(instance)

    def leg(tail: str, head: str, ends: tuple[int, int]) -> _Track:
        straight = (points[tail][ends[0]], points[head][ends[1]])
        return known.get((tail, head, *straight), straight)

    return tuple(
        tuple(leg(tail, head, (0, 1)) for tail, head in itertools.pairwise(("", *route, "")))
        for route in routes
    )


def _positions(instance: Instance) -> dict[str, tuple[tuple[float, float], tuple[float, float]]]:
    """Where a leg from a stop and one to it end; both ends of the mission are called ``""``."""
    points = {node.id: ((node.x, node.y),) * 2 for node in instance.nodes}
    start, destination = instance.start, instance.destination
    points[""] = ((start.x, start.y), (destination.x, destination.y))
    return points


def _durations(
    instance: Instance,
    routes: Sequence[tuple[str, ...]],
    paths: Sequence[Sequence[_Track]] | None,
) -> tuple[float, ...]:
    """Seconds of every route, as if the water stood still."""
    vertices = {node.id: vertex for vertex, node in enumerate(instance.nodes, start=1)}
    service, points = instance.service_times, instance.points
    durations = []
    for auv, route in enumerate(routes):
        stops = [0, *(vertices[name] for name in route), len(instance.nodes) + 1]
        if paths is None:
            legs = _still_legs(instance, points, stops)
        else:
            legs = [_length(path) / instance.fleet.speed for path in paths[auv]]
        durations.append(float(sum(legs) + service[stops].sum()))
    return tuple(durations)


def _still_legs(
    instance: Instance, points: NDArray[np.float64], stops: Sequence[int]
) -> list[float]:
    """Seconds of the legs between successive stops in still water, equation (1)."""
    if instance.travel_times is not None:
        return [instance.travel_times[tail][head] for tail, head in itertools.pairwise(stops)]
    lengths = leg_lengths(instance.metric, points[stops])
    return [float(length) / instance.fleet.speed for length in lengths]


def _length(path: _Track) -> float:
    return float(np.hypot(*np.diff(np.array(path), axis=0).T).sum())
