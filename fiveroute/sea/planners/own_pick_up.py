"""Every AUV for itself: it looks ahead over its own and all idle nodes, without an auction.

Word of what is idle reaches everybody at once, and whoever comes first takes what suits it best.
The difference to `fiveroute.sea.planners.of_one_mind` is what the auction is worth.
"""

from __future__ import annotations

from fiveroute.sea.planners.all_knowing import AllKnowing

__all__ = ["OwnPickUp"]


class OwnPickUp(AllKnowing):
    """Steers the fleet of one run."""

    looks_ahead = True

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV."""
        self.idle.update(self.abandoned(t))
        self.replan(auv, t, self.idle)
        return self.depart(auv)
