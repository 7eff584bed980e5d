"""The last metres to the optimum: a quasi-Newton descent from the path that evolution found.

Only displacements across the path change its time to first order, so each interior control point
moves along the normal of the path beside it. The merit of a path is its time plus its violation of
the rules times a weight, which is smooth; its gradient is taken by differences.

The time of a path in still water is its length / V, whose second derivative under displacements
across the path is the stiffness matrix int N_i' N_j' dw / (V |p'|). Its inverse is what the BFGS
update begins with, so that a few steps are enough whatever the number of control points.

References
----------
J. Nocedal and S. J. Wright, "Numerical Optimization", 2nd ed., Springer 2006, algorithm 6.1,
doi 10.1007/978-0-387-40065-5.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.paths.path_cost import PathProblem, cost_between, path_cost

__all__ = ["merit", "polish"]

Floats = NDArray[np.float64]

_DIFFERENCE = 1e-5  # step of the differences, as a share of the leg's length
_LONGEST = 0.1  # longest step of the descent, as a share of the leg's length
_ENOUGH = 1e-8  # share of the merit below which a step gains nothing
_HALVINGS = 12
_ARMIJO = 1e-4


@kernel
def merit(problem: PathProblem, control: Floats, weight: float) -> float:
    """Time of a path and its violation of the rules times a weight."""
    time, violation = path_cost(problem, control)
    return time + weight * violation


@kernel
def polish(problem: PathProblem, control: Floats, weight: float, steps: int) -> float:
    """Descend from the control points, which are changed in place; tells the merit reached."""
    normals = _normals(control)
    length = math.hypot(control[-1, 0] - control[0, 0], control[-1, 1] - control[0, 1])
    inverse: Floats = np.linalg.inv(_stiffness(problem, control, normals))  # type: ignore[assignment]
    value = merit(problem, control, weight)
    gradient = _gradient(problem, control, normals, weight, _DIFFERENCE * length)
    idle = 0
    for _ in range(steps):
        step = -(inverse @ gradient)
        slope = (step * gradient).sum()
        if slope >= 0.0:
            break
        shorter = min(1.0, _LONGEST * length / np.abs(step).max())
        step, slope = shorter * step, shorter * slope
        share, reached = _searched(problem, control, normals, weight, value, step, slope)
        if share == 0.0:
            break
        step *= share
        _move(control, normals, step)
        before = gradient
        gradient = _gradient(problem, control, normals, weight, _DIFFERENCE * length)
        _update(inverse, step, gradient - before)
        idle = idle + 1 if value - reached < _ENOUGH * value else 0
        value = reached
        if idle == 2:
            break
    return value


@kernel
def _normals(control: Floats) -> Floats:
    """Unit vectors across the control polygon at its interior points, shape (S + 1, 2)."""
    normals = np.empty((len(control) - 2, 2))
    for i in range(len(normals)):
        x, y = control[i + 2] - control[i]
        length = max(math.hypot(x, y), 1e-9)
        normals[i, 0], normals[i, 1] = -y / length, x / length
    return normals


@kernel
def _stiffness(problem: PathProblem, control: Floats, normals: Floats) -> Floats:
    """Second derivative of the still-water time under displacements along the normals."""
    nodes, size = problem.nodes, len(normals)
    matrix = np.zeros((size, size))
    for k in range(len(nodes.first)):
        first, dx, dy = nodes.first[k], 0.0, 0.0
        for a in range(4):
            dx += nodes.slope[k, a] * control[first + a, 0]
            dy += nodes.slope[k, a] * control[first + a, 1]
        share = nodes.weight[k] / (problem.speed * max(math.hypot(dx, dy), 1e-9))
        for a in range(4):
            for b in range(4):
                i, j = first + a - 1, first + b - 1
                if 0 <= i < size and 0 <= j < size:
                    matrix[i, j] += share * nodes.slope[k, a] * nodes.slope[k, b]
    return matrix


@kernel
def _move(control: Floats, normals: Floats, step: Floats) -> None:
    """Displace the interior control points along their normals."""
    for i in range(len(step)):
        control[i + 1, 0] += step[i] * normals[i, 0]
        control[i + 1, 1] += step[i] * normals[i, 1]


@kernel
def _gradient(
    problem: PathProblem, control: Floats, normals: Floats, weight: float, difference: float
) -> Floats:
    """Gradient of the merit by central differences.

    In a steady current a control point has a part only in the four spans beside it.
    """
    gradient, spans = np.empty(len(normals)), len(control) - 3
    steady = problem.grid.uv.shape[0] == 1
    for i in range(len(normals)):
        first, last = (max(i - 2, 0), min(i + 2, spans)) if steady else (0, spans)
        x, y = control[i + 1]
        rise = 0.0
        for side in (difference, -difference):
            control[i + 1, 0], control[i + 1, 1] = (
                x + side * normals[i, 0],
                y + side * normals[i, 1],
            )
            time, violation = cost_between(problem, control, first, last)
            rise += (time + weight * violation) / side
        gradient[i] = 0.5 * rise
        control[i + 1, 0], control[i + 1, 1] = x, y
    return gradient


@kernel
def _searched(
    problem: PathProblem,
    control: Floats,
    normals: Floats,
    weight: float,
    value: float,
    step: Floats,
    slope: float,
) -> tuple[float, float]:
    """Share of a step that lowers the merit enough, and the merit there; 0 if none does."""
    share = 1.0
    for _ in range(_HALVINGS):
        trial = control.copy()
        _move(trial, normals, share * step)
        reached = merit(problem, trial, weight)
        if reached < value + _ARMIJO * share * slope:
            return share, reached
        share *= 0.5
    return 0.0, value


@kernel
def _update(inverse: Floats, step: Floats, change: Floats) -> None:
    """BFGS: make the inverse second derivative, in place, agree with a change of the gradient."""
    turn = (step * change).sum()
    if turn <= 1e-12 * math.sqrt((step**2).sum() * (change**2).sum()):
        return
    through = inverse @ change
    stretch = (1.0 + (change * through).sum() / turn) / turn
    for i in range(len(step)):
        for j in range(len(step)):
            inverse[i, j] += stretch * step[i] * step[j]
            inverse[i, j] -= (through[i] * step[j] + step[i] * through[j]) / turn
