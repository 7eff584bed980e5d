"""The keeper's side of an auction.

A keeper calls its idle nodes out, waits for bids as long as answers take, holds the auction (28),
(29) on the values that it was told and its own, and awards what was won. When all awards are
settled, the next round follows for what is left, until a round brings nothing.

An award binds the keeper only until its deadline: unless the winner has accepted by then, the node
is free again, and a later acceptance is void. With the confirmation it gives the node up for good,
whether the confirmation arrives or not; it repeats it until it hears that it did.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from fiveroute.sea.agents.auction import assign_by_auction
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

__all__ = ["MOST_ROUNDS", "Auctioneer"]

MOST_ROUNDS = 8
"""Rounds of an auction at most, so that a bad channel does not keep it going."""


@dataclass(slots=True)
class Auctioneer:
    """Offers the idle nodes that an AUV keeps.

    Parameters
    ----------
    ship
        The keeper.
    partners
        Teammates that may take a node at a time in seconds.
    transfers
        Number of awards made so far.
    """

    ship: OwnShip
    partners: Callable[[float], set[int]]
    transfers: int = 0
    _number: int = 0
    _rounds: int = 0
    _nodes: tuple[int, ...] = ()
    _bids: dict[int, tuple[float, ...]] = field(default_factory=dict)

    def open(self, t: float, rounds: int = MOST_ROUNDS) -> None:
        """Begin an auction of all nodes kept, unless one is going on."""
        ship, own = self.ship, self.ship.holdings
        if self._nodes or own.awarded or not own.kept or rounds == 0:
            return
        self._rounds, self._number = rounds, self._number + 1
        self._nodes, self._bids = tuple(sorted(own.kept)), {}
        if self.partners(t):
            ship.say(t, Call(ship.number, None, self._number, self._nodes))
            ship.later(t + ship.radio.patience, partial(self._close, self._number))
        else:
            self._close(self._number, t)

    def on_wish(self, t: float, message: Wish) -> None:
        """Somebody could take a node."""
        if message.nodes & self.ship.holdings.kept:
            self.open(t)

    def on_bid(self, t: float, message: Bid) -> None:
        """Somebody bids; when all have, there is nothing to wait for."""
        if message.auction == self._number and len(message.psi) == len(self._nodes):
            self._bids[message.sender] = message.psi
            if self._bids.keys() >= self.partners(t):
                self._close(self._number, t)

    def on_accept(self, t: float, message: Accept) -> None:
        """A winner has set time aside: the node is its own from now on."""
        own, node = self.ship.holdings, message.node
        pledge = Pledge(message.transfer, message.sender)
        if own.awarded.get(node) == pledge:
            own.ceded[node] = own.awarded.pop(node)
        answer = Confirm if own.ceded.get(node) == pledge else Void
        me = self.ship.number
        self.ship.say(t, answer(me, message.sender, message.transfer, node))
        self._next_round(t)

    def on_decline(self, t: float, message: Decline) -> None:
        """A winner does not want the node, and will never visit it: back to the keeper."""
        own, pledge = self.ship.holdings, Pledge(message.transfer, message.sender)
        for book in (own.awarded, own.ceded):
            if book.get(message.node) == pledge:
                del book[message.node]
                own.kept.add(message.node)
        self._next_round(t)

    def on_report(self, message: Report) -> None:
        """What a new owner says it has need not be confirmed any more."""
        ceded = self.ship.holdings.ceded
        for node in (message.mine | message.done) & ceded.keys():
            if ceded[node].other == message.sender:
                del ceded[node]

    def remind(self, t: float) -> None:
        """Repeat confirmations that may have been lost."""
        for node, pledge in self.ship.holdings.ceded.items():
            self.ship.say(t, Confirm(self.ship.number, pledge.other, pledge.transfer, node))

    def _close(self, number: int, t: float) -> None:
        """Hold the auction, take what is its own, and award the rest."""
        if number != self._number or not self._nodes:
            return
        ship, own = self.ship, self.ship.holdings
        psi, _ = ship.worth(t, self._nodes)
        bidders = [ship.number, *self._bids]
        values = np.array([psi, *self._bids.values()])
        values[:, [node not in own.kept for node in self._nodes]] = 0.0
        won = assign_by_auction(values).tolist()
        nodes, self._nodes = self._nodes, ()
        for auv, j in zip(bidders, won, strict=True):
            if j < 0:
                continue
            own.kept.remove(nodes[j])
            if auv == ship.number:
                ship.insert_best(t, nodes[j])
            else:
                self._award(t, nodes[j], auv)
        if max(won) >= 0:
            self._next_round(t)

    def _award(self, t: float, node: int, winner: int) -> None:
        ship = self.ship
        self.transfers += 1
        ship.holdings.awarded[node] = Pledge(self.transfers, winner)
        ship.say(t, Award(ship.number, winner, self.transfers, node))
        ship.later(t + ship.radio.patience, partial(self._expire, node, self.transfers))

    def _expire(self, node: int, transfer: int, t: float) -> None:
        own = self.ship.holdings
        if node in own.awarded and own.awarded[node].transfer == transfer:
            del own.awarded[node]
            own.kept.add(node)
            self._next_round(t)

    def _next_round(self, t: float) -> None:
        self.open(t, max(self._rounds - 1, 0))
