"""RMMP-like: the real-time mission-motion planner that the paper compares with.

The paper says of it that its upper level plans the route of each vehicle in real time, during the
voyage, from global information. The planner itself could not be had in full; this is a
reconstruction from what the paper says, and no reproduction. At every node all unvisited nodes are
shared out anew: each goes to the AUV whose position is nearest, distances being weighted by
remaining time (the Voronoi cells of a moving fleet). The AUV at the node then plans a short route
over the `HORIZON` nearest nodes of its cell, by the same search as the five-tiered planner's, and
sails to the first. Nobody plans further ahead, but everybody keeps the time to come home.

Reference: S. Sun, B. Song, P. Wang, H. Dong, X. Chen, "Real-time mission-motion planner for
multi-UUVs cooperative work using tri-level programing", IEEE Transactions on Intelligent
Transportation Systems 23(2), 2022.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fiveroute.plan import Route
from fiveroute.sea.planners.all_knowing import AllKnowing
from fiveroute.sea.replanning import replan

__all__ = ["HORIZON", "TRIALS", "Rmmp"]

HORIZON = 5
"""Nodes of the cell that a route is planned over."""

TRIALS = 100
"""Attempts to improve a route."""


class Rmmp(AllKnowing):
    """Steers the fleet of one run."""

    def steer(self, auv: int, t: float) -> int:
        """The next vertex of an AUV, planned from scratch."""
        here = replace(self.at_node(auv, t), route=())
        self._free(t)
        cell = self._cell(auv, t)
        nearest = sorted(cell, key=lambda node: self.view.legs[here.anchor, node])[:HORIZON]
        course, _ = replan(self.view, here, nearest, TRIALS, self.voyage.luck.run)
        self.routes[auv] = course.route
        self.idle.difference_update(course.route[:1])
        return self.depart(auv)

    def _free(self, t: float) -> None:
        """Nobody owns a node but the one it is under way to."""
        self.idle.update(self.abandoned(t), *self.routes)
        self.routes = [()] * len(self.routes)

    def _cell(self, auv: int, t: float) -> Route:
        """Idle nodes that are nearer to this AUV than to any other, remaining time considered."""
        idle, fleet = np.array(sorted(self.idle), dtype=np.int64), self.active
        vessels = self.voyage.vessels
        left = np.array([max(vessels[m].budget - self.course(m, t).time, 1.0) for m in fleet])
        distance = self.view.legs[[vessels[m].target for m in fleet]][:, idle]
        nearest = (distance / left[:, None]).argmin(axis=0)
        return tuple(idle[nearest == fleet.index(auv)].tolist())
