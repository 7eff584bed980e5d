"""The five-tiered planner with perfect communication: all AUVs know all, at once.

What `fiveroute.sea.planners.five_tier` could do if messages took no time and none was lost; the
difference is what the sea costs.
"""

from __future__ import annotations

from fiveroute.sea.planners.all_knowing import AllKnowing
from fiveroute.tiers.coordination import assign_idle_nodes

__all__ = ["OfOneMind"]


class OfOneMind(AllKnowing):
    """Steers the fleet of one run."""

    looks_ahead = True

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV, after the fleet has coordinated."""
        self.idle.update(self.abandoned(t))
        self.replan(auv, t, self.idle)
        active = self.active
        before = [self.course(m, t) for m in active]
        courses, awards = assign_idle_nodes(self.view, before, self.idle)
        self.idle.difference_update(award.node for award in awards)
        for m, course in zip(active, courses, strict=True):
            self.set_route(m, t, course.route)
        self.replan(auv, t, ())  # what it won are options like all others
        return self.depart(auv)
