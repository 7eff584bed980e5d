"""An AUV as an agent: it knows what it has sensed and what has reached it, and no more.

At a node it compares its remaining route with the time left (24), discards what does not fit
(25), looks for a better course over what is its own (`fiveroute.sea.replanning`), and reports. What
it keeps idle it offers (`fiveroute.sea.auctioneer`), what others offer it bids for
(`fiveroute.sea.bidder`), and what a silent teammate leaves behind it may take over
(`fiveroute.sea.watch`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection

import numpy as np

from fiveroute.sea.auctioneer import Auctioneer
from fiveroute.sea.bidder import Bidder
from fiveroute.sea.channel import Radio
from fiveroute.sea.course import Course, Outlook
from fiveroute.sea.events import Kind
from fiveroute.sea.holdings import Holdings
from fiveroute.sea.messages import (
    Accept,
    Award,
    Bid,
    Call,
    Confirm,
    Decline,
    Inquiry,
    Message,
    Reply,
    Report,
    Void,
    Wish,
)
from fiveroute.sea.picking import Offers, offers
from fiveroute.sea.recourse import reconsider
from fiveroute.sea.voyage import Voyage, course_of
from fiveroute.sea.watch import Watch

__all__ = ["BEAT", "Agent"]

BEAT = 900.0
"""Longest time in seconds from one report of an AUV to the next."""


class Agent:
    """One AUV.

    Parameters
    ----------
    number
        The AUV, counted from 0.
    voyage
        The run; the agent looks at its own vessel only.
    radio
        The channel.
    view
        What it expects of the legs.
    holdings
        What it sets out with.
    estates, silence, tell
        See `Watch`.
    """

    def __init__(
        self,
        number: int,
        voyage: Voyage,
        radio: Radio,
        view: Outlook,
        holdings: Holdings,
        estates: dict[int, frozenset[int]],
        silence: float,
        tell: Callable[[int, int], None],
    ) -> None:
        self.number, self.radio, self.view, self.holdings = number, radio, view, holdings
        self.auctioneer, self.bidder = Auctioneer(self), Bidder(self)
        self.watch = Watch(self, dict(estates), silence, tell)
        self._voyage, self._vessel = voyage, voyage.vessels[number]
        self._reported = 0.0
        self.later(BEAT, self._beat)

    @property
    def is_homebound(self) -> bool:
        """Whether it has set out for the destination, or is there."""
        return self._vessel.target == self._voyage.problem.destination

    def course(self, t: float) -> Course:
        """What it has before it."""
        return course_of(self.view, self._vessel, t, tuple(self.holdings.route))

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

    def steer(self, t: float) -> int:
        """The next vertex, now that it is done where it is."""
        own, vessel = self.holdings, self._vessel
        vessel.target = vessel.at
        if own.target is not None:
            own.done.add(own.target)
            own.target = None
        self._replan(t)
        while own.route and own.route[0] in own.pledged:
            self._drop(t, own.route[:1])  # its turn has come before its confirmation
        own.target = own.route.pop(0) if own.route else None
        vessel.left = t
        vessel.target = self._voyage.problem.destination if own.target is None else own.target
        self.report(t)
        self.auctioneer.open(t)
        self.bidder.wish(t)
        return vessel.target

    def come_home(self, t: float) -> None:
        """It has reached the destination; what it keeps it goes on offering."""
        self.report(t)
        self.auctioneer.open(t)

    def hear(self, t: float, message: Message) -> None:
        """React to a message."""
        self.watch.heard(t, message.sender)
        match message:
            case Report():
                self.watch.on_report(message)
                self.bidder.on_report(message)
                self.auctioneer.on_report(message)
            case Wish():
                self.auctioneer.on_wish(t, message)
            case Call():
                self.bidder.on_call(t, message)
            case Bid():
                self.auctioneer.on_bid(t, message)
            case Award():
                self.bidder.on_award(t, message)
            case Accept():
                self.auctioneer.on_accept(t, message)
            case Decline():
                self.auctioneer.on_decline(t, message)
            case Confirm():
                self.bidder.on_confirm(t, message)
            case Void():
                self.bidder.on_void(t, message)
            case Inquiry():
                self.watch.on_inquiry(t, message)
            case Reply():
                self.watch.on_reply(t, message)

    def report(self, t: float) -> None:
        """Tell everybody what is its own, idle, and done."""
        own, vessel = self.holdings, self._vessel
        idle, done = frozenset(own.kept), frozenset(own.done)
        self._reported = t
        self.say(
            t,
            Report(self.number, None, own.mine, idle, done, self.is_homebound, vessel.is_home),
        )

    def say(self, t: float, message: Message) -> None:
        """Send a message, when its turn comes."""
        self.radio.send(t, message)

    def later(self, t: float, action: Callable[[float], None]) -> None:
        """Do something at a time, if it still works then."""

        def act(now: float) -> None:
            if self._vessel.is_alive:
                action(now)

        self._voyage.plan(t, act)

    def note(self, t: float, kind: Kind, node: int) -> None:
        """Write into the log of the run."""
        self._voyage.note(t, self.number, kind, node)

    def _replan(self, t: float) -> None:
        """(24) to (27) for itself alone: the best course over the nodes that are its own."""
        own, course = self.holdings, self.course(t)
        better, left_over = reconsider(self.view, course, own.kept)
        picked = own.kept.intersection(better.route)
        self._drop(t, sorted(set(course.route).intersection(left_over)))
        own.route[:] = better.route
        own.kept -= picked
        for node in sorted(picked):
            self.note(t, "pick_up", node)

    def _drop(self, t: float, nodes: Collection[int]) -> None:
        """Take nodes off the route: they are idle now, or go back to who promised them."""
        own = self.holdings
        for node in nodes:
            own.route.remove(node)
            if node in own.pledged:
                self.bidder.release(t, node)
            else:
                own.kept.add(node)
                self.note(t, "discard", node)

    def _beat(self, t: float) -> None:
        """Now and then: a sign of life, reminders, and a look for signs of others."""
        own, has_business = self.holdings, not self._vessel.is_home
        has_business |= bool(own.kept or own.ceded) and t < self._voyage.problem.budgets.max()
        if not has_business:
            return
        if t - self._reported >= BEAT:
            self.report(t)
        self.auctioneer.remind(t)
        self.watch.look_round(t)
        if self._vessel.is_home:
            self.auctioneer.open(t)
        self.later(t + BEAT, self._beat)
