"""The grid on which all objective values lie, where the data allow one."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fiveroute.result import PROOF_TOLERANCE

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
    """The largest value that an objective of at most `bound` can have.

    Without a grid that is all there is to say, but for one thing: an objective is 0 or no less
    than the least data of a node.
    """
    if 0.0 <= bound < (1.0 - PROOF_TOLERANCE) * profit.min(initial=np.inf, where=profit > 0.0):
        return 0.0
    step = common_divisor(profit)
    if step is None or not math.isfinite(bound):
        return bound
    return math.floor(bound / step * (1.0 + 1e-12) + 1e-9) * step
