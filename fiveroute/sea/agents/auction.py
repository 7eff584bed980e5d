"""The auction of idle nodes, (28) and (29), after Bertsekas.

Node j has a price p_j, zero at first. An AUV m that holds no node bids for the one of greatest
profit psi_mj - p_j, if any profit is positive, and raises its price by

    best profit - second best profit + epsilon,

the most that it can pay without regret; not to take part is an alternative of profit 0. Whoever
held the node before bids again. All start without a node, so an uncontested node goes for its
opening bid. It ends when nobody who is without a node finds a profit: every bid raises a price by
epsilon at least, and no price can exceed max psi + epsilon, so there are J (1 + max psi / epsilon)
bids at most. The sum of psi is then within min(M, J) epsilon of the best assignment
(epsilon-complementary slackness; prices start at 0, so a node without a bidder costs nothing).

References
----------
D. P. Bertsekas, "A distributed algorithm for the assignment problem", LIDS-P-1908, MIT, 1989
(first 1979); "Auction algorithms for network flow problems", LIDS-P-2108, MIT, 1992.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fiveroute.errors import InputError
from fiveroute.kernels import kernel

__all__ = ["EPSILON", "assign_by_auction"]

EPSILON = 1e-3
"""Default of epsilon, as a share of the greatest psi."""


def assign_by_auction(psi: ArrayLike, epsilon: float | None = None) -> NDArray[np.int64]:
    """Give each AUV one node at most, and each node to one AUV at most.

    Parameters
    ----------
    psi
        What every node is worth to every AUV, shape (M, J), finite; 0 where it cannot take it.
    epsilon
        Least rise of a price, in the unit of psi; None takes `EPSILON` of the greatest psi.

    Returns
    -------
    array
        The node of every AUV, shape (M,); -1 for none.
    """
    values = np.ascontiguousarray(psi, dtype=np.float64)
    if not np.isfinite(values).all():
        raise InputError("must be finite", field="psi")
    greatest = float(values.max(initial=0.0))
    if greatest <= 0.0:
        return np.full(len(values), -1)
    rise = EPSILON * greatest if epsilon is None else epsilon
    if not rise > 0.0:
        raise InputError("must be positive, or bidding may never end", field="epsilon", value=rise)
    return _bid(values, rise)


@kernel
def _bid(psi: NDArray[np.float64], epsilon: float) -> NDArray[np.int64]:
    fleet, nodes = psi.shape
    price = np.zeros(nodes)
    holder = np.full(nodes, -1)
    held = np.full(fleet, -1)
    waiting = list(range(fleet - 1, -1, -1))
    while len(waiting):
        m = waiting.pop()
        best, second, choice = 0.0, 0.0, -1
        for j in range(nodes):
            profit = psi[m, j] - price[j]
            if profit > best:
                best, second, choice = profit, best, j
            elif profit > second:
                second = profit
        if choice < 0:
            continue
        price[choice] += best - second + epsilon
        rival = holder[choice]
        if rival >= 0:
            held[rival] = -1
            waiting.append(rival)
        holder[choice] = m
        held[m] = choice
    return held
