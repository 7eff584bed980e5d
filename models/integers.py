"""Real numbers as integers, for solvers that know nothing else.

Numbers with few decimals are multiplied by a power of ten and stay exact. All others are
multiplied so finely that what rounding loses lies far below the tolerance of a proof.
Whoever rounds states the direction, so that the integer problem is always a relaxation of
the real one; `ROUNDING` is the slack that covers the arithmetic itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["ROUNDING", "round_down", "round_up", "units_per_one"]

ROUNDING = 1e-9
"""How far, in units, a rounded number may lie on the wrong side of the real one."""

_MOST_DECIMALS = 6
_FINEST = 1e18


def units_per_one(values: NDArray[np.float64], whole: float, most: float) -> float:
    """How many integer units one real unit gets.

    Parameters
    ----------
    values
        Numbers to be rounded.
    whole
        Bound on any sum of them that matters, positive.
    most
        Units that `whole` may have.
    """
    for decimals in range(_MOST_DECIMALS + 1):
        units = 10.0**decimals
        if units * whole > most:
            break
        scaled = units * values
        if (np.abs(scaled - np.rint(scaled)) <= ROUNDING * np.minimum(scaled, 1.0)).all():
            return units
    return min(most / whole, _FINEST)


def round_down(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Greatest integers below, but for `ROUNDING`."""
    return np.floor(values + ROUNDING).astype(np.int64)


def round_up(values: NDArray[np.float64]) -> NDArray[np.int64]:
    """Least integers above, but for `ROUNDING`."""
    return np.ceil(values - ROUNDING).astype(np.int64)
