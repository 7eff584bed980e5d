"""An AUV as an agent: it knows what it has sensed and what has reached it, and no more.

At a node it compares its remaining route with the time left (24), discards what does not fit
(25), looks for a better course over what is its own (`fiveroute.sea.courses.replanning`), and
reports. What it keeps idle it offers (`fiveroute.sea.agents.auctioneer`), what others offer it bids
for (`fiveroute.sea.agents.bidder`), and what a silent teammate leaves behind it may take over
(`fiveroute.sea.agents.teammates`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection

from fiveroute.sea.agents.auctioneer import Auctioneer
from fiveroute.sea.agents.bidder import Bidder
from fiveroute.sea.agents.channel import Radio
from fiveroute.sea.agents.holdings import Holdings
from fiveroute.sea.agents.messages import (
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
from fiveroute.sea.agents.own_ship import OwnShip
from fiveroute.sea.agents.teammates import BEAT, Teammates
from fiveroute.sea.courses.outlook import Outlook
from fiveroute.sea.courses.recourse import reconsider
from fiveroute.sea.run import Run

__all__ = ["Agent"]


class Agent:
    """One AUV.

    Parameters
    ----------
    number
        The AUV, counted from 0.
    run
        The run; the agent looks at its own vessel only.
    radio
        The channel.
    view
        What it expects of the legs.
    holdings
        What it sets out with.
    estates, silence, tell
        See `Teammates`.
    """

    def __init__(
        self,
        number: int,
        run: Run,
        radio: Radio,
        view: Outlook,
        holdings: Holdings,
        estates: dict[int, frozenset[int]],
        silence: float,
        tell: Callable[[int, int], None],
    ) -> None:
        self.ship = OwnShip(number, run, radio, view, holdings)
        self.teammates = Teammates(self.ship, dict(estates), silence, tell, self._offer)
        self.auctioneer = Auctioneer(self.ship, self.teammates.partners)
        self.bidder = Bidder(self.ship)
        self.ship.later(BEAT, self._beat)

    @property
    def holdings(self) -> Holdings:
        """The nodes that it has to do with."""
        return self.ship.holdings

    def steer(self, t: float) -> int:
        """The next vertex, now that it is done where it is."""
        ship, own, vessel = self.ship, self.holdings, self.ship.vessel
        vessel.target = vessel.at
        if own.target is not None:
            own.done.add(own.target)
            own.target = None
        self._replan(t)
        while own.route and own.route[0] in own.pledged:
            self._drop(t, own.route[:1])  # its turn has come before its confirmation
        own.target = own.route.pop(0) if own.route else None
        vessel.left = t
        vessel.target = ship.run.problem.destination if own.target is None else own.target
        ship.report(t)
        self._offer(t)
        self.bidder.wish(t)
        return vessel.target

    def come_home(self, t: float) -> None:
        """It has reached the destination; what it keeps it goes on offering."""
        self.ship.report(t)
        self._offer(t)

    def hear(self, t: float, message: Message) -> None:
        """React to a message."""
        self.teammates.heard(t, message.sender)
        match message:
            case Report():
                self.teammates.on_report(message)
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
                self.teammates.on_inquiry(t, message)
            case Reply():
                self.teammates.on_reply(t, message)

    def _replan(self, t: float) -> None:
        """(24) to (27) for itself alone: the best course over the nodes that are its own."""
        own, course = self.holdings, self.ship.course(t)
        better, left_over = reconsider(self.ship.view, course, own.kept)
        picked = own.kept.intersection(better.route)
        self._drop(t, sorted(set(course.route).intersection(left_over)))
        own.route[:] = better.route
        own.kept -= picked
        for node in sorted(picked):
            self.ship.note(t, "pick_up", node)

    def _drop(self, t: float, nodes: Collection[int]) -> None:
        """Take nodes off the route: they are idle now, or go back to who promised them."""
        own = self.holdings
        for node in nodes:
            own.route.remove(node)
            if node in own.pledged:
                self.bidder.release(t, node)
            else:
                own.kept.add(node)
                self.ship.note(t, "discard", node)

    def _offer(self, t: float) -> None:
        """Offer the idle nodes that it keeps."""
        self.auctioneer.open(t)

    def _beat(self, t: float) -> None:
        """Now and then: a sign of life, reminders, and a look for signs of others."""
        ship, own = self.ship, self.holdings
        has_business = not ship.vessel.is_home
        has_business |= bool(own.kept or own.ceded) and t < ship.run.problem.budgets.max()
        if not has_business:
            return
        if t - ship.reported >= BEAT:
            ship.report(t)
        self.auctioneer.remind(t)
        self.teammates.look_round(t)
        if ship.vessel.is_home:
            self._offer(t)
        ship.later(t + BEAT, self._beat)
