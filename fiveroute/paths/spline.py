"""Paths as clamped uniform cubic B-splines: few control points, a smooth curve.

The knots are 0, 0, 0, 0, 1, 2, ..., S - 1, S, S, S, S for S spans, so that S + 3 control points
c_i make the curve

    p(w) = sum_i N_i(w) c_i,    0 <= w <= S,

which begins in the first control point, ends in the last, and has a continuous curvature
|p' x p''| / |p'|^3. At every w only four basis functions N_i differ from 0. A curve at which
planners look millions of times is therefore looked at through a table, `SplineTable`, made once
for a number of spans: the four functions and their derivatives at fixed parameters.

References
----------
C. de Boor, "A Practical Guide to Splines", Springer 1978, doi 10.1007/978-1-4612-6333-3.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = [
    "SplineTable",
    "basis",
    "fit_control",
    "gauss_table",
    "greville",
    "halving",
    "regular_table",
    "spline_curvature",
    "spline_points",
    "straight_control",
]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_DEGREE = 3
_FIT = 8  # points a span that a spline is fitted to
_SMOOTHING = 1e-4  # weight of the control polygon's bends in a fit


class SplineTable(NamedTuple):
    """The basis at fixed parameters; a tuple, as kernels need it.

    Parameters
    ----------
    first
        The first of the four control points that count at each parameter, shape (k,).
    value, slope, bend
        Their basis functions, and first and second derivatives, shape (k, 4).
    weight
        Quadrature weight of each parameter, shape (k,).
    """

    first: Integers
    value: Floats
    slope: Floats
    bend: Floats
    weight: Floats


def greville(spans: int) -> Floats:
    """Parameters at which control points make a straight line run evenly, shape (S + 3,)."""
    knots = _knots(spans)
    return np.asarray((knots[1:-3] + knots[2:-2] + knots[3:-1]) / 3.0)


def straight_control(start: Floats, goal: Floats, spans: int) -> Floats:
    """Control points of the straight line, run through evenly, shape (S + 3, 2)."""
    share = (greville(spans) / spans)[:, None]
    return (1.0 - share) * start + share * goal


def basis(spans: int, parameters: Floats) -> Floats:
    """All basis functions at parameters, shape (k, S + 3)."""
    first, value, _, _ = _local_basis(spans, parameters)
    matrix = np.zeros((len(parameters), spans + _DEGREE))
    np.put_along_axis(matrix, first[:, None] + np.arange(4), value, axis=1)
    return matrix


@lru_cache(maxsize=64)
def regular_table(spans: int, parts: int) -> SplineTable:
    """Table at `parts` equal steps a span, both ends included, with the trapezoidal weights."""
    parameters = np.arange(spans * parts + 1) / parts
    weight = np.full(len(parameters), 1.0 / parts)
    weight[[0, -1]] /= 2.0
    return SplineTable(*_local_basis(spans, parameters), weight)


@lru_cache(maxsize=64)
def gauss_table(spans: int, parts: int) -> SplineTable:
    """Table at Gauss and Legendre's three nodes on each of `parts` equal parts of a span."""
    node, weight = np.polynomial.legendre.leggauss(3)
    parameters = (np.arange(spans * parts)[:, None] + (node + 1.0) / 2.0).ravel() / parts
    weights = np.tile(weight / 2.0 / parts, spans * parts)
    return SplineTable(*_local_basis(spans, parameters), weights)


@lru_cache(maxsize=16)
def halving(spans: int) -> Floats:
    """Matrix that takes control points to those of the same curve on twice as many spans.

    Splines on the halved spans contain those on the whole ones, so that the new control points
    follow from as many values of the curve, shape (2 S + 3, S + 3).
    """
    at = greville(2 * spans)
    matrix = np.linalg.solve(basis(2 * spans, at), basis(spans, at / 2.0))
    matrix[0], matrix[-1] = np.eye(spans + _DEGREE)[[0, -1]]  # the ends exactly
    return np.asarray(matrix, np.float64)


