"""Consensus on who has which node: the beliefs of one AUV, and what a teammate's do to them.

Every AUV i believes of every node j that z_ij has won it with a bid of y_ij, and remembers by s_ik
from when its newest information about AUV k is. When k tells its beliefs, i keeps its own, takes
k's over, or forgets, node by node, after the table of Choi, Brunet and How: in short, a node goes
to the higher bid (of equal bids to the lower number), and of two stories about a third AUV the
newer is true. With diminishing bids all AUVs come to believe the same, without conflict, whatever
the order of the messages.

Reference: H.-L. Choi, L. Brunet, J. P. How, "Consensus-based decentralized auctions for robust task
allocation", IEEE Transactions on Robotics 25(4), 2009, doi 10.1109/TRO.2009.2022423, table I.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from fiveroute.sea.agents.messages import HEADER_BITS, WORD_BITS, Message

__all__ = ["COLLECTED", "HELD", "NOBODY", "Beliefs", "View", "longest_view"]

NOBODY = -1
"""The winner of a node that nobody has."""

COLLECTED = math.inf
"""The bid that stands for a node whose data has been collected."""

HELD = 1e9
"""The bid that stands for a node that is not for sale: of a route as planned, or under way to."""

_Verdict = Literal["keep", "take", "forget"]


@dataclass(frozen=True, slots=True)
class View(Message):
    """What I believe: the winner and the bid of every node, and from when I know of whom.

    Parameters
    ----------
    winners
        z of every vertex; `NOBODY` where it is idle.
    bids
        y of every vertex.
    stamps
        s of every AUV in seconds.
    """

    winners: tuple[int, ...]
    bids: tuple[float, ...]
    stamps: tuple[float, ...]

    def bits(self, n: int) -> int:
        """A winner (8) and the kind of bid (2) a node, a word a true bid, and a word an AUV."""
        told = sum(0.0 < bid < HELD for bid in self.bids)
        return HEADER_BITS + 10 * n + WORD_BITS * (told + len(self.stamps))


def longest_view(n: int, fleet_size: int) -> int:
    """Bits of a view with a true bid for each of n nodes."""
    return HEADER_BITS + 10 * n + WORD_BITS * (n + fleet_size)


@dataclass(slots=True)
class Beliefs:
    """What one AUV believes.

    Parameters
    ----------
    me
        The AUV.
    winners, bids
        z and y of every vertex.
    stamps
        s of every AUV in seconds.
    """

    me: int
    winners: list[int]
    bids: list[float]
    stamps: list[float] = field(default_factory=list)

    def view(self, t: float) -> View:
        """All that it believes, to be told at a time."""
        self.stamps[self.me] = t
        return View(self.me, None, tuple(self.winners), tuple(self.bids), tuple(self.stamps))

    def claim(self, node: int, bid: float) -> None:
        """Bid for a node, believing to have won it."""
        self.winners[node], self.bids[node] = self.me, bid

    def forget(self, node: int) -> None:
        """Believe that nobody has a node."""
        self.winners[node], self.bids[node] = NOBODY, 0.0

    def would_win(self, node: int, bid: float) -> bool:
        """Whether a bid of its own would win a node that it has not."""
        if bid <= 0.0 or self.winners[node] == self.me:
            return False
        tie = bid == self.bids[node] and self.me < self.winners[node]
        return bid > self.bids[node] or tie

    def hear(self, view: View) -> bool:
        """Weigh a teammate's beliefs; returns whether anything has changed.

        News that have been overtaken by younger ones of the same teammate are ignored.
        """
        if view.stamps[view.sender] < self.stamps[view.sender]:
            return False
        has_changed = False
        for node, (winner, bid) in enumerate(zip(view.winners, view.bids, strict=True)):
            if winner == self.winners[node] and bid == self.bids[node]:
                continue
            verdict = self._verdict(view, node)
            if verdict == "take":
                self.winners[node], self.bids[node] = winner, bid
            elif verdict == "forget":
                self.forget(node)
            has_changed |= verdict != "keep"
        self.stamps = [max(pair) for pair in zip(self.stamps, view.stamps, strict=True)]
        return has_changed

    def _verdict(self, view: View, node: int) -> _Verdict:
        """The table: rows by what the sender believes, and in each by what the receiver does."""
        k, me = view.sender, self.me
        theirs, mine = view.winners[node], self.winners[node]
        if self.bids[node] == COLLECTED:
            return "keep"
        if view.bids[node] == COLLECTED:
            return "take"
        if theirs == k:
            return self._of_itself(view, node)
        if theirs == me:
            return "forget" if mine == k or self._is_older(view, mine) else "keep"
        if theirs == NOBODY:
            return "take" if mine == k or self._is_older(view, mine) else "keep"
        return self._of_a_third(view, node)

    def _of_itself(self, view: View, node: int) -> _Verdict:
        """The sender believes to have it."""
        mine = self.winners[node]
        if mine in (view.sender, NOBODY) or self._is_higher(view, node):
            return "take"
        return "take" if self._is_older(view, mine) else "keep"

    def _of_a_third(self, view: View, node: int) -> _Verdict:
        """The sender believes that a third AUV has it."""
        k, third, mine = view.sender, view.winners[node], self.winners[node]
        is_news = self._is_older(view, third)
        if mine == self.me:
            return "take" if is_news and self._is_higher(view, node) else "keep"
        if mine == k:
            return "take" if is_news else "forget"
        if mine in (third, NOBODY):
            return "take" if is_news else "keep"
        if is_news and (self._is_older(view, mine) or self._is_higher(view, node)):
            return "take"
        is_stale = view.stamps[third] < self.stamps[third]
        return "forget" if is_stale and self._is_older(view, mine) else "keep"

    def _is_higher(self, view: View, node: int) -> bool:
        """Whether the sender's winner beats the receiver's."""
        theirs, mine = view.bids[node], self.bids[node]
        return theirs > mine or (theirs == mine and view.winners[node] < self.winners[node])

    def _is_older(self, view: View, auv: int) -> bool:
        """Whether the sender has newer information about a third AUV."""
        return auv not in (self.me, NOBODY) and view.stamps[auv] > self.stamps[auv]
