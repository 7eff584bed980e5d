"""Every AUV for itself: discards by (24) and (25), and picks up idle nodes without an auction.

Word of what is idle reaches everybody at once, and whoever comes first takes what suits it best.
The difference to the auction is what the auction is worth.
"""

from __future__ import annotations

from fiveroute.sea.picking import pick_up_alone
from fiveroute.sea.planners.all_knowing import AllKnowing

__all__ = ["OwnPickUp"]


class OwnPickUp(AllKnowing):
    """Steers the fleet of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        self.idle.update(self.abandoned(t))
        course, dropped = self.discard(auv, t)
        self.idle.update(dropped)
        course, picked = pick_up_alone(self.view, course, self.idle)
        self.idle.difference_update(picked)
        self.set_route(auv, t, course.route)
        return self.depart(auv)
