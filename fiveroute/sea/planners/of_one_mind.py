"""The five-tiered planner with perfect communication: all AUVs know all, at once.

What the auction could do if messages took no time and none was lost; the difference to
`fiveroute.sea.planners.five_tier` is what the sea costs.
"""

from __future__ import annotations

from fiveroute.plan import Plan
from fiveroute.sea.course import Outlook
from fiveroute.sea.voyage import Voyage, course_of
from fiveroute.tiers.coordination import coordinate

__all__ = ["OfOneMind"]


class OfOneMind:
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
        """The next vertex of an AUV, after the fleet has coordinated."""
        voyage, end = self._voyage, self._voyage.problem.destination
        voyage.vessels[auv].target = voyage.vessels[auv].at
        active = [m for m, v in enumerate(voyage.vessels) if v.is_active and v.target != end]
        before = [course_of(self._view, voyage.vessels[m], t, self._routes[m]) for m in active]
        courses, dropped, awards = coordinate(self._view, before, active.index(auv), self._idle)
        for node in dropped:
            voyage.note(t, auv, "discard", node)
        for award in awards:
            voyage.note(t, active[award.auv], "pick_up", award.node)
        self._idle = {*self._idle, *dropped} - {award.node for award in awards}
        for m, course in zip(active, courses, strict=True):
            self._routes[m] = course.route
        first, *rest = (*self._routes[auv], end)
        self._routes[auv] = tuple(rest[:-1])
        return first

    def come_home(self, auv: int, t: float) -> None:
        """Nothing is left to do."""
