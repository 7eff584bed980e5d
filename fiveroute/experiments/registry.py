"""The registry of a campaign: what its results were computed from, and whether it is over.

It lies beside the results as a JSON document: all options, the hashes of all inputs, the digest of
the source, the versions of what computed, begin and end. It is written before the first run. A
campaign that was killed is taken up again by the same call; by a call that would give other
numbers it is refused, so that no table ever mixes two campaigns.
"""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import fiveroute
from fiveroute.errors import InputError
from fiveroute.formats.files import write_text_atomically
from fiveroute.kernels import source_digest
from fiveroute.sea.journal import Journal

__all__ = ["Registry", "file_hash"]

_DECISIVE = ("config", "inputs", "source")


@dataclass(frozen=True, slots=True)
class Registry:
    """A campaign that has begun.

    Parameters
    ----------
    path
        Its file.
    record
        What it says.
    """

    path: Path
    record: Mapping[str, Any]

    @classmethod
    def begin(
        cls,
        path: Path,
        config: Mapping[str, Any],
        inputs: Mapping[str, str | None],
        module: str,
        *,
        force: bool = False,
    ) -> Registry:
        """Begin a campaign, or take it up again.

        Parameters
        ----------
        path
            File of the registry.
        config
            The options that the numbers depend on.
        inputs
            Hashes of the inputs by their names.
        module
            The module that computes; its source and that of all it imports count.
        force
            Whether to begin anew whatever was there.

        Raises
        ------
        InputError
            If another campaign has begun there that is not over.
        """
        record: dict[str, Any] = {
            "config": dict(config),
            "inputs": dict(inputs),
            "source": source_digest(module),
            "versions": _versions(),
            "begun": _now(),
            "ended": None,
        }
        before = None if force else _read(path)
        if before is None or before.get("ended") is not None:
            registry = cls(path, record)
            registry.journal.remove()
            registry._write()
            return registry
        changes = _changes(before, record)
        if changes:
            raise InputError(
                f"another campaign has begun here and is not over ({changes}); repeat its call, "
                "name another output, or begin anew with --force",
                file=path,
            )
        return cls(path, before)

    @property
    def journal(self) -> Journal:
        """Where the runs of the campaign are kept until it is over."""
        return Journal(self.path.with_suffix(".jsonl"))

    def end(self) -> None:
        """Note that the campaign is over, its results written."""
        Registry(self.path, {**self.record, "ended": _now()})._write()
        self.journal.remove()

    def _write(self) -> None:
        text = json.dumps(self.record, indent=2, allow_nan=False)
        write_text_atomically(self.path, text + "\n", force=True)


def file_hash(path: Path) -> str:
    """SHA-256 of a file in hexadecimal."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _read(path: Path) -> dict[str, Any] | None:
    """What a registry says; None where there is none, or none that can be read."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None
    return document if isinstance(document, dict) else None


def _changes(before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """In what two campaigns differ that numbers depend on, the first of it in full."""
    for part in _DECISIVE:
        old, new = before.get(part), json.loads(json.dumps(now[part]))
        if old == new:
            continue
        if isinstance(old, dict) and part == "config":
            names = sorted({*old, *new}, key=str)
            name = next(name for name in names if old.get(name) != new.get(name))
            return f"{name} was {old.get(name)!r}, and is {new.get(name)!r}"
        return {"inputs": "its input was another", "source": "fiveroute has changed"}.get(
            part, part
        )
    return ""


def _versions() -> dict[str, str]:
    import numba
    import numpy as np

    return {
        "fiveroute": fiveroute.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "numba": numba.__version__,
    }


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
