"""Random numbers inside kernels.

A kernel cannot take a `numpy.random.Generator`. It takes a state array of one 64-bit
integer, seeded from a generator by `random_state`, and draws from it with SplitMix64
(Steele, Lea, Flood 2014, doi 10.1145/2660193.2660195): the same seed gives the same
numbers on every machine, and no two callers share a state.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["RandomState", "below", "random_state", "uniform"]

RandomState = NDArray[np.uint64]
"""State of one stream, shape (1,); every draw advances it."""


def random_state(rng: np.random.Generator) -> RandomState:
    """A fresh stream for kernels, its seed drawn from `rng`."""
    return rng.integers(0, 2**64, size=1, dtype=np.uint64)


@kernel
def uniform(state: RandomState) -> float:
    """A number of the uniform distribution on [0, 1)."""
    state[0] += np.uint64(0x9E3779B97F4A7C15)
    mixed = state[0]
    mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    mixed = mixed ^ (mixed >> np.uint64(31))
    return float(mixed >> np.uint64(11)) * 2.0**-53


@kernel
def below(state: RandomState, size: int) -> int:
    """One of the integers 0 to size - 1, all equally likely."""
    return int(uniform(state) * size)
