"""Every AUV for itself: discards by (24) and (25), and picks up idle nodes without an auction.

Word of what is idle reaches everybody at once, and whoever comes first takes what suits it best.
The difference to the auction is what the auction is worth.
"""

from __future__ import annotations

from fiveroute.plan import Plan
from fiveroute.sea.course import Outlook
from fiveroute.sea.discarding import discard
from fiveroute.sea.picking import pick_up_alone
from fiveroute.sea.voyage import Voyage, course_of

__all__ = ["OwnPickUp"]


class OwnPickUp:
    """Steers the fleet of one run.

    Parameters
    ----------
    voyage
        The run.
    view
        What the AUVs expect.
    plan
        What they set out with.
    """

    def __init__(self, voyage: Voyage, view: Outlook, plan: Plan) -> None:
        self._voyage, self._view = voyage, view
        self._routes = list(plan.routes)
        self._idle = set(plan.idle(voyage.problem))

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        vessel = self._voyage.vessels[auv]
        vessel.target = vessel.at
        course, dropped = discard(self._view, course_of(self._view, vessel, t, self._routes[auv]))
        for node in dropped:
            self._voyage.note(t, auv, "discard", node)
        self._idle.update(dropped)
        course, picked = pick_up_alone(self._view, course, self._idle)
        for node in picked:
            self._voyage.note(t, auv, "pick_up", node)
        self._idle.difference_update(picked)
        first, *rest = (*course.route, self._voyage.problem.destination)
        self._routes[auv] = tuple(rest[:-1])
        return first

    def come_home(self, auv: int, t: float) -> None:
        """Nothing is left to do."""
