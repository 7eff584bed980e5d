"""Picking up: what an idle node is worth to an AUV, (26) and (27).

Inserting node j at position i of the remaining route costs dt_i of the time in hand; its
effectiveness-cost ratio is

    psi_j = max over i of rho_j / dt_i,

over the positions at which the time in hand stays non-negative, and 0 where there is none.
An insertion that costs less than a second counts as one second, so that psi stays finite.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fiveroute.kernels import kernel
from fiveroute.sea.courses.course import Course, time_in_hand
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.stops import Ints, Stops, remove_stops

__all__ = ["Offers", "offers"]

Offers = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Ratios psi and positions of insertion, both in the order of the idle nodes."""


def offers(view: Outlook, course: Course, idle: NDArray[np.int64]) -> Offers:
    """Psi of every idle node in data per second, 0 where it does not fit, and where to insert it.

    Parameters
    ----------
    view
        What the AUVs expect.
    course
        What this AUV has before it.
    idle
        Idle nodes, shape (J,).
    """
    psi, place = np.zeros(len(idle)), np.zeros(len(idle), np.int64)
    stops = course.stops(view.destination)
    _offer(view, stops, len(stops) - 1, course.left, course.spread, idle, psi, place)
    return psi, place


@kernel
def _offer(
    view: Outlook,
    stops: Stops,
    length: int,
    left: float,
    spread: float,
    idle: Ints,
    psi: NDArray[np.float64],
    place: Ints,
) -> None:
    """Fill psi and place for a route with room for one stop more; stops end up as they were."""
    hand = time_in_hand(view, stops, length, left, spread)
    for k in range(len(idle)):
        node = idle[k]
        for at in range(length - 1, 0, -1):  # the node moves forward through the route
            if at == length - 1:
                stops[length] = stops[length - 1]
            else:
                stops[at + 1] = stops[at]
            stops[at] = node
            then = time_in_hand(view, stops, length + 1, left, spread)
            ratio = view.profit[node] / max(hand - then, 1.0)
            if then >= 0.0 and ratio > psi[k]:
                psi[k], place[k] = ratio, at - 1
        remove_stops(stops, length + 1, 1, 1)
