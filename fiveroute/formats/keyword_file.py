"""The grammar that TSPLIB and its relatives share.

::

    NAME : gr17
    DIMENSION: 17
    EDGE_WEIGHT_SECTION
    0 633 0
    257 390 0 ...
    EOF

A line is ``KEY : value``, the head of a section, or a line of the section above it. What
follows EOF does not count, and EOF itself may be missing.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fiveroute.errors import InputError, nearest
from fiveroute.formats.files import integer, non_negative, number, numbered_lines

__all__ = ["Entry", "KeywordFile", "parse"]


@dataclass(frozen=True, slots=True)
class Entry:
    """The value of a key, and the line where it stands."""

    value: str
    line: int


@dataclass(frozen=True, slots=True)
class KeywordFile:
    """A parsed file.

    Parameters
    ----------
    entries
        Keys, in capitals, and their values.
    sections
        Sections, and their lines with line numbers.
    """

    entries: dict[str, Entry]
    sections: dict[str, list[Entry]]

    def entry(self, key: str) -> Entry:
        """The value of a key that must be there."""
        if key not in self.entries:
            raise InputError(f"is missing; add a line '{key} : value'", field=key)
        return self.entries[key]

    def section(self, key: str) -> list[Entry]:
        """The lines of a section that must be there."""
        if key not in self.sections:
            raise InputError("is missing; the file may be cut off, copy it again", field=key)
        return self.sections[key]

    def name(self, default: str) -> str:
        """The name that the file states."""
        return self.entries["NAME"].value if "NAME" in self.entries else default

    @property
    def dimension(self) -> int:
        """Number of nodes, the depot included."""
        entry = self.entry("DIMENSION")
        return integer(entry.value, "DIMENSION", entry.line)

    def choice(self, key: str, known: Collection[str], default: str | None = None) -> str:
        """The value of a key that must be one of those we know."""
        if default is not None and key not in self.entries:
            return default
        entry = self.entry(key)
        if entry.value not in known:
            raise InputError(
                f"is not supported; known are {', '.join(known)}",
                field=key,
                value=entry.value,
                line=entry.line,
            )
        return entry.value

    def table(self, key: str, columns: tuple[str, ...]) -> NDArray[np.float64]:
        """A section with one line ``i value ...`` a node, shape (DIMENSION, columns).

        The lines may stand in any order.
        """
        lines, size = self.section(key), self.dimension
        if len(lines) != size:
            raise InputError(
                f"must be as many as DIMENSION, {size}; the file may be cut off, copy it again",
                field=f"lines of {key}",
                value=len(lines),
            )
        rows: dict[int, list[float]] = {}
        for entry in lines:
            index, *words = entry.value.split()
            node = integer(index, key, entry.line)
            if node > size or node in rows or len(words) != len(columns):
                raise InputError(
                    f"must be {' '.join(('i', *columns))}, every i from 1 to {size} once",
                    field=key,
                    value=entry.value,
                    line=entry.line,
                )
            rows[node] = [
                number(word, column, entry.line)
                for word, column in zip(words, columns, strict=True)
            ]
        return np.array([rows[node] for node in range(1, size + 1)], dtype=np.float64)

    def weights(self, key: str) -> NDArray[np.float64]:
        """All numbers of a section in a row; none may be negative."""
        rows = [_weights(key, entry) for entry in self.section(key)]
        return np.concatenate(rows) if rows else np.empty(0)


def _weights(key: str, entry: Entry) -> NDArray[np.float64]:
    words = entry.value.split()
    try:
        row = np.array([float(word) for word in words])
        if "_" not in entry.value and np.isfinite(row).all() and (row >= 0.0).all():
            return row
    except ValueError:
        pass
    return np.array([non_negative(word, key, entry.line) for word in words])  # finds the word


def parse(text: str, keys: Collection[str], sections: Collection[str]) -> KeywordFile:
    """Sort the lines of a file.

    Parameters
    ----------
    text
        Content of the file.
    keys, sections
        Names that the format knows; any other is an error, since it may change the problem.
    """
    file = KeywordFile({}, {})
    section: list[Entry] | None = None
    for line, content in numbered_lines(text):
        head, colon, value = (part.strip() for part in content.partition(":"))
        if head == "EOF":
            break
        if head.endswith("_SECTION"):
            _require_new(head, sections, file.sections, line)
            section = file.sections[head] = []
        elif colon:
            if head == "COMMENT":
                continue
            _require_new(head, keys, file.entries, line)
            file.entries[head] = Entry(value, line)
            section = None
        elif section is not None:
            section.append(Entry(content, line))
        else:
            raise InputError(
                "must be 'KEY : value' or the head of a section; correct the line",
                value=content,
                line=line,
            )
    return file


def _require_new(name: str, known: Collection[str], seen: Collection[str], line: int) -> None:
    if name not in known:
        raise InputError(f"is unknown; {nearest(name, known)}", value=name, line=line)
    if name in seen:
        raise InputError("stands twice; remove one", value=name, line=line)
