"""The nodes that one AUV has to do with, and by what right.

Of every node at most one AUV has the right to visit or to award it. An AUV has this right to
its target, to the nodes on its route but for those it has only been promised, to the idle nodes it
keeps, and to those that it has awarded to a winner who has not accepted yet. What it has set time
aside for, but what is not confirmed, is on its route and yet not its own.
"""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["Holdings", "Pledge"]


@dataclass(frozen=True, slots=True)
class Pledge:
    """A node on its way from a keeper to a winner.

    Parameters
    ----------
    transfer
        Number of the transfer, the keeper's.
    other
        The winner in the keeper's book, the keeper in the winner's.
    """

    transfer: int
    other: int


@dataclass(slots=True)
class Holdings:
    """The book of one AUV.

    Parameters
    ----------
    route
        Nodes still to visit, in their order, the target not included.
    kept
        Idle nodes that it may award or pick up.
    awarded
        Nodes that are still its own, but awarded to a winner who has not accepted.
    ceded
        Nodes given up, whose new owner has not been heard to have them.
    pledged
        Nodes on the route that it has been awarded, but that are not confirmed.
    done
        Nodes collected.
    target
        The node it is under way to; None where it sails home.
    """

    route: list[int]
    kept: set[int]
    awarded: dict[int, Pledge] = field(default_factory=dict)
    ceded: dict[int, Pledge] = field(default_factory=dict)
    pledged: dict[int, Pledge] = field(default_factory=dict)
    done: set[int] = field(default_factory=set)
    target: int | None = None

    @property
    def mine(self) -> frozenset[int]:
        """Nodes that this AUV, and no other, may visit or award."""
        own = {node for node in self.route if node not in self.pledged}
        own |= self.kept | self.awarded.keys()
        return frozenset(own if self.target is None else own | {self.target})

    @property
    def concerns(self) -> frozenset[int]:
        """Nodes that nobody else should take over: its own, promised and collected ones."""
        return self.mine | self.pledged.keys() | self.done
