"""What happened at sea, one event at a time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, NamedTuple

__all__ = ["Event", "Frame", "Kind", "arrivals_of"]

Kind = Literal[
    "depart", "collect", "discard", "pick_up", "send", "receive", "manoeuvre", "fail", "arrive"
]
"""What an AUV can do or suffer; `collect` is told when the service is done."""


class Frame(NamedTuple):
    """A message on its way; the same one in the event of its sender and of all who heard it.

    Parameters
    ----------
    number
        Its number in the run, counted from 0.
    sender
        The AUV that says it.
    receiver
        The AUV that it is for; None for everybody.
    says
        Kind of the message, a word such as `report`, see `fiveroute.sea.agents.messages`.
    bits
        Its length.
    """

    number: int
    sender: int
    receiver: int | None
    says: str
    bits: int


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
    frame
        The message that is sent or received; None of anything else, and where it is not known.
    """

    t: float
    auv: int
    kind: Kind
    node: int | None = None
    frame: Frame | None = None


def arrivals_of(events: Iterable[Event]) -> dict[int, dict[int, float]]:
    """When each message was heard, in seconds: by its number and the AUV that heard it."""
    arrivals: dict[int, dict[int, float]] = {}
    for event in events:
        if event.kind == "receive" and event.frame is not None:
            arrivals.setdefault(event.frame.number, {})[event.auv] = event.t
    return arrivals
