"""What the page is given: scenes as one JSON document.

Long arrays are base64 of little-endian float32, int16 or bytes; everything else is plain JSON.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fiveroute
from fiveroute.instance import Circle, Instance
from fiveroute.result import optimality_gap
from fiveroute.view.chart import Chart
from fiveroute.view.event_log import RunLog
from fiveroute.view.exchanges import Exchange, exchanges
from fiveroute.view.scene import Scene
from fiveroute.view.timed_legs import Leg, Shapes, sailed_legs

__all__ = ["document_of", "embedded"]

_INT16 = 32767

_UNSAFE = str.maketrans({sign: f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"})


def embedded(document: object) -> str:
    """JSON text that can stand inside a script element: nothing in it can end the element."""
    return json.dumps(document, allow_nan=False, separators=(",", ":")).translate(_UNSAFE)


def document_of(scenes: Sequence[Scene]) -> dict[str, Any]:
    """The document of one scene, or of two to be compared."""
    return {
        "format": "fiveroute-view/1",
        "version": fiveroute.__version__,
        "scenes": [_scene(scene) for scene in scenes],
    }


def _scene(scene: Scene) -> dict[str, Any]:
    instance, plan = scene.instance, scene.plan
    total = sum(node.data for node in instance.nodes)
    return {
        "title": scene.title,
        "name": instance.name,
        "metres": instance.metric == "euclidean",
        "origin": instance.origin,
        "region": _rounded(scene.region),
        "points": _rounded(instance.points.ravel()),
        "ids": [node.id for node in instance.nodes],
        "data": _rounded([node.data for node in instance.nodes]),
        "depths": [_depth(node.depth, instance) for node in instance.nodes],
        "service": _rounded(instance.service_times[1:-1]),
        "speed": instance.fleet.speed,
        "budgets": _budgets(scene),
        "routes": [list(route) for route in scene.routes.routes],
        "durations": _rounded(plan.durations),
        "objective": plan.objective,
        "total": total,
        "bound": plan.bound,
        "gap": optimality_gap(plan.objective, plan.bound),
        "status": plan.status.value,
        "method": plan.method,
        "seed": plan.seed,
        "version": plan.version,
        "duration": scene.duration,
        "barriers": _barriers(instance),
        "chart": None if scene.chart is None else _chart(scene.chart),
        "shapes": _shapes(scene.shapes),
        "legs": _legs(scene.legs, scene.shapes),
        "runs": [_run(run, scene) for run in scene.runs],
        "notes": list(scene.notes),
    }


def _depth(stated: float | None, instance: Instance) -> float | None:
    """Metres below the surface at which a node is visited, if anybody says."""
    return instance.fleet.depth if stated is None else stated


def _budgets(scene: Scene) -> list[float] | None:
    fleet = scene.instance.fleet
    if fleet.endurance is None:
        return None
    return [fleet.endurance_of(auv) for auv in range(len(scene.routes.routes))]


def _barriers(instance: Instance) -> list[dict[str, Any]]:
    zones = [("obstacle", shape) for shape in instance.ocean.obstacles]
    zones += [("land", shape) for shape in instance.ocean.land]
    return [
        {"kind": kind, "circle": _rounded((shape.x, shape.y, shape.radius))}
        if isinstance(shape, Circle)
        else {"kind": kind, "polygon": _rounded(np.array(shape.polygon).ravel())}
        for kind, shape in zones
    ]


def _chart(chart: Chart) -> dict[str, Any]:
    fastest = chart.fastest
    scaled = np.rint(chart.uv * (_INT16 / (fastest or 1.0)))
    document = {
        "west": chart.west,
        "south": chart.south,
        "step": chart.step,
        "times": _rounded(chart.times),
        "rows": chart.uv.shape[1],
        "columns": chart.uv.shape[2],
        "fastest": fastest,
        "uv": _packed(scaled.astype("<i2")),
    }
    if chart.mask is not None:
        rows, columns = chart.mask.codes.shape
        document["mask"] = {
            "west": chart.mask.west,
            "south": chart.mask.south,
            "step": chart.mask.step,
            "rows": rows,
            "columns": columns,
            "codes": _packed(chart.mask.codes),
        }
    return document


def _shapes(shapes: Shapes) -> dict[str, Any]:
    """Waypoints of all paths, one after the other: x, y and the share of the leg's time."""
    parts = [np.column_stack([shape.points, shape.share]) for shape in shapes.paths]
    first = np.concatenate([[0], np.cumsum([len(part) for part in parts], dtype=np.int64)])
    table = np.concatenate(parts) if parts else np.zeros((0, 3))
    return {"first": first.tolist(), "points": _packed(table.astype("<f4"))}


def _legs(fleet: Sequence[Sequence[Leg]], shapes: Shapes) -> list[list[list[float]]]:
    """For every AUV: head, when the leg is left, reached and done, and its shape or -1."""
    return [[_leg(auv, leg, shapes) for leg in legs] for auv, legs in enumerate(fleet)]


def _leg(auv: int, leg: Leg, shapes: Shapes) -> list[float]:
    place = shapes.place(auv, leg)
    return [leg.head, *_rounded(leg[2:]), -1 if place is None else place]


def _run(run: RunLog, scene: Scene) -> dict[str, Any]:
    fleet_size = len(scene.routes.routes)
    legs = sailed_legs(scene.instance, fleet_size, run.events)
    talk = exchanges(run.events, fleet_size)
    places = {number: place for place, number in enumerate(talk)}
    return {
        "run": run.run,
        "legs": _legs(legs, scene.shapes),
        "tracks": None if run.tracks is None else [_packed(t.astype("<f4")) for t in run.tracks],
        "t": _rounded([event.t for event in run.events]),
        "auv": [event.auv for event in run.events],
        "kind": [event.kind for event in run.events],
        "node": [event.node or 0 for event in run.events],
        "message": [
            -1 if event.frame is None else places.get(event.frame.number, -1)
            for event in run.events
        ],
        "messages": [_exchange(exchange) for exchange in talk.values()],
    }


def _exchange(exchange: Exchange) -> dict[str, Any]:
    frame = exchange.frame
    return {
        "says": frame.says,
        "sender": frame.sender,
        "receiver": frame.receiver,
        "bits": frame.bits,
        "sent": exchange.sent,
        "heard": [[auv, *_rounded([t])] for auv, t in exchange.heard.items()],
        "lost": list(exchange.lost),
    }


def _rounded(values: Sequence[float] | NDArray[np.float64]) -> list[float]:
    """Nine digits, which is a millimetre on a thousand kilometres."""
    return [float(f"{value:.9g}") for value in values]


def _packed(array: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")
