"""Who talked to whom: the messages of a run, each with those who heard it and those who did not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from fiveroute.sea.events import Event, Frame, arrivals_of

__all__ = ["Exchange", "exchanges"]


class Exchange(NamedTuple):
    """A message and what became of it.

    Parameters
    ----------
    frame
        The message.
    sent
        When it was sent, in seconds.
    heard
        When it was heard, in seconds, by AUV.
    lost
        AUVs that it was for, that worked, and that did not hear it.
    """

    frame: Frame
    sent: float
    heard: Mapping[int, float]
    lost: tuple[int, ...]


def exchanges(events: Sequence[Event], fleet_size: int) -> dict[int, Exchange]:
    """The messages of one run by their numbers.

    Parameters
    ----------
    events
        What happened, in the order of time.
    fleet_size
        Number of AUVs.
    """
    arrivals, failed = arrivals_of(events), set[int]()
    found: dict[int, Exchange] = {}
    for event in events:
        if event.kind == "fail":
            failed.add(event.auv)
        if event.kind != "send" or event.frame is None:
            continue
        frame = event.frame
        heard = arrivals.get(frame.number, {})
        meant = range(fleet_size) if frame.receiver is None else (frame.receiver,)
        lost = tuple(m for m in meant if m != event.auv and m not in heard and m not in failed)
        found[frame.number] = Exchange(frame, event.t, heard, lost)
    return found