def fit_control(track: Floats, spans: int) -> Floats:
    """Control points of a spline near a track, shape (k, 2), by least squares, its ends kept."""
    fitting, interior = _fitting(spans)
    travelled = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(track, axis=0).T))])
    at = np.linspace(0.0, travelled[-1], len(fitting))
    places = np.column_stack([np.interp(at, travelled, track[:, axis]) for axis in (0, 1)])
    control = straight_control(track[0], track[-1], spans)
    control[1:-1] += interior @ (places - fitting @ control)
    return control


@lru_cache(maxsize=16)
def _fitting(spans: int) -> tuple[Floats, Floats]:
    """The basis at the parameters of a fit, and what turns misfits into interior control points."""
    matrix = basis(spans, np.linspace(0.0, spans, _FIT * spans + 1))
    bends = np.diff(np.eye(spans + _DEGREE), 2, axis=0)[:, 1:-1]
    inner = matrix[:, 1:-1]
    normal = inner.T @ inner + _SMOOTHING * bends.T @ bends
    return matrix, np.asarray(np.linalg.solve(normal, inner.T), np.float64)


def _knots(spans: int) -> Floats:
    inner = np.arange(spans + 1.0)
    return np.concatenate([np.zeros(_DEGREE), inner, np.full(_DEGREE, float(spans))])


def _local_basis(spans: int, parameters: Floats) -> tuple[Integers, Floats, Floats, Floats]:
    """First control point that counts, and de Boor's basis functions with two derivatives."""
    knots, first = _knots(spans), np.minimum(parameters.astype(np.int64), spans - 1)
    span = first + _DEGREE
    levels = [np.ones((len(parameters), 1))]
    for degree in range(1, _DEGREE + 1):
        levels.append(_raised(levels[-1], degree, knots, span, parameters))
    slope = _derived(levels[2], 3, knots, span)
    bend = _derived(_derived(levels[1], 2, knots, span), 3, knots, span)
    return first, levels[3], slope, bend


def _raised(lower: Floats, degree: int, knots: Floats, span: Integers, at: Floats) -> Floats:
    """Basis functions of a degree by those of the degree below, de Boor's recurrence."""
    result = np.zeros((len(at), degree + 1))
    for k in range(degree):
        left, right = knots[span + k + 1 - degree], knots[span + k + 1]
        share = (at - left) / (right - left)
        result[:, k] += (1.0 - share) * lower[:, k]
        result[:, k + 1] += share * lower[:, k]
    return result


def _derived(lower: Floats, degree: int, knots: Floats, span: Integers) -> Floats:
    """What differentiation makes of functions of the degree below."""
    result = np.zeros((len(span), degree + 1))
    for k in range(degree):
        share = degree / (knots[span + k + 1] - knots[span + k + 1 - degree])
        result[:, k] -= share * lower[:, k]
        result[:, k + 1] += share * lower[:, k]
    return result


@kernel
def spline_points(table: SplineTable, control: Floats) -> Floats:
    """Points of the curve at the table's parameters, fresh, shape (k, 2)."""
    points = np.zeros((len(table.first), 2))
    for k in range(len(points)):
        for i in range(4):
            points[k, 0] += table.value[k, i] * control[table.first[k] + i, 0]
            points[k, 1] += table.value[k, i] * control[table.first[k] + i, 1]
    return points


@kernel
def spline_curvature(table: SplineTable, control: Floats) -> Floats:
    """Curvature of the curve in 1/m at the table's parameters, fresh, positive to the left.

    Infinite where the curve stands still.
    """
    curvature = np.empty(len(table.first))
    for k in range(len(curvature)):
        dx = dy = ddx = ddy = 0.0
        for i in range(4):
            x, y = control[table.first[k] + i]
            dx += table.slope[k, i] * x
            dy += table.slope[k, i] * y
            ddx += table.bend[k, i] * x
            ddy += table.bend[k, i] * y
        pace = np.hypot(dx, dy)
        curvature[k] = (dx * ddy - dy * ddx) / pace**3 if pace > 0.0 else np.inf
    return curvature
