"""Bundles: the nodes that an AUV has bid for, in the order in which it did.

An AUV adds the node that is worth most to it, of those for which its bid would win, until none is
left; a bid is what the node is worth on top of those in the bundle. It never bids more than
for the node before it: with bids that diminish, consensus is reached whatever the worth (Johnson et
al. 2010). Who is outbid for a node gives up all that it added later as well, since what these are
worth has changed, and then bids anew.

References
----------
H.-L. Choi, L. Brunet, J. P. How, "Consensus-based decentralized auctions for robust task
allocation", IEEE Transactions on Robotics 25(4), 2009, doi 10.1109/TRO.2009.2022423, algorithms 3
and 4: with diminishing marginal worth the bundles are worth half of the best at least.
L. Johnson, S. Ponda, H.-L. Choi, J. P. How, "Improving the efficiency of a decentralized tasking
algorithm for UAV teams with asynchronous communications", AIAA Guidance, Navigation, and Control
Conference 2010, doi 10.2514/6.2010-8421.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

from fiveroute.sea.agents.consensus import HELD, Beliefs, View

__all__ = ["Bundle", "Owner"]


class Owner(Protocol):
    """Whoever fills a bundle."""

    def worth(self, nodes: Sequence[int]) -> Sequence[float]:
        """What each node is worth on top of what it has; 0 where it cannot take it."""
        ...

    def add(self, node: int) -> None:
        """Take a node in."""
        ...

    def remove(self, node: int) -> None:
        """Give a node up."""
        ...


@dataclass(slots=True)
class Bundle:
    """The bundle of one AUV.

    Parameters
    ----------
    owner
        Who fills it.
    beliefs
        What the AUV believes.
    nodes
        Its nodes, in the order in which they were added.
    """

    owner: Owner
    beliefs: Beliefs
    nodes: list[int] = field(default_factory=list)

    def build(self) -> bool:
        """Add nodes while a bid wins one; returns whether any was added."""
        beliefs, before = self.beliefs, len(self.nodes)
        most = min((beliefs.bids[node] for node in self.nodes), default=HELD)
        while True:
            open_to_bids = [
                node
                for node in range(1, len(beliefs.bids) - 1)
                if beliefs.winners[node] != beliefs.me and beliefs.bids[node] < HELD
            ]
            worth = self.owner.worth(open_to_bids) if open_to_bids else ()
            bids = [
                (min(value, most), value, -n) for n, value in zip(open_to_bids, worth, strict=True)
            ]
            winning = [bid for bid in bids if beliefs.would_win(-bid[2], bid[0])]
            if not winning:
                return len(self.nodes) > before
            most, _, minus_node = max(winning)
            self.owner.add(-minus_node)
            beliefs.claim(-minus_node, most)
            self.nodes.append(-minus_node)

    def hear(self, view: View) -> bool:
        """Weigh a teammate's beliefs, and bid anew; returns whether anything has changed."""
        if not self.beliefs.hear(view):
            return False
        self._give_up_what_is_lost()
        self.build()
        return True

    def _give_up_what_is_lost(self) -> None:
        """Give up the first node that it was outbid for, and all that were added later."""
        beliefs = self.beliefs
        kept = 0
        while kept < len(self.nodes) and beliefs.winners[self.nodes[kept]] == beliefs.me:
            kept += 1
        for node in self.nodes[kept:]:
            self.owner.remove(node)
            if beliefs.winners[node] == beliefs.me:
                beliefs.forget(node)
        del self.nodes[kept:]
