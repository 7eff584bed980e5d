"""Luck: the law (12) is kept, and the same arc has the same luck for all."""

import numpy as np
import pytest

from fiveroute.instance import Uncertainty
from fiveroute.sea.luck import Luck, leg_luck
from fiveroute.tiers.actuation import LegLaw, expected_legs, leg_law

U1 = Uncertainty(0.2, 0.5, 120.0, 0.2)


def law(minutes: float = 20.0, uncertainty: Uncertainty = U1) -> LegLaw:
    planned = np.full((62, 62), minutes * 60.0)
    return leg_law(planned, planned / 1000.0, uncertainty)


def sample(runs: int) -> np.ndarray:
    off = ~np.eye(62, dtype=bool)
    return np.concatenate([Luck(law(), 3, run).matrix()[off] for run in range(runs)])


def test_mean_and_variance_are_those_of_the_law() -> None:
    times = sample(50)
    mean, variance = (m[0, 1] for m in expected_legs(law()))
    error = np.sqrt(variance / len(times))
    assert abs(times.mean() - mean) < 4.0 * error
    assert times.var() == pytest.approx(variance, rel=4.0 * np.sqrt(2.2 / len(times)))


def test_neighbouring_arcs_and_runs_are_unrelated() -> None:
    one, two = Luck(law(), 3, 0).matrix(), Luck(law(), 3, 1).matrix()
    off = ~np.eye(62, dtype=bool)
    bound = 4.0 / np.sqrt(off.sum())
    assert abs(np.corrcoef(one[off], two[off])[0, 1]) < bound
    assert abs(np.corrcoef(one[:, 1:-1].ravel(), one[:, 2:].ravel())[0, 1]) < 0.1
    assert abs(np.corrcoef(one[off], one.T[off])[0, 1]) < bound


def test_an_arc_has_its_luck_whenever_it_is_asked() -> None:
    luck = Luck(law(), 7, 4)
    every = luck.matrix()
    assert [luck.leg(i, j)[0] for i, j in ((5, 9), (0, 61), (9, 5))] == [
        every[5, 9],
        every[0, 61],
        every[9, 5],
    ]
    assert leg_luck(law(), Luck(law(), 8, 4).key, 5, 9)[0] != luck.leg(5, 9).time


def test_without_uncertainty_legs_are_as_planned() -> None:
    calm = law(uncertainty=Uncertainty(0.0, 0.0, 0.0, 0.2))
    off = ~np.eye(62, dtype=bool)
    assert (Luck(calm, 1, 1).matrix()[off] == 1200.0).all()


def test_no_leg_is_shorter_than_the_floor() -> None:
    wild = law(uncertainty=Uncertainty(2.0, 0.0, 0.0, 0.3))
    off = ~np.eye(62, dtype=bool)
    assert Luck(wild, 1, 1).matrix()[off].min() == pytest.approx(360.0)
