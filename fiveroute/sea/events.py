"""What happened at sea, one event at a time."""

from __future__ import annotations

from typing import Literal, NamedTuple

__all__ = ["Event", "Kind"]

Kind = Literal[
    "depart", "collect", "discard", "pick_up", "send", "receive", "manoeuvre", "fail", "arrive"
]
"""What an AUV can do or suffer; `collect` is told when the service is done."""


class Event(NamedTuple):
    """One event of one run.

    Parameters
    ----------
    t
        Seconds since the fleet departed.
    auv
        The AUV, counted from 0.
    kind
        What it did or suffered.
    node
        Vertex concerned; None where there is none.
    """

    t: float
    auv: int
    kind: Kind
    node: int | None = None
