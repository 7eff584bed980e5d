"""Re-optimisation: at every node of any AUV, the whole remaining problem is solved anew.

All AUVs know all at once, and all unvisited nodes may go to any of them: whatever the plan said,
the fleet takes the routes that are best from where it is, by the expected leg times and with the
reserve kept (`fiveroute.sea.courses.fleet_replanning`). No coordination over messages can expect
more from what it knows; what remains between this and the clairvoyant plan is the price of not
knowing the luck to come. It takes seconds a mission.
"""

from __future__ import annotations

from fiveroute.sea.courses.fleet_replanning import replan_fleet
from fiveroute.sea.planners.all_knowing import AllKnowing
from fiveroute.sea.seeds import decision_seed

__all__ = ["ReOptimising"]


class ReOptimising(AllKnowing):
    """Steers the fleet of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV, after the fleet has been planned anew."""
        self.idle.update(self.abandoned(t))
        here, active = self.at_node(auv, t), self.active
        courses = [here if m == auv else self.course(m, t) for m in active]
        seed = decision_seed(self.run.luck.run, len(self.run.log))
        routes = replan_fleet(self.view, courses, self.idle, seed)
        had = self.idle.union(*(course.route for course in courses))
        before, after = had - self.idle, set[int]().union(*routes)
        self.idle = had - after
        for node in sorted(before - after):
            self.run.note(t, auv, "discard", node)
        for m, route in zip(active, routes, strict=True):
            self.set_route(m, t, route)
        return self.depart(auv)
