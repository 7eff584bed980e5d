"""Random vortices: their distributions, and how much they move the water."""

import math
from statistics import NormalDist

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.generate import CURRENTS, paper_scenario
from fiveroute.ocean.random_vortices import (
    EFFECTIVE,
    PRINTED,
    VortexKind,
    draw_vortices,
    normal,
)

SQUARE = (0.0, 0.0, 10_000.0, 10_000.0)


@pytest.mark.parametrize(
    ("kind", "speed", "spread", "others"),
    [(PRINTED, 0.01685, 0.0032, 0.016), (EFFECTIVE, 0.2125, 0.056, 0.19)],
)
def test_speeds_of_the_two_kinds(
    kind: VortexKind, speed: float, spread: float, others: float
) -> None:
    """The root mean square over 100 fields of twenty vortices, within four standard errors.

    `others` was found in twenty fields by an independent program.
    """
    rng, found = np.random.default_rng(1), []
    for _ in range(100):
        u, v = draw_vortices(kind, 20, SQUARE, rng)(*rng.uniform(0.0, 10_000.0, (2, 1500)))
        found.append(math.sqrt((u**2 + v**2).mean()))
    assert abs(np.mean(found) - speed) < 4.0 * spread / 100**0.5
    assert np.std(found) == pytest.approx(spread, rel=0.4)
    assert abs(np.mean(found) - others) < 2.5 * spread / 20**0.5


@pytest.mark.parametrize("kind", [PRINTED, EFFECTIVE])
def test_distributions(kind: VortexKind) -> None:
    """Means and standard deviations, within four standard errors."""
    count, (west, south, east, north) = 20_000, (-500.0, 100.0, 1500.0, 700.0)
    drawn = draw_vortices(kind, count, (west, south, east, north), np.random.default_rng(2))
    for sample, mean, deviation in (
        (drawn.x, (west + east) / 2.0, (east - west) / 12**0.5),
        (drawn.y, (south + north) / 2.0, (north - south) / 12**0.5),
        (drawn.circulation, kind.circulation.mean, kind.circulation.stdev),
        (drawn.radius, kind.radius.mean, kind.radius.stdev),
    ):
        assert abs(sample.mean() - mean) < 4.0 * deviation / count**0.5
        assert abs(sample.std() - deviation) < 4.0 * deviation / count**0.5
    assert west <= drawn.x.min() <= drawn.x.max() < east
    assert south <= drawn.y.min() <= drawn.y.max() < north


def test_kinds_share_centres_and_signs() -> None:
    weak, strong = (
        draw_vortices(kind, 20, SQUARE, np.random.default_rng(3)) for kind in (PRINTED, EFFECTIVE)
    )
    np.testing.assert_array_equal((weak.x, weak.y), (strong.x, strong.y))
    np.testing.assert_allclose(20.0 * weak.circulation, strong.circulation)
    np.testing.assert_allclose(10.0 * weak.radius, strong.radius)


def test_scenarios_are_drawn_from_the_same_kinds() -> None:
    assert CURRENTS == {"effective": EFFECTIVE, "printed": PRINTED, "none": None}
    stream = np.random.SeedSequence(7).spawn(3)[2]
    drawn = draw_vortices(EFFECTIVE, 20, SQUARE, np.random.Generator(np.random.PCG64(stream)))
    for i, vortex in enumerate(paper_scenario(7).ocean.currents.vortices):
        parts = drawn.x[i], drawn.y[i], drawn.circulation[i], drawn.radius[i]
        found = vortex.x, vortex.y, vortex.circulation, vortex.radius
        assert found == pytest.approx(parts, abs=5.1e-4)


def test_a_core_has_one_metre_at_least() -> None:
    tiny = VortexKind(NormalDist(0.0, 1.0), NormalDist(0.0, 2.0))
    radius = draw_vortices(tiny, 200, SQUARE, np.random.default_rng(4)).radius
    assert radius.min() == 1.0 < radius.max()


def test_no_vortex_may_be_drawn() -> None:
    assert len(draw_vortices(EFFECTIVE, 0, SQUARE, np.random.default_rng(5)).x) == 0


def test_a_uniform_number_becomes_a_normal_one() -> None:
    standard = NormalDist()
    assert normal(0.5, standard) == pytest.approx(0.0, abs=1e-15)
    assert normal(standard.cdf(1.3), standard) == pytest.approx(1.3)
    assert -9.0 < normal(0.0, standard) < -8.0  # not infinite
    assert 8.0 < normal(1.0, standard) < 9.0


@pytest.mark.parametrize(
    ("count", "region", "words"),
    [
        (-1, SQUARE, "count: -1: must not be negative"),
        (1, (1.0, 0.0, 0.0, 1.0), "region: .*must be a finite rectangle"),
        (1, (0.0, 0.0, math.inf, 1.0), "region: .*must be a finite rectangle"),
        (1, (0.0, math.nan, 1.0, 1.0), "region: .*must be a finite rectangle"),
    ],
)
def test_wrong_arguments_of_a_draw_are_refused(
    count: int, region: tuple[float, float, float, float], words: str
) -> None:
    with pytest.raises(InputError, match=words):
        draw_vortices(EFFECTIVE, count, region, np.random.default_rng(6))
