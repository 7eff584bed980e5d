"""Numbers and names as people read them."""

from __future__ import annotations

__all__ = ["ENDLESS", "clock", "counted", "printable"]

ENDLESS = 1e6
"""A gap as only a plan has that collects nothing, or as good as nothing."""


def clock(seconds: float) -> str:
    """Seconds as h:mm:ss where they are at least a minute."""
    if seconds < 60.0:
        return f"{seconds:.4g} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{rest:02d}"


def counted(number: int, noun: str) -> str:
    """How many there are of something: ``1 node``, ``2 nodes``."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def printable(text: str) -> str:
    """A text on one line, with spaces for whatever a terminal would obey rather than show."""
    return "".join(sign if sign.isprintable() else " " for sign in text)
