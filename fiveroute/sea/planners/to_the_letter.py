"""The paper's fifth tier to the letter, with perfect communication.

The AUV at a node discards (25), and then all idle nodes are auctioned among all AUVs
(`fiveroute.tiers.coordination`). Nothing is planned anew on board.
"""

from __future__ import annotations

from fiveroute.sea.planners.all_knowing import AllKnowing
from fiveroute.tiers.coordination import coordinate

__all__ = ["ToTheLetter"]


class ToTheLetter(AllKnowing):
    """Steers the fleet of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV, after the fleet has coordinated."""
        self.idle.update(self.abandoned(t))
        here = self.at_node(auv, t)
        active = self.active
        before = [here if m == auv else self.course(m, t) for m in active]
        courses, dropped, awards = coordinate(self.view, before, active.index(auv), self.idle)
        for node in dropped:
            self.run.note(t, auv, "discard", node)
        self.idle.update(dropped)
        self.idle.difference_update(award.node for award in awards)
        for m, course in zip(active, courses, strict=True):
            self.set_route(m, t, course.route)
        return self.depart(auv)
