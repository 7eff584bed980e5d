"""Currents, held to the closed forms and the equations that they come from."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from fiveroute.errors import InputError
from fiveroute.ocean.currents import (
    Current,
    DoubleGyre,
    LambVortices,
    Shear,
    Superposition,
    UniformCurrent,
)

Floats = NDArray[np.float64]

GAMMA, DELTA = 1200.0, 700.0
VORTEX = LambVortices(*(np.array([value]) for value in (300.0, -200.0, GAMMA, DELTA)))
GYRE = DoubleGyre(speed=0.4, size=2000.0, epsilon=0.25, omega=2.0 * math.pi / 10_000.0, x0=50.0)
CURRENTS: list[Current] = [
    UniformCurrent(0.3, -0.1),
    Shear(1e-4, 500.0),
    VORTEX,
    GYRE,
    Superposition((UniformCurrent(0.1, 0.0), VORTEX, GYRE)),
    Superposition(()),
]


def vortices(seed: int, count: int = 5) -> LambVortices:
    rng = np.random.default_rng(seed)
    return LambVortices(
        rng.uniform(-3000.0, 3000.0, count),
        rng.uniform(-3000.0, 3000.0, count),
        rng.normal(0.0, 1000.0, count),
        rng.uniform(300.0, 900.0, count),
    )


def gradient(current: Current, x: Floats, y: Floats, t: float, h: float = 0.5) -> Floats:
    """Derivatives of (u, v) with respect to x and y, shape (2, 2, ...), of fourth order."""
    columns = []
    for east, north in ((h, 0.0), (0.0, h)):
        near, far = (
            np.subtract(
                current(x + k * east, y + k * north, t), current(x - k * east, y - k * north, t)
            )
            for k in (1, 2)
        )
        columns.append((8.0 * near - far) / (12.0 * h))
    return np.moveaxis(np.array(columns), 0, 1)


def points(seed: int, count: int = 200) -> tuple[Floats, Floats]:
    x, y = np.random.default_rng(seed).uniform(-2500.0, 2500.0, (2, count))
    return x, y


def vorticity(r: Floats | float, age: float, nu: float) -> Floats:
    """Lamb and Oseen's solution of (9) at an age, with delta^2 = 4 nu age."""
    squared = 4.0 * nu * age
    return np.asarray(GAMMA / (math.pi * squared) * np.exp(-(np.asarray(r) ** 2) / squared))


def test_a_lamb_vortex_turns_by_its_closed_form() -> None:
    x, y = points(1)
    east, north = x - 300.0, y + 200.0
    r = np.hypot(east, north)
    around = GAMMA / (2.0 * math.pi * r) * (1.0 - np.exp(-((r / DELTA) ** 2)))
    u, v = VORTEX(x, y)
    np.testing.assert_allclose((u * east + v * north) / r, 0.0, atol=1e-15)  # never outwards
    np.testing.assert_allclose((v * east - u * north) / r, around, rtol=1e-12)


def test_the_core_of_a_vortex_turns_rigidly() -> None:
    """Near the centre the speed is Gamma r / (2 pi delta^2), and nothing at the centre."""
    centred = LambVortices(*(np.array([value]) for value in (0.0, 0.0, GAMMA, DELTA)))
    for r in (0.0, 1e-300, 1e-9, 1e-3, 1.0):
        u, v = centred(r, 0.0)
        assert u == 0.0
        assert v == pytest.approx(GAMMA * r / (2.0 * math.pi * DELTA**2), rel=1e-5, abs=0.0)


def test_a_vortex_is_fastest_at_1_1209_radii() -> None:
    r = DELTA * np.linspace(0.5, 2.0, 150_001)
    speed = np.hypot(*VORTEX(300.0 + r, -200.0))
    assert r[speed.argmax()] == pytest.approx(1.1209 * DELTA, rel=1e-4)
    assert speed.max() == pytest.approx(0.6382 * GAMMA / (2.0 * math.pi * DELTA), rel=1e-4)


def test_circulation_far_away_is_gamma() -> None:
    """A line integral around the vortex; the trapezium rule is exact on a closed smooth curve."""
    angle = np.linspace(0.0, 2.0 * math.pi, 200, endpoint=False)
    for radius, share in ((DELTA, 1.0 - math.exp(-1.0)), (20.0 * DELTA, 1.0)):
        x, y = 300.0 + radius * np.cos(angle), -200.0 + radius * np.sin(angle)
        u, v = VORTEX(x, y)
        along = -u * np.sin(angle) + v * np.cos(angle)
        assert along.mean() * 2.0 * math.pi * radius == pytest.approx(share * GAMMA, rel=1e-12)


