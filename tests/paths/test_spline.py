import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from fiveroute.paths.spline import (
    basis,
    fit_control,
    gauss_table,
    greville,
    halving,
    regular_table,
    spline_curvature,
    spline_points,
    straight_control,
)

SPANS = st.integers(1, 9)


def some_control(spans: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(0.0, 1000.0, (spans + 3, 2))


@settings(deadline=None, max_examples=20)
@given(SPANS)
def test_the_basis_adds_up_to_one_and_is_never_negative(spans: int) -> None:
    matrix = basis(spans, np.linspace(0.0, spans, 101))
    assert matrix.sum(axis=1) == pytest.approx(1.0, abs=1e-14)
    assert (matrix >= 0.0).all()


@settings(deadline=None, max_examples=10)
@given(SPANS)
def test_the_basis_is_that_of_another_library(spans: int) -> None:
    at = np.linspace(0.0, spans - 1e-9, 57)
    knots = np.concatenate([np.zeros(3), np.arange(spans + 1.0), np.full(3, spans)])
    theirs = BSpline.design_matrix(at, knots, 3).toarray()
    assert basis(spans, at) == pytest.approx(theirs, abs=1e-13)


@settings(deadline=None, max_examples=10)
@given(SPANS, st.integers(0, 100))
def test_a_curve_begins_and_ends_in_its_outer_control_points(spans: int, seed: int) -> None:
    control = some_control(spans, seed)
    points = spline_points(regular_table(spans, 4), control)
    assert points[[0, -1]] == pytest.approx(control[[0, -1]], rel=1e-14)


@pytest.mark.parametrize("spans", [1, 2, 3, 7])
def test_a_straight_line_is_run_through_evenly(spans: int) -> None:
    start, goal = np.array([100.0, -50.0]), np.array([700.0, 900.0])
    points = spline_points(regular_table(spans, 5), straight_control(start, goal, spans))
    share = np.linspace(0.0, 1.0, len(points))[:, None]
    assert points == pytest.approx(start + share * (goal - start), abs=1e-9)
    at = np.linspace(0.0, spans, 20)
    assert basis(spans, at) @ greville(spans) == pytest.approx(at, abs=1e-13)


@pytest.mark.parametrize("spans", [1, 2, 5])
def test_derivatives_are_those_of_the_curve(spans: int) -> None:
    table, h = regular_table(spans, 8), 1e-4
    control = some_control(spans)
    at = (np.arange(1, 8 * spans) / 8.0)[np.arange(1, 8 * spans) % 8 != 0]  # within spans
    rows = np.round(8 * at).astype(int)
    before, here, after = (basis(spans, at + step) @ control for step in (-h, 0.0, h))
    local = control[table.first[rows, None] + np.arange(4)]
    slope = np.einsum("ki,kix->kx", table.slope[rows], local)
    bend = np.einsum("ki,kix->kx", table.bend[rows], local)
    assert slope == pytest.approx((after - before) / (2 * h), rel=1e-5, abs=1e-3)
    assert bend == pytest.approx((after - 2 * here + before) / h**2, rel=1e-3, abs=1e-1)


@pytest.mark.parametrize("spans", [1, 2, 3, 8])
def test_halving_the_spans_leaves_the_curve_as_it_is(spans: int) -> None:
    control = some_control(spans)
    finer = halving(spans) @ control
    assert len(finer) == 2 * spans + 3
    coarse = spline_points(regular_table(spans, 6), control)
    assert spline_points(regular_table(2 * spans, 3), finer) == pytest.approx(coarse, abs=1e-9)


def quarter(spans: int, radius: float) -> np.ndarray:
    angle = np.linspace(0.0, math.pi / 2.0, 400)
    return fit_control(radius * np.column_stack([np.cos(angle), np.sin(angle)]), spans)


def test_a_spline_approaches_a_circle_with_fourth_order_and_has_its_curvature() -> None:
    radius, errors = 500.0, []
    for spans in (2, 4):
        points = spline_points(regular_table(spans, 32), quarter(spans, radius))
        errors.append(np.abs(np.hypot(*points.T) - radius).max() / radius)
    assert errors[1] < errors[0] / 8.0 < 1e-4
    curvature = spline_curvature(regular_table(4, 8), quarter(4, radius))
    assert np.median(curvature) == pytest.approx(1.0 / radius, rel=0.01)
    assert np.median(spline_curvature(regular_table(4, 8), quarter(4, radius)[::-1])) < 0.0


def test_a_curve_that_stands_still_has_infinite_curvature() -> None:
    assert np.isinf(spline_curvature(regular_table(2, 2), np.ones((5, 2)))).all()


def test_a_track_that_is_a_spline_is_fitted_closely() -> None:
    spans = 4
    control = straight_control(np.zeros(2), np.array([1000.0, 0.0]), spans)
    control[1:-1, 1] += [20.0, 60.0, 50.0, 10.0, -20.0]
    track = spline_points(regular_table(spans, 50), control)
    fitted = spline_points(regular_table(spans, 50), fit_control(track, spans))
    assert np.abs(fitted - track).max() < 5.0  # of 1000 m: it runs through the same curve evenly
    assert fitted[[0, -1]] == pytest.approx(track[[0, -1]])


def test_tables_integrate_polynomials() -> None:
    """Gauss and Legendre's three nodes take the length of a parabola's graph's fifth power."""
    spans = 3
    table = gauss_table(spans, 2)
    control = straight_control(np.zeros(2), np.array([float(spans), 0.0]), spans)
    x = spline_points(table, control)[:, 0]
    assert (table.weight * x**5).sum() == pytest.approx(spans**6 / 6.0, rel=1e-13)
    regular = regular_table(spans, 4)
    x = spline_points(regular, control)[:, 0]
    assert (regular.weight * x).sum() == pytest.approx(spans**2 / 2.0, rel=1e-13)
