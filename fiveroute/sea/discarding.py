"""Discarding: what an AUV leaves out when its time runs short, (24) and (25).

Whenever the time in hand is negative, the node of least effectiveness-cost ratio

    phi_i = rho_i / dt_i

is left out, dt_i being the time that this saves, and ratios are computed anew, until the time
suffices. Of equal ratios the greater saving goes first; a node whose absence saves no time stays.
A next node from which the way home would be too risky is left out before all others.
"""

from __future__ import annotations

import math
from dataclasses import replace

from fiveroute.kernels import kernel
from fiveroute.plan import Route
from fiveroute.sea.course import Course, Outlook, Stops, time_in_hand

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
    stops = course.stops(len(view.profit) - 1)
    length = shed(view, stops, len(stops) - 1, course.budget - course.time, course.spread)
    if length == len(stops) - 1:
        return course, ()
    kept = tuple(stops[1 : length - 1].tolist())
    return replace(course, route=kept), tuple(sorted(set(course.route) - set(kept)))


@kernel
def shed(view: Outlook, stops: Stops, length: int, left: float, spread: float) -> int:
    """Leave nodes out in place until the time suffices; returns the new length."""
    while length > 2 and time_in_hand(view, stops, length, left, spread) < 0.0:
        worst = 1 if _is_risky(view, stops, length, left) else _worst(view, stops, length)
        if worst == 0:
            break
        for at in range(worst, length - 1):
            stops[at] = stops[at + 1]
        length -= 1
    return length


@kernel
def _is_risky(view: Outlook, stops: Stops, length: int, left: float) -> bool:
    """Whether the direct way home over the next node alone is too risky."""
    here, first, end = stops[0], stops[1], stops[length - 1]
    risk = view.variance[here, first] + view.variance[first, end]
    needed = view.legs[here, first] + view.legs[first, end]
    direct = view.legs[here, end]
    is_detour = needed > direct
    return bool(is_detour and left - needed - view.hard * math.sqrt(risk) + view.slack < 0.0)


@kernel
def _worst(view: Outlook, stops: Stops, length: int) -> int:
    """Position of the node of least phi; 0 where none saves time."""
    worst, least, most = 0, math.inf, 0.0
    for at in range(1, length - 1):
        before, node, after = stops[at - 1], stops[at], stops[at + 1]
        saved = view.legs[before, node] + view.legs[node, after] - view.legs[before, after]
        if saved <= 0.0:
            continue
        phi = view.profit[node] / saved
        if phi < least or (phi == least and saved > most):
            worst, least, most = at, phi, saved
    return worst
