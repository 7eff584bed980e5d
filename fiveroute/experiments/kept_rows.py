"""Rows kept as files, so that a long run that is killed at any moment goes on where it was.

A row is one JSON document in a file of its own, written whole or not at all as soon as it is
done. Its name ends in a key, a digest of all that the row depends on: with other settings, other
data or another source it has another key, so that what is found under a key is the row itself.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fiveroute.errors import InputError
from fiveroute.formats.files import make_folder, read_text, write_text_atomically

__all__ = ["KeptRows", "key_of"]


def key_of(document: Mapping[str, Any]) -> str:
    """A digest of all that a row depends on.

    Parameters
    ----------
    document
        What JSON can hold; the order of the names does not matter.
    """
    text = json.dumps(document, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:24]


@dataclass(frozen=True, slots=True)
class KeptRows:
    """A folder of rows.

    Parameters
    ----------
    folder
        The folder, made with the first row.
    """

    folder: Path

    def get(self, label: str, key: str) -> dict[str, Any] | None:
        """The row of that key, if the folder has it whole."""
        try:
            document = json.loads(read_text(self._file(label, key)))
        except (InputError, ValueError, RecursionError):
            return None
        return document if isinstance(document, dict) else None

    def put(self, label: str, key: str, row: Mapping[str, Any]) -> None:
        """Keep a row.

        Parameters
        ----------
        label
            Words for people, which the name of the file begins with.
        key
            Its key.
        row
            What JSON can hold.
        """
        make_folder(self.folder)
        text = json.dumps(row, allow_nan=False)
        write_text_atomically(self._file(label, key), text + "\n", force=True)

    def _file(self, label: str, key: str) -> Path:
        readable = re.sub(r"[^\w.-]+", "_", label)[:80]
        return self.folder / f"{readable}-{key}.json"