def test_circulation_of_a_field_is_that_of_its_vortices() -> None:
    many, angle = vortices(3), np.linspace(0.0, 2.0 * math.pi, 4000, endpoint=False)
    u, v = many(20_000.0 * np.cos(angle), 20_000.0 * np.sin(angle))
    along = -u * np.sin(angle) + v * np.cos(angle)
    assert along.mean() * 2.0 * math.pi * 20_000.0 == pytest.approx(many.circulation.sum())


@pytest.mark.parametrize("current", CURRENTS)
def test_water_is_neither_made_nor_lost(current: Current) -> None:
    derivative = gradient(current, *points(4), t=1700.0)
    np.testing.assert_allclose(derivative[0, 0] + derivative[1, 1], 0.0, atol=1e-12)


def test_vorticity_of_a_vortex_is_a_gaussian() -> None:
    x, y = points(5)
    derivative = gradient(VORTEX, x, y, t=0.0)
    expected = vorticity(np.hypot(x - 300.0, y + 200.0), age=1.0, nu=DELTA**2 / 4.0)
    np.testing.assert_allclose(derivative[1, 0] - derivative[0, 1], expected, atol=1e-12)


def test_a_vortex_is_one_of_lamb_and_oseen() -> None:
    """Its vorticity solves (9), d omega / dt = nu laplace omega, at the age delta^2 / (4 nu).

    The velocity carries the vorticity along its level circles, so that the advection vanishes.
    """
    nu, h, x, y = 0.5, 2.0, *points(6)
    age = DELTA**2 / (4.0 * nu)
    r = np.hypot(x - 300.0, y + 200.0)

    def curl(x: Floats, y: Floats, t: float) -> Floats:
        aged = np.array([math.sqrt(4.0 * nu * t)])
        derivative = gradient(
            LambVortices(VORTEX.x, VORTEX.y, VORTEX.circulation, aged), x, y, 0.0, 4.0
        )
        return np.asarray(derivative[1, 0] - derivative[0, 1])

    np.testing.assert_allclose(curl(x, y, age), vorticity(r, age, nu), atol=1e-12)
    later, sooner = (vorticity(r, age * (1.0 + k), nu) for k in (1e-3, -1e-3))
    growth = (later - sooner) / (2e-3 * age)
    spread = -4.0 * vorticity(r, age, nu)
    for east, north in ((h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h)):
        spread = spread + vorticity(np.hypot(x - 300.0 + east, y + 200.0 + north), age, nu)
    np.testing.assert_allclose(growth, nu * spread / h**2, atol=1e-5 * np.abs(growth).max())


def test_vortices_add_up() -> None:
    many, (x, y) = vortices(7), points(7)
    single = [
        LambVortices(many.x[[k]], many.y[[k]], many.circulation[[k]], many.radius[[k]])
        for k in range(5)
    ]
    np.testing.assert_allclose(many(x, y), Superposition(tuple(single))(x, y), atol=1e-15)
    np.testing.assert_allclose(many(x, y), np.sum([one(x, y) for one in single], axis=0))


def test_no_vortex_is_still_water() -> None:
    none = LambVortices(*np.zeros((4, 0)))
    assert none.length_scale == math.inf
    np.testing.assert_array_equal(none(*points(8)), np.zeros((2, 200)))


def test_shear_grows_to_the_north() -> None:
    u, v = Shear(2e-4, 1000.0)(np.array([0.0, 9e3, 5.0]), np.array([1000.0, 2000.0, 0.0]))
    np.testing.assert_allclose(u, [0.0, 0.2, -0.2])
    np.testing.assert_array_equal(v, 0.0)


def test_nothing_flows_through_the_walls_of_a_double_gyre() -> None:
    along = np.linspace(0.0, 1.0, 101)
    for t in (0.0, 1234.0, 7777.0):
        for x in (50.0, 50.0 + 2.0 * GYRE.size):
            np.testing.assert_allclose(GYRE(x, GYRE.size * along, t)[0], 0.0, atol=1e-14)
        for y in (0.0, GYRE.size):
            np.testing.assert_allclose(GYRE(50.0 + 4000.0 * along, y, t)[1], 0.0, atol=1e-14)


