"""What an AUV has of its own: its vessel, its book of nodes, its radio and its expectations.

Everything that an agent does it does with these: it asks what nodes are worth on the course before
it, speaks, sets itself a time, and writes into the log. Nothing here decides anything.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass

import numpy as np

from fiveroute.sea.agents.channel import Radio
from fiveroute.sea.agents.holdings import Holdings
from fiveroute.sea.agents.messages import Message, Report
from fiveroute.sea.courses.course import Course
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.picking import Offers, offers
from fiveroute.sea.events import Kind
from fiveroute.sea.run import Run, Vessel, course_of

__all__ = ["OwnShip"]


@dataclass(slots=True)
class OwnShip:
    """One AUV as it sees itself.

    Parameters
    ----------
    number
        The AUV, counted from 0.
    run
        The run; the AUV looks at its own vessel only.
    radio
        The channel.
    view
        What it expects of the legs.
    holdings
        The nodes that it has to do with.
    reported
        Time in seconds of its last report.
    """

    number: int
    run: Run
    radio: Radio
    view: Outlook
    holdings: Holdings
    reported: float = 0.0

    @property
    def vessel(self) -> Vessel:
        """Where it really is."""
        return self.run.vessels[self.number]

    @property
    def is_homebound(self) -> bool:
        """Whether it has set out for the destination, or is there."""
        return self.vessel.target == self.run.problem.destination

    def course(self, t: float) -> Course:
        """What it has before it."""
        return course_of(self.view, self.vessel, t, tuple(self.holdings.route))

    def worth(self, t: float, nodes: Collection[int]) -> Offers:
        """Psi of nodes and where it would insert them; 0 once it sails home."""
        idle = np.array(list(nodes), dtype=np.int64)
        if self.is_homebound:
            return np.zeros(len(idle)), np.zeros(len(idle), np.int64)
        return offers(self.view, self.course(t), idle)

    def insert_best(self, t: float, node: int) -> None:
        """Put a node into the route, where it costs least."""
        _, place = self.worth(t, [node])
        self.holdings.route.insert(int(place[0]), node)
        self.note(t, "pick_up", node)

    def report(self, t: float) -> None:
        """Tell everybody what is its own, idle, and done."""
        own = self.holdings
        idle, done = frozenset(own.kept), frozenset(own.done)
        self.reported = t
        self.say(
            t,
            Report(self.number, None, own.mine, idle, done, self.is_homebound, self.vessel.is_home),
        )

    def say(self, t: float, message: Message) -> None:
        """Send a message, when its turn comes."""
        self.radio.send(t, message)

    def later(self, t: float, action: Callable[[float], None]) -> None:
        """Do something at a time, if it still works then."""

        def act(now: float) -> None:
            if self.vessel.is_alive:
                action(now)

        self.run.schedule(t, act)

    def note(self, t: float, kind: Kind, node: int) -> None:
        """Write into the log of the run."""
        self.run.note(t, self.number, kind, node)
