"""FTCMP-like: the fault-tolerant cooperative mission planner that the paper compares with.

The paper says of it that it coordinates tasks when a vehicle becomes stranded. The planner itself
could not be had in full; this is a reconstruction from what the paper says, and no reproduction.
The fleet sets out with k-means clusters and a route through each. When an AUV finds that time will
not suffice (24), it declares a fault and drops nodes of least phi. These, and the nodes of an AUV
that has failed, are handed over one by one, the richest first: to the AUV whose remaining route
passes nearest, if its time allows, else to the next. What nobody has time for is lost; time gained
is not used, and nodes that were left out before departure stay out.

Reference: S. MahmoudZadeh et al., "A cooperative fault-tolerant mission planner system for
unmanned surface vehicles in ocean sensor network monitoring and inspection", IEEE Transactions on
Vehicular Technology 72, 2023.
"""

from __future__ import annotations

import numpy as np

from fiveroute.routes import Route
from fiveroute.sea.courses.picking import offers
from fiveroute.sea.planners.all_knowing import AllKnowing

__all__ = ["Ftcmp"]


class Ftcmp(AllKnowing):
    """Steers the fleet of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV, after its faults are seen to."""
        abandoned = self.abandoned(t)
        _, dropped = self.discard(auv, t)
        self._hand_over(t, (*abandoned, *dropped), self.active)
        return self.depart(auv)

    def _hand_over(self, t: float, nodes: Route, fleet: list[int]) -> None:
        """Give each node to the nearest AUV that has the time."""
        for node in sorted(nodes, key=lambda node: -self.view.profit[node]):
            for m in sorted(fleet, key=lambda m: self._distance(m, node)):
                course = self.course(m, t)
                psi, place = offers(self.view, course, np.array([node]))
                if psi[0] > 0.0:
                    self.set_route(m, t, course.with_node(node, int(place[0])).route)
                    break

    def _distance(self, auv: int, node: int) -> float:
        """Least expected leg from what remains of a route to a node, in seconds."""
        stops = [self.run.vessels[auv].target, *self.routes[auv]]
        return float(self.view.legs[stops, node].min())
