"""What a path costs: the time it takes, equations (22) and (23), and how far it breaks the rules.

Along a spline p(w) the AUV makes good the ground speed g of equation (11) in the direction of the
tangent, heading into the current by the crab angle, so that the path takes

    T = int |p'(w)| / g(p(w), p'(w) / |p'(w)|, t) dw,

t being the time already spent. Three rules bind it, each with a violation in seconds that is 0
where the path keeps the rule and has a continuous derivative:

- collision (21): int (max(0, b - clearance) / b)^2 |p'| dw / V with a small buffer b,
  at dense points; a clearance of c metres frees all points within c, which are skipped;
- curvature: 100 int max(0, R curvature - 1)^2 |p'| dw / V with the turning radius R;
- strength: where the current is too strong to make good the way, 100 times what is missing in
  units of V, times |p'| dw / V; the path is taken to go on at a hundredth of V.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.ocean.barriers import Barriers, clearance
from fiveroute.ocean.current_grid import CurrentGrid, velocity
from fiveroute.paths.legs import ground_speed
from fiveroute.paths.spline import SplineTable, gauss_table, regular_table, straight_control
from fiveroute.paths.waters import Waters

__all__ = [
    "PathProblem",
    "collision",
    "cost_between",
    "path_cost",
    "path_problem",
    "shortfall",
    "travel",
]

Floats = NDArray[np.float64]

_BUFFER = 1e-4  # clearance that is planned for, as a share of the line
_LEAST_BUFFER = 1e-3  # the same in metres, where an end lies close to a barrier
_TURN_RESERVE = 1.02  # turning radius that is planned for
_GUARDS = 32  # points a span where clearance is taken
_CELLS_A_PART = 6.0  # grid cells to a part of the quadrature with three nodes
_FEWEST_PARTS = 12
_CELLS_A_SPAN = 10.0  # grid cells to a span of the splines that evolve, within these bounds:
_FEWEST_OPEN, _FEWEST, _MOST = 2, 5, 6  # in open water, among barriers, anywhere

_CRAWL = 0.01  # share of the speed through the water that is counted where nothing is made good
_TOO_STRONG = 100.0  # violation in seconds for every second of still-water time at no headway
_TOO_TIGHT = 100.0  # violation in seconds for every second of still-water time at radius R / 2


class PathProblem(NamedTuple):
    """A path to be planned on a given number of spans; a tuple, as kernels need it.

    Parameters
    ----------
    grid
        The current.
    barriers
        What the path must keep clear of.
    speed
        V, speed through the water in metres per second.
    turning_radius
        R, in metres; 0 where the AUV turns on the spot.
    begin
        Time at which the path begins, in seconds.
    buffer
        b, clearance in metres below which a path counts as colliding.
    nodes
        Where time and curvature are taken.
    guards
        Where clearance is taken, evenly spaced.
    straight
        Control points of the straight line, shape (S + 3, 2).
    """

    grid: CurrentGrid
    barriers: Barriers
    speed: float
    turning_radius: float
    begin: float
    buffer: float
    nodes: SplineTable
    guards: SplineTable
    straight: Floats


def path_problem(
    waters: Waters, start: Floats, goal: Floats, *, begin: float = 0.0, spans: int | None = None
) -> PathProblem:
    """State the problem for kernels, with tables as fine as the current and the line ask for."""
    length = float(np.hypot(*(goal - start)))
    cells = length / waters.grid.step
    fewest = _FEWEST_OPEN if waters.barriers.is_open else _FEWEST
    spans = spans or min(max(math.ceil(cells / _CELLS_A_SPAN), fewest), _MOST)
    spare = min(clearance(waters.barriers, x, y) for x, y in (start, goal))
    parts = max(math.ceil(cells / _CELLS_A_PART / spans), math.ceil(_FEWEST_PARTS / spans))
    return PathProblem(
        waters.grid,
        waters.barriers,
        waters.speed,
        _TURN_RESERVE * waters.turning_radius,
        begin,
        min(_BUFFER * length, max(0.5 * spare, _LEAST_BUFFER)),
        gauss_table(spans, parts),
        regular_table(spans, _GUARDS),
        straight_control(start, goal, spans),
    )


@kernel
def path_cost(problem: PathProblem, control: Floats) -> tuple[float, float]:
    """Time of a path and its violation of the rules, both in seconds."""
    return cost_between(problem, control, 0, len(control) - 3)


@kernel
def cost_between(
    problem: PathProblem, control: Floats, first: int, last: int
) -> tuple[float, float]:
    """Time and violation on the spans from `first` to before `last`, begun at the path's begin."""
    time, violation = travel(problem, control, first, last)
    return time, violation + collision(problem, control, first, last)


