"""The random numbers of kernels: known values, range and evenness."""

import numpy as np

from fiveroute.randomness import below, random_state, uniform


def test_the_published_sequence() -> None:
    """SplitMix64 from seed 1234567, first outputs of its reference implementation."""
    state = np.array([1234567], np.uint64)
    expected = [6457827717110365317, 3203168211198807973, 9817491932198370423]
    assert [uniform(state) for _ in range(3)] == [(word >> 11) * 2.0**-53 for word in expected]


def test_states_come_from_the_generator() -> None:
    one, two = random_state(np.random.default_rng(1)), random_state(np.random.default_rng(1))
    assert one == two
    assert one != random_state(np.random.default_rng(2))


def test_uniform_numbers_are_uniform() -> None:
    state = random_state(np.random.default_rng(3))
    drawn = np.array([uniform(state) for _ in range(20_000)])
    assert (drawn >= 0.0).all()
    assert (drawn < 1.0).all()
    assert abs(drawn.mean() - 0.5) < 3.0 * (1.0 / 12.0 / 20_000) ** 0.5


def test_integers_are_even() -> None:
    state = random_state(np.random.default_rng(4))
    counts = np.bincount([below(state, 7) for _ in range(7_000)], minlength=7)
    assert len(counts) == 7
    assert abs(counts - 1_000).max() < 120
