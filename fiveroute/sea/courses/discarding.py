"""Discarding: what an AUV leaves out when its time runs short, (24) and (25).

Whenever the time in hand is negative, the node of least effectiveness-cost ratio

    phi_i = rho_i / dt_i

is left out, and ratios are computed anew, until the time suffices. dt_i is the time in hand that
this gains: without a reserve, the travel and service time saved; with one, less for a node that
divides a long leg into two whose luck may even out. Of equal ratios the greater gain goes first; a
node whose absence gains nothing stays.
"""

from __future__ import annotations

import math
from dataclasses import replace

from fiveroute.kernels import kernel
from fiveroute.routes import Route
from fiveroute.sea.courses.course import Course, time_in_hand
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.stops import Stops, remove_stops

__all__ = ["discard", "shed"]


def discard(view: Outlook, course: Course) -> tuple[Course, Route]:
    """Shorten a course until its time suffices, or nothing is left that saves any.

    Returns
    -------
    course
        The shortened course.
    discarded
        The nodes left out, in ascending order.
    """
    stops = course.stops(view.destination)
    length = shed(view, stops, len(stops) - 1, course.left, course.spread)
    if length == len(stops) - 1:
        return course, ()
    kept = tuple(stops[1 : length - 1].tolist())
    return replace(course, route=kept), tuple(sorted(set(course.route) - set(kept)))


@kernel
def shed(view: Outlook, stops: Stops, length: int, left: float, spread: float) -> int:
    """Leave nodes out in place until the time suffices; returns the new length."""
    hand = time_in_hand(view, stops, length, left, spread)
    while length > 2 and hand < 0.0:
        worst, hand = _worst(view, stops, length, left, spread, hand)
        if worst == 0:
            break
        length = remove_stops(stops, length, worst, 1)
    return length


@kernel
def _worst(
    view: Outlook, stops: Stops, length: int, left: float, spread: float, hand: float
) -> tuple[int, float]:
    """Position of the node of least phi, 0 where none saves time, and the time then in hand."""
    worst, least, most = 0, math.inf, hand
    fewer = stops[: length - 1].copy()
    fewer[1:] = stops[2:length]  # without the first node
    for at in range(1, length - 1):
        then = time_in_hand(view, fewer, length - 1, left, spread)
        fewer[at] = stops[at]
        if then - hand <= 1e-9 * left:
            continue
        phi = view.profit[stops[at]] / (then - hand)
        if phi < least or (phi == least and then > most):
            worst, least, most = at, phi, then
    return worst, most
