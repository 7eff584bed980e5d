"""The bidder's side of an auction.

A bidder tells the keeper what the nodes on offer are worth to it. When it is awarded one and
still has the time, it puts the node into its route and accepts, but may not visit it before the
confirmation. If none comes, it asks again, and at last gives the node up, for good: whatever
number of times this confirmation reaches it later, it declines. So each transfer ends either
way, and never both ways.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

from fiveroute.sea.agents.holdings import Pledge
from fiveroute.sea.agents.messages import (
    Accept,
    Award,
    Bid,
    Call,
    Confirm,
    Decline,
    Report,
    Void,
    Wish,
)
from fiveroute.sea.agents.own_ship import OwnShip

__all__ = ["TRIES", "Bidder"]

TRIES = 3
"""How often a winner accepts before it gives a node up that nobody confirms."""


@dataclass(slots=True)
class Bidder:
    """Bids for idle nodes that others keep.

    Parameters
    ----------
    ship
        The bidder.
    """

    ship: OwnShip
    _idle: dict[int, frozenset[int]] = field(default_factory=dict)
    _given_up: set[tuple[int, int]] = field(default_factory=set)

    def wish(self, t: float) -> None:
        """Ask for an auction, if it could take a node that it has heard to be idle."""
        heard = sorted(frozenset[int]().union(*self._idle.values()) - self.ship.holdings.concerns)
        psi, _ = self.ship.worth(t, heard)
        wanted = frozenset(node for node, value in zip(heard, psi, strict=True) if value > 0.0)
        if wanted:
            self.ship.say(t, Wish(self.ship.number, None, wanted))

    def on_report(self, message: Report) -> None:
        """Remember what is idle."""
        self._idle[message.sender] = message.idle

    def on_call(self, t: float, message: Call) -> None:
        """Bid, if any node on offer is worth something."""
        self._idle[message.sender] = frozenset(message.nodes)
        psi, _ = self.ship.worth(t, message.nodes)
        if psi.any():
            bid = Bid(self.ship.number, message.sender, message.auction, tuple(psi.tolist()))
            self.ship.say(t, bid)

    def on_award(self, t: float, message: Award) -> None:
        """Set time aside for the node, if there still is any."""
        ship, pledge = self.ship, Pledge(message.transfer, message.sender)
        psi, place = ship.worth(t, [message.node])
        if psi[0] <= 0.0 or message.node in ship.holdings.concerns:
            self._give_up(t, message.node, pledge)
            return
        ship.holdings.route.insert(int(place[0]), message.node)
        ship.holdings.pledged[message.node] = pledge
        self._accept(message.node, pledge, TRIES, t)

    def on_confirm(self, t: float, message: Confirm) -> None:
        """From now on the node is its own."""
        own, pledge = self.ship.holdings, Pledge(message.transfer, message.sender)
        if own.pledged.get(message.node) == pledge:
            del own.pledged[message.node]
            self.ship.note(t, "pick_up", message.node)
        elif (message.sender, message.transfer) in self._given_up:
            self._give_up(t, message.node, pledge)

    def on_void(self, t: float, message: Void) -> None:
        """It accepted too late."""
        if self.ship.holdings.pledged.get(message.node) == Pledge(message.transfer, message.sender):
            self.ship.holdings.route.remove(message.node)
            self.release(t, message.node)

    def release(self, t: float, node: int) -> None:
        """Give a node up that is not confirmed and not on the route any more."""
        self._give_up(t, node, self.ship.holdings.pledged.pop(node))

    def _accept(self, node: int, pledge: Pledge, tries: int, t: float) -> None:
        ship = self.ship
        if ship.holdings.pledged.get(node) != pledge:
            return
        if tries == 0:
            ship.holdings.route.remove(node)
            self.release(t, node)
            return
        ship.say(t, Accept(ship.number, pledge.other, pledge.transfer, node))
        ship.later(t + ship.radio.patience, partial(self._accept, node, pledge, tries - 1))

    def _give_up(self, t: float, node: int, pledge: Pledge) -> None:
        self._given_up.add((pledge.other, pledge.transfer))
        me = self.ship.number
        self.ship.say(t, Decline(me, pledge.other, pledge.transfer, node))
