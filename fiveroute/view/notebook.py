"""A plan as a cell of a notebook shows it: a small map and a table of its AUVs.

Plain SVG and HTML without styles, scripts or references; all text is escaped.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

import numpy as np
from numpy.typing import NDArray

from fiveroute.colours import COLOURS
from fiveroute.formats.plan_file import PlanFile
from fiveroute.result import optimality_gap

__all__ = ["no_plan_html", "plan_html"]

Floats = NDArray[np.float64]

_COLOURS = (*COLOURS[:-1], "#888888")  # a notebook may be dark
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
        f"{_map(plan)}<table>{head}{rows}</table></div>"
    )


def no_plan_html(name: str, status: str) -> str:
    """What is to be said of a mission without a plan."""
    return f"<div><b>{escape(name)}</b>: {escape(status)}</div>"


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


def _map(plan: PlanFile) -> str:
    """Routes as lines, nodes as circles, start and destination in black."""
    points = plan.instance.points
    low, spans = points.min(axis=0), np.ptp(points, axis=0)
    scale = (_SIDE - 2.0 * _RIM) / max(float(spans.max()), 1e-12)
    x, y = _RIM + scale * (points[:, 0] - low[0]), _RIM + scale * (low[1] + spans[1] - points[:, 1])
    width, height = (2.0 * _RIM + scale * span for span in spans)
    vertices = {node.id: k for k, node in enumerate(plan.instance.nodes, start=1)}
    parts = []
    for auv, route in enumerate(plan.routes):
        stops = [0, *(vertices[name] for name in route if name in vertices), len(points) - 1]
        line = " ".join(f"{x[k]:.1f},{y[k]:.1f}" for k in stops)
        colour = _COLOURS[auv % len(_COLOURS)]
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
    visited = {name for route in plan.routes for name in route}
    for node in plan.instance.nodes[:_MOST_NODES]:
        k, colour = vertices[node.id], "#333333" if node.id in visited else "#bbbbbb"
        parts.append(f'<circle cx="{x[k]:.1f}" cy="{y[k]:.1f}" r="3" fill="{colour}"/>')
    parts += [f'<circle cx="{x[k]:.1f}" cy="{y[k]:.1f}" r="5" stroke="#888888"/>' for k in (0, -1)]
    return f'<svg width="{width:.0f}" height="{height:.0f}">{"".join(parts)}</svg>'
