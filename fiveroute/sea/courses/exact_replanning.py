"""The best courses of a fleet when few nodes are left, exactly.

Every AUV sails every order of nodes that its time allows, depth first; for each set of nodes V it
keeps the order that leaves most time in hand h_m(V). Sets are then shared out AUV by AUV,

    best_m(V) = max over U within V of best_(m-1)(V - U) + h_m(U),

over the U with h_m(U) >= 0, or empty: the way home is always open. Of all V the one with most
data is taken, and of these the one that leaves most time. An order is given up only when its
travel times alone exceed the time left, since nothing is assumed about the triangle inequality
and a node that divides a long leg may shorten the reserve.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.routes import Route
from fiveroute.sea.courses.course import Course, time_in_hand
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.stops import Ints

__all__ = ["EXACT", "best_courses"]

EXACT = 8
"""Most nodes for which all orders are sailed: 110,000 for an AUV that has time for all."""


def best_courses(view: Outlook, courses: Sequence[Course], nodes: Ints) -> tuple[Route, ...]:
    """The routes that collect most of some nodes, and of these the ones that leave most time.

    Parameters
    ----------
    view
        What the AUVs expect.
    courses
        Where and when every AUV begins; their routes do not count.
    nodes
        The nodes left, shape (J,), J at most about `EXACT`.
    """
    sets, fleet = 1 << len(nodes), len(courses)
    hands = np.full((fleet, sets), -np.inf)
    orders = np.zeros((fleet, sets, len(nodes)), np.int64)
    for m, course in enumerate(courses):
        _sail_all(view, course.anchor, course.left, course.spread, nodes, hands[m], orders[m])
    shares = _share_out(hands, view.profit[nodes])
    return tuple(
        tuple(orders[m, share, : int(share).bit_count()].tolist())
        for m, share in enumerate(shares.tolist())
    )


@kernel
def _sail_all(
    view: Outlook,
    anchor: int,
    left: float,
    spread: float,
    nodes: Ints,
    hands: NDArray[np.float64],
    orders: Ints,
) -> None:
    """Fill in for every set of nodes its greatest time in hand, and the order that has it."""
    count, home = len(nodes), len(view.profit) - 1
    stops, elapsed = np.full(count + 2, anchor), np.zeros(count + 1)
    tried = np.zeros(count + 1, np.int64)  # at each depth, the node to try next
    depth, chosen = 0, 0
    stops[1] = home
    hands[0] = time_in_hand(view, stops, 2, left, spread)
    while depth >= 0:
        k = tried[depth]
        if k == count:
            tried[depth] = 0
            if depth > 0:
                chosen ^= 1 << (tried[depth - 1] - 1)
            depth -= 1
            continue
        tried[depth] += 1
        then = elapsed[depth] + view.legs[stops[depth], nodes[k]]
        if chosen & (1 << k) or then > left + view.slack:
            continue
        depth += 1
        chosen |= 1 << k
        elapsed[depth], stops[depth], stops[depth + 1] = then, nodes[k], home
        hand = time_in_hand(view, stops, depth + 2, left, spread)
        if hand >= 0.0 and hand > hands[chosen]:
            hands[chosen] = hand
            orders[chosen, :depth] = stops[1 : depth + 1]


@kernel
def _share_out(hands: NDArray[np.float64], profit: NDArray[np.float64]) -> Ints:
    """The set of nodes of every AUV."""
    fleet, sets = hands.shape
    best, taken = np.full((fleet + 1, sets), -np.inf), np.zeros((fleet, sets), np.int64)
    best[0, 0] = 0.0
    for m in range(fleet):
        for whole in range(sets):
            part = whole
            while True:
                hand = best[m, whole ^ part] + hands[m, part]
                if hand > best[m + 1, whole]:
                    best[m + 1, whole], taken[m, whole] = hand, part
                if part == 0:
                    break
                part = (part - 1) & whole
    choice, most = 0, -1.0
    for whole in range(sets):
        data = 0.0
        for k in range(len(profit)):
            if whole & (1 << k):
                data += profit[k]
        better = data > most + 1e-12
        equal = data > most - 1e-12 and best[fleet, whole] > best[fleet, choice]
        if best[fleet, whole] > -np.inf and (better or equal):
            choice, most = whole, data
    shares = np.zeros(fleet, np.int64)
    for m in range(fleet - 1, -1, -1):
        shares[m] = taken[m, choice]
        choice ^= shares[m]
    return shares
