"""Errors that a user can do something about.

Every one of them is a single sentence that says where the fault is (file, line or
field), the value found, the rule it breaks and the remedy. The command line prints that
sentence and exits with code 2; a library user catches `FiverouteError`.
"""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path

from fiveroute.words import printable

__all__ = ["FiverouteError", "InputError", "MissingExtraError", "nearest"]

_NAMES_SHOWN = 20


class FiverouteError(Exception):
    """Base of all errors raised on purpose by fiveroute."""


class InputError(FiverouteError):
    """The input, or the way a function was called, is wrong.

    Parameters
    ----------
    rule
        What must hold, and what to do about it.
    value
        The offending value, shown shortened.
    field
        Field of the document, such as ``nodes[3].x``.
    file
        File that holds it.
    line
        Line number in that file, counted from 1.
    """

    def __init__(
        self,
        rule: str,
        *,
        value: object = None,
        field: str | None = None,
        file: Path | str | None = None,
        line: int | None = None,
    ) -> None:
        self.rule, self.value, self.field, self.file, self.line = rule, value, field, file, line
        super().__init__(self._sentence())

    def at(self, file: Path | str) -> InputError:
        """Return the same error, naming the file in which it was found."""
        return InputError(self.rule, value=self.value, field=self.field, file=file, line=self.line)

    def _sentence(self) -> str:
        where = [str(self.file)] if self.file is not None else []
        if self.line is not None:
            where.append(f"line {self.line}")
        if self.field is not None:
            where.append(_cut(self.field, 200))
        shown = [] if self.value is None else [f"{_shorten(self.value)}:"]
        head = [f"{', '.join(where)}:"] if where else []
        sentence = " ".join([*head, *shown, _cut(self.rule, 700)])
        return printable(sentence)


class MissingExtraError(FiverouteError):
    """An optional package is needed; the message names the extra to install."""


def nearest(name: str, known: Iterable[str]) -> str:
    """What to write instead of an unknown name."""
    names = sorted(known)
    close = get_close_matches(name, names, n=1)
    if close:
        return f"did you mean {close[0]!r}?"
    more = len(names) - _NAMES_SHOWN
    shown = ", ".join(names[:_NAMES_SHOWN])
    return f"known are {shown}" + (f" and {more} more" if more > 0 else "")


def _shorten(value: object) -> str:
    return _cut(repr(value), 60)


def _cut(text: str, longest: int) -> str:
    return text if len(text) <= longest else f"{text[: longest - 3]}..."
