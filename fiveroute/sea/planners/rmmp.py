"""RMMP-like: the real-time mission-motion planner that the paper compares with.

The paper says of it that its upper level plans the route of each vehicle in real time, during the
voyage, from global information. The planner itself could not be had in full; this is a
reconstruction from what the paper says, and no reproduction. The fleet sets out with Voronoi
cells. At every node all unvisited nodes are shared out anew, to the AUV that passes nearest on
what it has left of its route, distances being weighted by remaining time (the Voronoi cells of a
moving fleet); the AUV at the node then plans its whole route over its cell again, by the search of
`fiveroute.sea.courses.replanning`. With a horizon of some nodes only, or with cells about
positions instead of routes, it collects less.

Reference: S. Sun, B. Song, P. Wang, H. Dong, X. Chen, "Real-time mission-motion planner for
multi-UUVs cooperative work using tri-level programing", IEEE Transactions on Intelligent
Transportation Systems 23(2), 2022.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fiveroute.sea.courses.replanning import TRIALS, replan
from fiveroute.sea.planners.all_knowing import AllKnowing
from fiveroute.sea.seeds import decision_seed

__all__ = ["Rmmp"]


class Rmmp(AllKnowing):
    """Steers the fleet of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV, its route planned anew."""
        self.idle.update(self.abandoned(t))
        course = self.at_node(auv, t)
        cell = self._cell(auv, t)
        own = tuple(node for node in course.route if node in cell)
        seed = decision_seed(self.run.luck.run, auv)
        better, _ = replan(self.view, replace(course, route=own), cell, TRIALS, seed)
        self.idle.update(cell, course.route)
        self.idle.difference_update(better.route)
        for m in self.active:
            if m != auv:
                self.routes[m] = tuple(node for node in self.routes[m] if node not in cell)
        self.routes[auv] = better.route
        return self.depart(auv)

    def _cell(self, auv: int, t: float) -> set[int]:
        """Unvisited nodes that lie nearest to what this AUV has before it."""
        fleet, vessels = self.active, self.run.vessels
        nodes = np.array(sorted(self.idle.union(*(self.routes[m] for m in fleet))), dtype=np.int64)
        distance = np.empty((len(fleet), len(nodes)))
        for k, m in enumerate(fleet):
            stops = [vessels[m].target, *self.routes[m]]
            left = max(vessels[m].budget - self.course(m, t).time, 1.0)
            distance[k] = self.view.legs[stops][:, nodes].min(axis=0) / left
            distance[k, np.isin(nodes, self.routes[m])] = 0.0
        return set(nodes[distance.argmin(axis=0) == fleet.index(auv)].tolist())