@kernel
def travel(problem: PathProblem, control: Floats, first: int, last: int) -> tuple[float, float]:
    """Time on some spans, and how far they break the rules of curvature and strength."""
    nodes, speed = problem.nodes, problem.speed
    each = len(nodes.first) // (len(control) - 3)
    elapsed = violation = 0.0
    slowness = 1.0 / speed
    for k in range(first * each, last * each):
        x = y = dx = dy = 0.0
        for i in range(4):
            px, py = control[nodes.first[k] + i, 0], control[nodes.first[k] + i, 1]
            x += nodes.value[k, i] * px
            y += nodes.value[k, i] * py
            dx += nodes.slope[k, i] * px
            dy += nodes.slope[k, i] * py
        pace = max(math.sqrt(dx * dx + dy * dy), 1e-9)
        length = pace * nodes.weight[k]
        now = problem.begin + elapsed + 0.5 * length * slowness
        u, v = velocity(problem.grid, x, y, now)
        made_good = ground_speed(u, v, dx / pace, dy / pace, speed)
        if made_good == 0.0:
            missing = shortfall(u, v, dx / pace, dy / pace, speed)
            violation += _TOO_STRONG * missing * length / speed
            made_good = _CRAWL * speed
        slowness = 1.0 / made_good
        elapsed += length * slowness
        if problem.turning_radius > 0.0:
            excess = problem.turning_radius * _curvature(nodes, k, control, dx, dy, pace) - 1.0
            if excess > 0.0:
                violation += _TOO_TIGHT * excess * excess * length / speed
    return elapsed, violation


@kernel
def shortfall(u: float, v: float, east: float, north: float, speed: float) -> float:
    """How much is missing, in units of V, where the current is too strong to make good the way.

    It is positive there, and grows with the current against and across the way.
    """
    along, across = u * east + v * north, abs(v * east - u * north)
    headway = along + math.sqrt(max(speed * speed - across * across, 0.0))
    return _CRAWL + (max(across - speed, 0.0) + max(-headway, 0.0)) / speed


@kernel
def _curvature(
    nodes: SplineTable, k: int, control: Floats, dx: float, dy: float, pace: float
) -> float:
    """Size of the curvature at a node where the first derivative is known, in 1/m."""
    ddx = ddy = 0.0
    for i in range(4):
        ddx += nodes.bend[k, i] * control[nodes.first[k] + i, 0]
        ddy += nodes.bend[k, i] * control[nodes.first[k] + i, 1]
    return abs(dx * ddy - dy * ddx) / pace**3


@kernel
def collision(problem: PathProblem, control: Floats, first: int, last: int) -> float:
    """How far some spans break the rule of clearance, in seconds of still-water time."""
    guards = problem.guards
    each = (len(guards.first) - 1) // (len(control) - 3)
    most = _longest_step(control) / each
    violation, k, end = 0.0, first * each, last * each
    while k <= end:
        x = y = 0.0
        for i in range(4):
            x += guards.value[k, i] * control[guards.first[k] + i, 0]
            y += guards.value[k, i] * control[guards.first[k] + i, 1]
        spare = clearance(problem.barriers, x, y) - problem.buffer
        if spare > 0.0:
            k += int(min(max(spare / most, 1.0), end + 1.0))
            continue
        dx = dy = 0.0
        for i in range(4):
            dx += guards.slope[k, i] * control[guards.first[k] + i, 0]
            dy += guards.slope[k, i] * control[guards.first[k] + i, 1]
        depth = spare / problem.buffer
        violation += depth * depth * math.hypot(dx, dy) * guards.weight[k]
        k += 1
    return violation / problem.speed


@kernel
def _longest_step(control: Floats) -> float:
    """A bound of |p'|: the derivative's own control points bound it."""
    last, most = len(control) - 2, 1e-9
    for i in range(last + 1):
        knots = min(3, i + 1, last - i + 1, last - 1)
        step = (
            3.0
            / knots
            * math.hypot(control[i + 1, 0] - control[i, 0], control[i + 1, 1] - control[i, 1])
        )
        most = max(most, step)
    return most
