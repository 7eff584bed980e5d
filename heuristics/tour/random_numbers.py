"""Random integers inside kernels.

SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number
generators", OOPSLA 2014, doi 10.1145/2660193.2660195): one word of state, which the caller
seeds from its own generator, so that the same seed gives the same answer everywhere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel

__all__ = ["random_below", "random_state"]

_WEYL = np.uint64(0x9E3779B97F4A7C15)
_FIRST = np.uint64(0xBF58476D1CE4E5B9)
_SECOND = np.uint64(0x94D049BB133111EB)


def random_state(rng: np.random.Generator) -> NDArray[np.uint64]:
    """A state for `random_below`, shape (1,), drawn from `rng`."""
    return rng.integers(2**64, size=1, dtype=np.uint64)


@kernel
def random_below(state: NDArray[np.uint64], bound: int) -> int:
    """Draw an integer from 0 to `bound` - 1, which is below 2**32; advances `state`."""
    state[0] += _WEYL
    word = state[0]
    word = (word ^ (word >> np.uint64(30))) * _FIRST
    word = (word ^ (word >> np.uint64(27))) * _SECOND
    word ^= word >> np.uint64(31)
    drawn: int = np.int64(((word >> np.uint64(32)) * np.uint64(bound)) >> np.uint64(32))  # type: ignore[assignment]
    return drawn
