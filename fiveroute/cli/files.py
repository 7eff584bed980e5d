"""Files as commands meet them: refused before the work begins, written after it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from fiveroute.formats.files import make_folder, require_writable

__all__ = ["require_folder", "require_output"]


def require_output(path: Path | None, force: bool) -> None:
    """Refuse an output that could not be written, before any time is spent."""
    if path is not None:
        require_writable(path, force)


def require_folder(folder: Path | None, names: Iterable[str], force: bool) -> None:
    """Make a folder for several outputs, and refuse those that could not be written."""
    if folder is None:
        return
    make_folder(folder)
    for name in names:
        require_writable(folder / name, force)
