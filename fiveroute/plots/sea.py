"""The sea: its current, its land, and what lies in it."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Circle as Disc
from matplotlib.patches import Polygon as Patch

from fiveroute.instance import Circle
from fiveroute.view.chart import LAND, WATER, Chart, Mask
from fiveroute.view.scene import Scene

__all__ = ["new_axes", "plot_currents", "plot_sea", "unit_of"]

_LAND, _COAST, _OBSTACLE, _NO_DATA, _ARROW = "#d9cdb4", "#9a8a66", "#c8b8a8", "#dfe3e7", "#264664"
_SPEED = LinearSegmentedColormap.from_list(
    "speed", ["#f8fbfd", "#dde8f1", "#b8cdde", "#8dacc6", "#6388aa"]
)

_ARROWS = 40
"""Arrows across a chart."""


def new_axes() -> Axes:
    """Axes of a figure of their own."""
    return Figure(figsize=(8.0, 6.4), layout="constrained").subplots()


def unit_of(scene: Scene) -> float:
    """Metres in a unit of the axes: kilometres, or the units of a benchmark file."""
    return 1000.0 if scene.instance.metric == "euclidean" else 1.0


def plot_currents(
    chart: Chart, ax: Axes | None = None, *, t: float = 0.0, shades: int | None = None
) -> Axes:
    """The speed of a current as colour, and the current as arrows.

    Parameters
    ----------
    chart
        The current, see `fiveroute.view.chart`.
    ax
        Where to draw.
    t
        Seconds since the mission began; the nearest time of the chart is drawn.
    shades
        Number of flat shades, which small files like; None draws smoothly.
    """
    ax = ax or new_axes()
    u, v = np.moveaxis(chart.uv[int(np.abs(chart.times - t).argmin())], -1, 0)
    x = (chart.west + chart.step * np.arange(u.shape[1])) / 1000.0
    y = (chart.south + chart.step * np.arange(u.shape[0])) / 1000.0
    speed, fastest = np.hypot(u, v), chart.fastest or 1.0
    image: ScalarMappable
    if shades is None:
        smooth: dict[str, Any] = {"shading": "gouraud", "rasterized": True, "zorder": 0}
        image = ax.pcolormesh(x, y, speed, cmap=_SPEED, vmin=0.0, vmax=fastest, **smooth)
    else:
        levels = np.linspace(0.0, fastest, shades + 1)
        image = ax.contourf(x, y, speed, levels, cmap=_SPEED, antialiased=False, zorder=0)
    label = "speed of the current in m/s"
    ax.figure.colorbar(image, ax=ax, label=label, shrink=0.7, format="%.2f")
    every = max(max(u.shape) // _ARROWS, 1)
    some = slice(every // 2, None, every)
    arrows = u[some, some], v[some, some]
    if np.any(arrows):  # in still water there is no scale for them
        ax.quiver(x[some], y[some], *arrows, color=_ARROW, alpha=0.5, width=1.6e-3, zorder=1)
    if chart.mask is not None:
        _draw_mask(ax, chart.mask)
    ax.set(xlabel="x in km", ylabel="y in km", aspect="equal")
    return ax


def _draw_mask(ax: Axes, mask: Mask) -> None:
    rows, columns = mask.codes.shape
    west, south = mask.west - mask.step / 2.0, mask.south - mask.step / 2.0
    east, north = west + columns * mask.step, south + rows * mask.step
    ax.imshow(
        np.ma.masked_equal(mask.codes, WATER),
        cmap=ListedColormap([_LAND, _NO_DATA]),
        vmin=LAND,
        vmax=LAND + 1,
        origin="lower",
        extent=(west / 1000.0, east / 1000.0, south / 1000.0, north / 1000.0),
        zorder=1.5,
    )


def plot_sea(
    scene: Scene,
    ax: Axes | None = None,
    *,
    t: float = 0.0,
    currents: bool = True,
    shades: int | None = None,
) -> Axes:
    """The current, land and obstacles of a scene, cut to what must be seen of it.

    Parameters
    ----------
    scene
        See `fiveroute.view.scene.scene_of`.
    ax
        Where to draw.
    t
        Seconds since the mission began.
    currents
        Whether to draw the current.
    shades
        Number of flat shades of its speed; None draws smoothly.
    """
    ax = ax or new_axes()
    unit = unit_of(scene)
    if currents and scene.chart is not None:
        plot_currents(scene.chart, ax, t=t, shades=shades)
    elif scene.chart is not None and scene.chart.mask is not None:
        _draw_mask(ax, scene.chart.mask)
    ocean = scene.instance.ocean
    for zone in (*ocean.land, *ocean.obstacles):
        colour = _LAND if zone in ocean.land else _OBSTACLE
        style: dict[str, Any] = {"facecolor": colour, "edgecolor": _COAST, "zorder": 2}
        if isinstance(zone, Circle):
            ax.add_patch(Disc((zone.x / unit, zone.y / unit), zone.radius / unit, **style))
        else:
            ax.add_patch(Patch(np.array(zone.polygon) / unit, **style))
    west, south, east, north = (edge / unit for edge in scene.region)
    name = " in km" if unit > 1.0 else ""
    ax.set(xlim=(west, east), ylim=(south, north), aspect="equal")
    ax.set(xlabel=f"x{name}", ylabel=f"y{name}")
    ax.title.set_parse_math(False)  # the name of a mission may hold dollars
    return ax
