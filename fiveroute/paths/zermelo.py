"""The exact time-optimal path in a smooth current without barriers, by the indirect method.

A vehicle that heads for theta moves as

    dx/dt = V cos(theta) + u,    dy/dt = V sin(theta) + v,

and is on a path that can be the fastest only if it steers by Zermelo's navigation formula

    d theta/dt = sin^2(theta) dv/dx + sin(theta) cos(theta) (du/dx - dv/dy) - cos^2(theta) du/dy,

in steady and unsteady currents alike. So all candidates, the extremals from a start, are known by
their first heading. A fan of them is integrated (Runge and Kutta's rule of fourth order);
wherever two neighbours enclose the goal between two steps, the heading and the time that hit it
are found by Newton's method, in a narrower fan if it fails. The fastest path is the extremal
that hits the goal first. The current's derivatives are central differences of its interpolation,
over a thousandth of a cell.

In water that moves at c everywhere the heading stays as it is, and the path is the straight leg d.
Its time solves |d - c T| = V T,

    T = d^2 / (c.d + sqrt((c.d)^2 + (V^2 - c^2) d^2)),

unless |c| >= V and d points out of the cone that the current leaves: then there is none.

References
----------
E. Zermelo, "Über das Navigationsproblem bei ruhender oder veränderlicher Windverteilung",
Zeitschrift für angewandte Mathematik und Mechanik 11 (1931), doi 10.1002/zamm.19310110205.
A. E. Bryson and Y.-C. Ho, "Applied Optimal Control", Hemisphere 1975, section 2.7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.current_grid import CurrentGrid, velocity
from fiveroute.paths.legs import track_time
from fiveroute.paths.waters import Waters

__all__ = ["Extremal", "extremal", "uniform_flow_time", "zermelo_path"]

Flags = NDArray[np.bool_]
Floats = NDArray[np.float64]

_HEADINGS = 720  # in the first fan
_NARROWER = 24  # in each fan between two neighbours
_DEPTH = 3  # of fans within fans
_STEPS_A_CELL = 4  # time steps in which still water would be crossed from grid point to point
_SLACK = 1.01  # of the horizon over the time of the straight leg
_LAST = 10.0  # longest horizon, in times of the straight leg in still water
_NEWTON = 12  # iterations at most
_WIDER = 0.1  # by which triangles are taken larger, so that no hit falls between two
_HIT = 1e-9  # of the distance to the goal
_DIFFERENCE = 1e-3  # of the grid's spacing, for derivatives
_SMALL = 1e-6  # radians, and share of the duration, for derivatives of the end


@dataclass(frozen=True, slots=True, eq=False)
class Extremal:
    """A path that Zermelo's formula steers.

    Parameters
    ----------
    track
        Points from the start to the goal in metres, at equal intervals of time, shape (k, 2);
        none if no extremal hits the goal.
    duration
        In seconds; infinite if no extremal hits the goal.
    heading
        First heading in radians, anticlockwise from east.
    """

    track: Floats
    duration: float
    heading: float


class _Task(NamedTuple):
    """What to hit from where, when, how fast, and with what time step."""

    grid: CurrentGrid
    start: Floats
    goal: Floats
    begin: float
    speed: float
    interval: float


class _Fan(NamedTuple):
    """First headings from `heading` by `width`, with `gaps` between, followed for `horizon`."""

    heading: float
    width: float
    gaps: int
    horizon: float


def uniform_flow_time(u: float, v: float, east: float, north: float, speed: float) -> float:
    """Least time in seconds to a place in uniform flow; infinite if the flow carries past it.

    Parameters
    ----------
    u, v
        Velocity of the water in metres per second.
    east, north
        The place as seen from the start, in metres.
    speed
        Speed through the water in metres per second.
    """
    squared = east**2 + north**2
    if squared == 0.0:
        return 0.0
    along, surplus = u * east + v * north, speed**2 - u**2 - v**2
    root = along**2 + surplus * squared
    if along < 0.0:  # the same without the difference of two near numbers
        return (math.sqrt(root) - along) / surplus if surplus > 0.0 else math.inf
    if root < 0.0 or along + math.sqrt(root) == 0.0:
        return math.inf
    return squared / (along + math.sqrt(root))


def zermelo_path(
    waters: Waters,
    start: ArrayLike,
    goal: ArrayLike,
    *,
    begin: float = 0.0,
    horizon: float | None = None,
    interval: float | None = None,
) -> Extremal:
    """The earliest extremal from a point to another, whatever barriers there are.

    Parameters
    ----------
    waters
        The current and the vehicle.
    start, goal
        Positions in metres, shape (2,).
    begin
        When the path begins, in seconds.
    horizon
        How long an extremal is followed, in seconds; None takes the time of the straight leg,
        which is never faster, and at most ten times that in still water.
    interval
        Time step in seconds; None takes a quarter of that for a cell of the current's grid.
    """
    first, last = np.array(start, dtype=np.float64), np.array(goal, dtype=np.float64)
    distance = math.hypot(*(last - first))
    if distance == 0.0:
        return Extremal(np.array([first, last]), 0.0, 0.0)
    if horizon is None:
        direct = track_time(waters.grid, np.array([first, last]), begin, waters.speed)
        horizon = _SLACK * min(direct, _LAST * distance / waters.speed)
    if interval is None:
        interval = min(waters.grid.step / waters.speed / _STEPS_A_CELL, horizon / 64)
    task = _Task(waters.grid, first, last, begin, waters.speed, interval)
    hit = _first_hit(task, _Fan(0.0, math.tau / _HEADINGS, _HEADINGS, horizon), _DEPTH)
    if hit is None:
        return Extremal(np.zeros((0, 2)), math.inf, math.nan)
    heading, duration = hit
    track = extremal(task, heading, duration, math.ceil(duration / interval))
    track[-1] = last
    return Extremal(track, duration, heading)


def _first_hit(task: _Task, fan: _Fan, depth: int) -> tuple[float, float] | None:
    """First heading and duration of the earliest extremal of a fan that hits the goal."""
    found = _brackets(task, fan, math.ceil(fan.horizon / task.interval))
    hits: list[tuple[float, float]] = []
    for step, gap in np.argwhere(found.T):  # in the order of time
        if hits and step * task.interval > _earliest(hits)[1] + task.interval:
            break
        heading = fan.heading + gap * fan.width
        hit = _refined(task, heading + 0.5 * fan.width, (step + 0.5) * task.interval)
        if not math.isfinite(hit[1]) and depth:
            narrow = _Fan(heading, fan.width / _NARROWER, _NARROWER, fan.horizon)
            hit = _first_hit(task, narrow, depth - 1) or hit
        if math.isfinite(hit[1]):
            hits.append(hit)
    return _earliest(hits) if hits else None


def _earliest(hits: list[tuple[float, float]]) -> tuple[float, float]:
    return min(hits, key=itemgetter(1))


@kernel
def _brackets(task: _Task, fan: _Fan, steps: int) -> Flags:
    """Which gaps between first headings have the goal in which intervals, shape (gaps, steps)."""
    found = np.zeros((fan.gaps, steps), dtype=np.bool_)
    right = extremal(task, fan.heading, steps * task.interval, steps)
    for k in range(fan.gaps):
        left = extremal(task, fan.heading + (k + 1) * fan.width, steps * task.interval, steps)
        for i in range(steps):
            found[k, i] = _holds(right[i], left[i], left[i + 1], task.goal) or _holds(
                right[i], left[i + 1], right[i + 1], task.goal
            )
        right = left
    return found


@kernel
def _holds(a: Floats, b: Floats, c: Floats, point: Floats) -> bool:
    """Whether a triangle, made a little larger, holds a point."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    if area == 0.0:
        return False
    x, y = point[0] - a[0], point[1] - a[1]
    to_b = (x * (c[1] - a[1]) - y * (c[0] - a[0])) / area
    to_c = (y * (b[0] - a[0]) - x * (b[1] - a[1])) / area
    return bool(to_b >= -_WIDER and to_c >= -_WIDER and to_b + to_c <= 1.0 + _WIDER)


