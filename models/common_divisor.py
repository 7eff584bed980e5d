"""The grid on which all objective values lie, where the data allow one."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["common_divisor", "rounded_down"]

_DECIMALS = (1, 10, 100, 1000)


def common_divisor(profit: NDArray[np.float64]) -> float | None:
    """Largest number that divides all data with at most three decimals; None without one.

    Every objective is then a multiple of it, up to the rounding of sums.
    """
    positive = profit[profit > 0.0]
    if positive.size and positive.max() < 1e9:
        for scale in _DECIMALS:
            whole = np.rint(positive * scale)
            if (np.abs(positive * scale - whole) <= 1e-12 * whole).all():
                return math.gcd(*whole.astype(np.int64).tolist()) / scale
    return None


def rounded_down(bound: float, profit: NDArray[np.float64]) -> float:
    """The largest value that an objective of at most `bound` can have."""
    step = common_divisor(profit)
    if step is None or not math.isfinite(bound):
        return bound
    return math.floor(bound / step * (1.0 + 1e-12) + 1e-9) * step