def test_gyres_turn_against_each_other_and_their_border_swings() -> None:
    def middle(t: float) -> float:
        """Where the flow along the southern wall changes its sense, between the gyres."""
        x = np.linspace(1000.0, 3000.0, 20_001)
        u, _ = GYRE(x, 0.0, t)
        return float(x[np.abs(u).argmin()])

    assert middle(0.0) == pytest.approx(50.0 + GYRE.size, abs=0.2)
    assert middle(7500.0) < middle(0.0) - 200.0 < middle(0.0) + 200.0 < middle(2500.0)
    spin = gradient(GYRE, np.array([1050.0, 3050.0]), np.full(2, 1000.0), 0.0)
    west, east = spin[1, 0] - spin[0, 1]
    assert west == pytest.approx(-east)
    assert west < 0.0


@pytest.mark.parametrize("current", CURRENTS)
@pytest.mark.parametrize("shapes", [((), (), ()), ((3,), (), (2, 1)), ((1, 4), (5, 1), ())])
def test_positions_and_times_broadcast(
    current: Current, shapes: tuple[tuple[int, ...], ...]
) -> None:
    rng = np.random.default_rng(9)
    x, y, t = (rng.uniform(0.0, 3000.0, shape) for shape in shapes)
    wide = np.broadcast_arrays(x, y, t)
    u, v = current(x, y, t)
    assert np.shape(u) == np.shape(v) == wide[0].shape
    for index in np.ndindex(wide[0].shape):
        alone = current(*(float(part[index]) for part in wide))
        np.testing.assert_allclose((np.asarray(u)[index], np.asarray(v)[index]), alone, atol=1e-15)


@pytest.mark.parametrize("current", CURRENTS)
def test_asking_leaves_the_question_untouched(current: Current) -> None:
    x, y = points(10)
    before = x.copy(), y.copy()
    current(x, y, 5.0)
    np.testing.assert_array_equal((x, y), before)


def test_only_what_changes_is_unsteady() -> None:
    x, y = points(11)
    for current in CURRENTS:
        same = np.array_equal(current(x, y, 100.0), current(x, y, 3000.0))
        assert current.is_steady == same
    assert DoubleGyre(1.0, 100.0, epsilon=0.2).is_steady
    assert DoubleGyre(1.0, 100.0, omega=0.2).is_steady


def test_the_finest_part_sets_the_length_scale() -> None:
    assert Superposition((UniformCurrent(1.0, 0.0), VORTEX, GYRE)).length_scale == GYRE.size / 3.0
    assert vortices(12).length_scale == vortices(12).radius.min()
    assert Superposition((Shear(1e-3), UniformCurrent(1.0, 1.0))).length_scale == math.inf


@given(seed=st.integers(0, 2**32), x=st.floats(-1e9, 1e9), y=st.floats(-1e9, 1e9))
@settings(deadline=None, max_examples=50)
def test_a_field_is_no_faster_than_its_vortices_together(seed: int, x: float, y: float) -> None:
    many = vortices(seed)
    most = 0.6382 * np.abs(many.circulation) / (2.0 * math.pi * many.radius)
    assert np.hypot(*many(x, y)) <= most.sum() * (1.0 + 1e-4)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"radius": np.ones(3)}, "every vortex needs a centre"),
        ({"x": np.ones((2, 1))}, "every vortex needs a centre"),
        ({"radius": np.array([1.0, 0.0])}, "radius: a vortex needs a positive"),
        ({"radius": np.array([1.0, math.nan])}, "radius: a vortex needs a positive"),
        ({"y": np.array([math.nan, 1.0])}, "y: all must be finite"),
        ({"circulation": np.array([1.0, math.inf])}, "circulation: all must be finite"),
    ],
)
def test_impossible_vortices_are_refused(changes: dict[str, Floats], words: str) -> None:
    sound = {name: np.ones(2) for name in ("x", "y", "circulation", "radius")}
    with pytest.raises(InputError, match=words):
        LambVortices(**sound | changes)


def test_a_gyre_needs_room() -> None:
    with pytest.raises(InputError, match=r"size: 0.0: a gyre needs a positive size"):
        DoubleGyre(1.0, 0.0)