@kernel
def _refined(task: _Task, heading: float, duration: float) -> tuple[float, float]:
    """First heading and duration that hit the goal, by Newton's method; infinite if it fails."""
    steps = math.ceil(duration / task.interval)
    least = _HIT * math.hypot(task.goal[0] - task.start[0], task.goal[1] - task.start[1])
    for _ in range(_NEWTON):
        end = extremal(task, heading, duration, steps)[-1]
        miss = task.goal - end
        if math.hypot(miss[0], miss[1]) <= least:
            return heading, duration
        turned = (extremal(task, heading + _SMALL, duration, steps)[-1] - end) / _SMALL
        onward = extremal(task, heading, duration * (1.0 + _SMALL), steps)[-1] - end
        onward /= duration * _SMALL
        area = turned[0] * onward[1] - turned[1] * onward[0]
        if area == 0.0:
            break
        heading += (miss[0] * onward[1] - miss[1] * onward[0]) / area
        duration += (turned[0] * miss[1] - turned[1] * miss[0]) / area
        if duration <= 0.0:
            break
    return heading, math.inf


@kernel
def extremal(task: _Task, heading: float, duration: float, steps: int) -> Floats:
    """Positions along the extremal with a first heading, at equal intervals, shape (steps + 1, 2).

    Runge and Kutta's classic rule of fourth order.
    """
    track = np.empty((steps + 1, 2))
    track[0] = task.start
    x, y, h = task.start[0], task.start[1], duration / steps
    for k in range(steps):
        t = task.begin + k * h
        x1, y1, a1 = _rates(task, x, y, heading, t)
        x2, y2, a2 = _rates(
            task, x + 0.5 * h * x1, y + 0.5 * h * y1, heading + 0.5 * h * a1, t + 0.5 * h
        )
        x3, y3, a3 = _rates(
            task, x + 0.5 * h * x2, y + 0.5 * h * y2, heading + 0.5 * h * a2, t + 0.5 * h
        )
        x4, y4, a4 = _rates(task, x + h * x3, y + h * y3, heading + h * a3, t + h)
        x += h / 6.0 * (x1 + 2.0 * x2 + 2.0 * x3 + x4)
        y += h / 6.0 * (y1 + 2.0 * y2 + 2.0 * y3 + y4)
        heading += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        track[k + 1] = x, y
    return track


@kernel
def _rates(task: _Task, x: float, y: float, heading: float, t: float) -> tuple[float, float, float]:
    """Velocity over ground, and Zermelo's rate of turn."""
    d = _DIFFERENCE * task.grid.step
    u, v = velocity(task.grid, x, y, t)
    ue, ve = velocity(task.grid, x + d, y, t)
    uw, vw = velocity(task.grid, x - d, y, t)
    un, vn = velocity(task.grid, x, y + d, t)
    us, vs = velocity(task.grid, x, y - d, t)
    east, north = math.cos(heading), math.sin(heading)
    turn = north**2 * (ve - vw) + north * east * (ue - uw - vn + vs) - east**2 * (un - us)
    return task.speed * east + u, task.speed * north + v, turn / (2.0 * d)
