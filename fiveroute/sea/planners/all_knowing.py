"""What planners have in common that know all, at once: routes, idle nodes, and who has failed.

The planners of the literature do not say how word gets round; here it gets round without
delay or loss, which is more than any fleet under water has.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import ClassVar

from fiveroute.routes import Plan, Route
from fiveroute.sea.agents.teammates import SILENCE
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.discarding import discard
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import reconsider, with_recourse
from fiveroute.sea.run import Run, course_of

__all__ = ["AllKnowing"]


class AllKnowing:
    """The state of a fleet that knows all.

    Parameters
    ----------
    run
        The run.
    view
        What the AUVs expect.
    plan
        What they set out with.
    """

    looks_ahead: ClassVar[bool] = False
    """Whether it calls `replan`, and so keeps the reserve of those that look ahead."""

    def __init__(self, run: Run, view: Outlook, plan: Plan) -> None:
        self.run = run
        self.view = with_recourse(view) if self.looks_ahead else view
        self.routes: list[Route] = list(plan.routes)
        self.idle = set(plan.idle(run.problem))

    @property
    def destination(self) -> int:
        """The destination vertex."""
        return self.run.problem.destination

    @property
    def active(self) -> list[int]:
        """AUVs that may still take a node."""
        vessels = self.run.vessels
        return [m for m, v in enumerate(vessels) if v.is_active and v.target != self.destination]

    def course(self, auv: int, t: float) -> Course:
        """What an AUV has before it."""
        return course_of(self.view, self.run.vessels[auv], t, self.routes[auv])

    def at_node(self, auv: int, t: float) -> Course:
        """What an AUV has before it that has just reached a node."""
        vessel = self.run.vessels[auv]
        vessel.target = vessel.at
        return self.course(auv, t)

    def discard(self, auv: int, t: float) -> tuple[Course, Route]:
        """Shorten the course of an AUV at a node, (24) and (25)."""
        course, dropped = discard(self.view, self.at_node(auv, t))
        self.routes[auv] = course.route
        for node in dropped:
            self.run.note(t, auv, "discard", node)
        return course, dropped

    def replan(self, auv: int, t: float, idle: Collection[int]) -> None:
        """Let an AUV at a node look ahead, its own and some idle nodes being its options."""
        before = self.at_node(auv, t)
        after, left_over = reconsider(self.view, before, idle)
        dropped = set(before.route).intersection(left_over)
        for node in sorted(dropped):
            self.run.note(t, auv, "discard", node)
        self.set_route(auv, t, after.route)
        self.idle.update(dropped)
        self.idle.difference_update(after.route)

    def set_route(self, auv: int, t: float, route: Route) -> None:
        """Give an AUV another route; what is new on it has been picked up."""
        for node in sorted(set(route) - set(self.routes[auv])):
            self.run.note(t, auv, "pick_up", node)
        self.routes[auv] = route

    def abandoned(self, t: float) -> Route:
        """Take the nodes of AUVs that failed long enough ago to be noticed off their routes."""
        nodes: list[int] = []
        for m, vessel in enumerate(self.run.vessels):
            if vessel.is_alive or t < self.run.failures[m] + SILENCE:
                continue
            if vessel.target not in (vessel.at, self.destination):
                nodes.append(vessel.target)
            nodes += self.routes[m]
            self.routes[m], vessel.target = (), vessel.at
        return tuple(nodes)

    def depart(self, auv: int) -> int:
        """Take the first node off the route of an AUV: where it sails to next."""
        first, *rest = (*self.routes[auv], self.destination)
        self.routes[auv] = tuple(rest[:-1])
        return first

    def come_home(self, auv: int, t: float) -> None:
        """Nothing is left to do."""
