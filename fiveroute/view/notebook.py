"""A plan as a cell of a notebook shows it: a small map and a table of its AUVs; a mission, too.

Plain SVG and HTML without styles, scripts or references; all text is escaped.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from fiveroute.colours import COLOURS
from fiveroute.formats.plan_file import PlanFile
from fiveroute.instance import Currents, Instance, Polygon
from fiveroute.paths.thinning import thinned
from fiveroute.result import optimality_gap
from fiveroute.words import clock, counted

__all__ = ["mission_html", "no_plan_html", "plan_html", "runs_html"]

Floats = NDArray[np.float64]

_COLOURS = (*COLOURS[:-1], "#888888")  # a notebook may be dark
_LAND = "#d9cdb4"
_SIDE, _RIM = 360.0, 12.0
_MOST_NODES, _MOST_ROWS = 2000, 50


def plan_html(plan: PlanFile) -> str:
    """The plan as HTML.

    Parameters
    ----------
    plan
        The plan.
    """
    gap = optimality_gap(plan.objective, plan.bound)
    figures = [f"{plan.objective:.6g} collected", str(plan.status)]
    if gap is not None:
        figures.append(f"bound {plan.bound:.6g}, gap {gap:.2%}")
    rows = "".join(_rows(plan))
    head = "<tr><th>AUV</th><th>nodes</th><th>time, s</th><th>route</th></tr>"
    return (
        f"<div><b>{escape(plan.instance.name)}</b>: {escape(', '.join(figures))}<br>"
        f"{_map(plan.instance, _ways(plan), plan.routes)}<table>{head}{rows}</table></div>"
    )


def no_plan_html(name: str, status: str) -> str:
    """What is to be said of a mission without a plan."""
    return f"<div><b>{escape(name)}</b>: {escape(status)}</div>"


def runs_html(plan: PlanFile, lines: Sequence[str]) -> str:
    """What became of a plan, in lines, and its map.

    Parameters
    ----------
    plan
        The plan that the fleet set out with.
    lines
        What became of it, the first a title.
    """
    title, *told = (escape(line) for line in lines)
    return (
        f"<div><b>{title}</b><pre>{chr(10).join(told)}</pre>"
        f"{_map(plan.instance, _ways(plan), plan.routes)}</div>"
    )


def mission_html(mission: Instance) -> str:
    """What a mission holds, in a line, and a small map.

    Parameters
    ----------
    mission
        The mission.
    """
    fleet, ocean = mission.fleet, mission.ocean
    endurance = fleet.endurance if isinstance(fleet.endurance, tuple) else (fleet.endurance,)
    size = mission.fleet_size
    figures = [
        counted(len(mission.nodes), "node"),
        f"data {mission.total_data:.6g}",
        "AUVs to be estimated" if size is None else counted(size, "AUV"),
        f"{fleet.speed:g} m/s",
        ", ".join("unlimited" if each is None else clock(each) for each in endurance),
    ]
    if ocean.currents != Currents():
        figures.append("currents")
    if ocean.obstacles or ocean.land:
        figures.append(counted(len(ocean.obstacles) + len(ocean.land), "zone"))
    return (
        f"<div><b>{escape(mission.name)}</b>: {escape(', '.join(figures))}<br>"
        f"{_map(mission, (), ())}</div>"
    )


def _rows(plan: PlanFile) -> Iterator[str]:
    for auv, (route, duration) in enumerate(zip(plan.routes, plan.durations, strict=True)):
        if auv == _MOST_ROWS:
            yield f"<tr><td>and {len(plan.routes) - auv} more</td></tr>"
            return
        colour = _COLOURS[auv % len(_COLOURS)]
        mark = f'<svg width="12" height="8"><rect width="12" height="8" fill="{colour}"/></svg>'
        cells = [f"{mark} {auv + 1}", str(len(route)), f"{duration:.0f}", _shortened(route)]
        yield f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"


def _shortened(route: tuple[str, ...], most: int = 12) -> str:
    names = [*route[:most], *(["..."] if len(route) > most else [])]
    return escape(" ".join(name[:24] for name in names))


def _ways(plan: PlanFile) -> list[Floats]:
    """Where every AUV goes, in metres: along its paths, or straight from node to node."""
    if plan.tracks is not None:
        return [np.concatenate(legs) for legs in plan.tracks]
    points = plan.instance.points
    known = {node.id: k for k, node in enumerate(plan.instance.nodes, start=1)}
    ways = [[known[name] for name in route if name in known] for route in plan.routes]
    return [points[[0, *way, len(points) - 1]] for way in ways]


def _map(mission: Instance, ways: Sequence[Floats], routes: Sequence[Sequence[str]]) -> str:
    """Zones, routes as lines, nodes as circles, start and destination in black."""
    points = np.concatenate([mission.points, *ways])
    low, spans = points.min(axis=0), np.ptp(points, axis=0)
    scale = (_SIDE - 2.0 * _RIM) / max(float(spans.max()), 1e-12)
    width, height = (2.0 * _RIM + scale * span for span in spans)

    def spots(places: Floats) -> list[str]:
        x, y = (_RIM + scale * (places - low)).T
        return [f"{a:.1f},{b:.1f}" for a, b in zip(x, height - y, strict=True)]

    parts = []
    for zone in (*mission.ocean.land, *mission.ocean.obstacles):
        if isinstance(zone, Polygon):
            corners = " ".join(spots(thinned(np.array(zone.polygon), 0.3 / scale)))
            parts.append(f'<polygon points="{corners}" fill="{_LAND}"/>')
        else:
            x, y = spots(np.array([(zone.x, zone.y)]))[0].split(",")
            radius = f"{scale * zone.radius:.1f}"
            parts.append(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{_LAND}"/>')
    for auv, way in enumerate(ways):
        line = " ".join(spots(thinned(way, 0.3 / scale)))
        colour = _COLOURS[auv % len(_COLOURS)]
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
    visited = {name for route in routes for name in route}
    places = [spot.split(",") for spot in spots(mission.points)]
    for node, (x, y) in zip(mission.nodes[:_MOST_NODES], places[1:], strict=False):
        colour = "#333333" if node.id in visited or not routes else "#bbbbbb"
        parts.append(f'<circle cx="{x}" cy="{y}" r="3" fill="{colour}"/>')
    parts += [
        f'<circle cx="{x}" cy="{y}" r="5" stroke="#888888"/>' for x, y in (places[0], places[-1])
    ]
    return f'<svg width="{width:.0f}" height="{height:.0f}">{"".join(parts)}</svg>'
