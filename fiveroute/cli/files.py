"""Files as commands meet them: refused before the work begins, written after it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from fiveroute.errors import InputError
from fiveroute.formats.files import make_folder, require_writable

__all__ = ["require_folder", "require_output", "require_outputs", "require_picture"]

_PICTURES = (".png", ".svg", ".pdf")


def require_output(path: Path | None, force: bool) -> None:
    """Refuse an output that could not be written, before any time is spent."""
    if path is not None:
        require_writable(path, force)


def require_outputs(*paths: Path | None, force: bool) -> None:
    """Refuse outputs that could not be written, or of which one would replace another."""
    named = [path for path in paths if path is not None]
    for k, path in enumerate(named):
        require_output(path, force)
        if path.resolve() in [other.resolve() for other in named[:k]]:
            raise InputError("is named for two outputs; give each a file of its own", file=path)


def require_picture(path: Path | None) -> None:
    """Refuse a picture in a format that is not drawn, before any time is spent."""
    if path is not None and path.suffix not in _PICTURES:
        told = f"a picture ends in {', '.join(_PICTURES)}; choose one"
        raise InputError(told, field="picture", value=path.name)


def require_folder(folder: Path | None, names: Iterable[str], force: bool) -> None:
    """Make a folder for several outputs, and refuse those that could not be written."""
    if folder is None:
        return
    make_folder(folder)
    for name in names:
        require_writable(folder / name, force)
