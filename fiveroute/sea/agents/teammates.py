"""What an AUV believes about its teammates, and what it does when one falls silent.

Everything heard from a teammate is a sign of life. Who has not been heard for `SILENCE` seconds
and is not known to be home is suspected to have failed. Its heir is the next AUV in the order of
numbers that is neither suspected nor on its way home. The heir asks all others whether any of
the silent one's nodes are theirs by now; when everybody who is not suspected has answered, it
keeps the rest, and offers it like any idle node. If the silent one is heard again, the heir yields.

A suspicion may be false, and two AUVs may both take themselves for the heir, but only if one of
them suspects the other falsely. The silent one may also have collected a node that it had no
chance to tell of. Such takeovers in error, and nothing else, can lead to a double collection.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from fiveroute.sea.agents.messages import Inquiry, Reply, Report
from fiveroute.sea.agents.own_ship import OwnShip

__all__ = ["BEAT", "SILENCE", "Teammates"]

BEAT = 900.0
"""Longest time in seconds from one sign of life of an AUV to the next."""

SILENCE = 4.0 * BEAT
"""Seconds without a sign of life after which a teammate is suspected: four are missed."""


@dataclass(slots=True)
class Teammates:
    """Beliefs of one AUV about the others.

    Parameters
    ----------
    ship
        The AUV.
    estates
        What every AUV is believed to have: at first, what it sets out with.
    silence
        Seconds after which a silent AUV is suspected; infinite for a fleet that never fails.
    tell
        Called with the silent AUV and a node when one is taken over.
    offer
        Called with the time in seconds when all that is taken over is kept.
    """

    ship: OwnShip
    estates: dict[int, frozenset[int]]
    silence: float
    tell: Callable[[int, int], None]
    offer: Callable[[float], None]
    _heard: dict[int, float] = field(default_factory=dict)
    _homebound: set[int] = field(default_factory=set)
    _home: set[int] = field(default_factory=set)
    _inherited: set[int] = field(default_factory=set)
    _answers: dict[int, dict[int, frozenset[int]]] = field(default_factory=dict)

    def partners(self, t: float) -> set[int]:
        """Teammates that may still take a node."""
        return {m for m in self._others if m not in self._homebound and not self.suspects(m, t)}

    def suspects(self, auv: int, t: float) -> bool:
        """Whether a teammate is believed to have failed."""
        return auv not in self._home and t - self._heard.get(auv, 0.0) > self.silence

    def heard(self, t: float, auv: int) -> None:
        """A sign of life."""
        self._heard[auv] = t
        self._answers.pop(auv, None)

    def on_report(self, message: Report) -> None:
        """Remember what a teammate has, and yield what was taken over from it in error."""
        self.estates[message.sender] = message.mine
        if message.is_homebound:
            self._homebound.add(message.sender)
        if message.is_home:
            self._home.add(message.sender)
        own = self.ship.holdings
        for node in self._inherited & (message.mine | message.done):
            self._inherited.discard(node)
            if node in own.kept:
                own.kept.remove(node)
            elif node in own.route and node not in own.pledged:
                own.route.remove(node)

    def on_inquiry(self, t: float, message: Inquiry) -> None:
        """Say which nodes are its own; if it is itself the silent one, say that it is not."""
        ship = self.ship
        if message.silent == ship.number:
            ship.report(t)
            return
        mine = message.nodes & ship.holdings.concerns
        ship.say(t, Reply(ship.number, message.sender, message.silent, mine))

    def on_reply(self, t: float, message: Reply) -> None:
        """One teammate less to wait for."""
        if message.silent in self._answers:
            self._answers[message.silent][message.sender] = message.mine
            self._inherit(message.silent, t)

    def look_round(self, t: float) -> None:
        """Ask for the nodes of those whose heir it is."""
        if math.isinf(self.silence):
            return
        me = self.ship.number
        for auv in self._others:
            if not self.suspects(auv, t) or self._heir(auv, t) != me:
                continue
            nodes = self._estate(auv)
            if nodes:
                self._answers.setdefault(auv, {})
                self.ship.say(t, Inquiry(me, None, auv, nodes))
                self._inherit(auv, t)

    @property
    def _others(self) -> list[int]:
        return [m for m in self.estates if m != self.ship.number]

    def _estate(self, auv: int) -> frozenset[int]:
        """What a silent AUV has left: what it said it had, and what was ceded to it."""
        own = self.ship.holdings
        ceded = {node for node, pledge in own.ceded.items() if pledge.other == auv}
        return (self.estates[auv] | ceded) - own.concerns

    def _heir(self, auv: int, t: float) -> int | None:
        fleet, me = len(self.estates), self.ship.number
        for step in range(1, fleet):
            m = (auv + step) % fleet
            is_able = not self.ship.is_homebound if m == me else m in self.partners(t)
            if is_able:
                return m
        return None

    def _inherit(self, auv: int, t: float) -> None:
        """Keep what nobody else has, once all others have answered."""
        answers = self._answers[auv]
        asked = {m for m in self._others if m != auv and not self.suspects(m, t)}
        if not answers.keys() >= asked:
            return
        own = self.ship.holdings
        nodes = self._estate(auv).difference(*answers.values())
        for node in sorted(nodes):
            own.ceded.pop(node, None)
            own.kept.add(node)
            self.tell(auv, node)
        self._inherited |= nodes
        self.estates[auv] = frozenset()
        del self._answers[auv]
        self.offer(t)
