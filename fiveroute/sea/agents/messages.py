"""What AUVs say to each other, and how many bits it takes.

Every frame has a header of 36 bits: kind (4), sender (8), receiver (8, all ones for everybody)
and checksum (16). Vertices, numbers of auctions and values of psi (as half-precision floats) take
16 bits each; sets of nodes are bitmaps of one bit a node.

A node changes hands in three steps. The keeper sends an `Award`, which gives no right yet; the
winner sets time aside and answers `Accept`; the keeper gives the node up for good and answers
`Confirm`, with which alone the winner may visit it. So nobody ever has a node that somebody else
may still visit or award: a lost award or acceptance leaves it with its keeper, and a lost
confirmation leaves it with nobody, until the keeper says it again. No number of messages could do
better over a channel that may lose any of them (the two generals): either both may believe to
have the node for a while, or neither; here it is neither.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

__all__ = [
    "HEADER_BITS",
    "WORD_BITS",
    "Accept",
    "Award",
    "Bid",
    "Call",
    "Confirm",
    "Decline",
    "Inquiry",
    "Message",
    "Reply",
    "Report",
    "Void",
    "Wish",
    "longest_frame",
]

HEADER_BITS = 36
WORD_BITS = 16

Nodes = frozenset[int]


@dataclass(frozen=True, slots=True)
class Message:
    """Anything an AUV says.

    Parameters
    ----------
    sender
        The AUV that says it.
    receiver
        The AUV that it is for; None for everybody.
    """

    sender: int
    receiver: int | None

    words: ClassVar[int] = 0

    @property
    def says(self) -> str:
        """What kind of message it is, in a word."""
        return type(self).__name__.lower()

    def bits(self, n: int) -> int:
        """Length of the frame in a mission of n nodes."""
        return HEADER_BITS + WORD_BITS * self.words


@dataclass(frozen=True, slots=True)
class Report(Message):
    """I am alive; these nodes are mine, these are idle and can be had, these I have collected.

    Parameters
    ----------
    mine
        Nodes that it may visit or award.
    idle
        Those of them that it would award.
    done
        Nodes that it has collected.
    is_homebound, is_home
        Whether it has set out for the destination, and whether it is there.
    """

    mine: Nodes
    idle: Nodes
    done: Nodes
    is_homebound: bool
    is_home: bool

    def bits(self, n: int) -> int:
        """Three bitmaps and two flags."""
        return HEADER_BITS + 3 * n + 2


@dataclass(frozen=True, slots=True)
class Wish(Message):
    """I could take an idle node: let there be an auction. A bitmap of the nodes wished for."""

    nodes: Nodes

    def bits(self, n: int) -> int:
        """A bitmap."""
        return HEADER_BITS + n


@dataclass(frozen=True, slots=True)
class Call(Message):
    """An auction is open for these nodes."""

    auction: int
    nodes: tuple[int, ...]

    def bits(self, n: int) -> int:
        """The number of the auction and its nodes."""
        return HEADER_BITS + WORD_BITS * (1 + len(self.nodes))


@dataclass(frozen=True, slots=True)
class Bid(Message):
    """What the nodes of an auction are worth to me: psi of each, in the order of the call."""

    auction: int
    psi: tuple[float, ...]

    def bits(self, n: int) -> int:
        """The number of the auction and a value for each node."""
        return HEADER_BITS + WORD_BITS * (1 + len(self.psi))


@dataclass(frozen=True, slots=True)
class _Transfer(Message):
    """A step in the handing over of a node; the number is the keeper's, and never used again."""

    transfer: int
    node: int

    words: ClassVar[int] = 2


@dataclass(frozen=True, slots=True)
class Award(_Transfer):
    """You have won, if you still want it."""


@dataclass(frozen=True, slots=True)
class Accept(_Transfer):
    """I do; I have set time aside."""


@dataclass(frozen=True, slots=True)
class Decline(_Transfer):
    """I do not, or no longer."""


@dataclass(frozen=True, slots=True)
class Confirm(_Transfer):
    """It is yours, and no longer mine."""


@dataclass(frozen=True, slots=True)
class Void(_Transfer):
    """You came too late: it is not yours."""


@dataclass(frozen=True, slots=True)
class Inquiry(Message):
    """One of us is silent, and I mean to take these nodes of it over, unless they are yours."""

    silent: int
    nodes: Nodes

    def bits(self, n: int) -> int:
        """An AUV and a bitmap."""
        return HEADER_BITS + 8 + n


@dataclass(frozen=True, slots=True)
class Reply(Message):
    """Those of the nodes asked for that are mine, or that I have collected or been promised."""

    silent: int
    mine: Nodes

    def bits(self, n: int) -> int:
        """An AUV and a bitmap."""
        return HEADER_BITS + 8 + n


def longest_frame(n: int) -> int:
    """Bits of the longest of these in a mission of n nodes: a call or a bid for all of them."""
    return HEADER_BITS + WORD_BITS * (n + 1)
