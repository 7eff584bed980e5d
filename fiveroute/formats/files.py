"""Text in from a file and out to a file, as every format needs it.

A file is read whole, in UTF-8, up to `MAX_BYTES`; one that is too large, binary or cut off
is refused before anything is built from it. A file is written whole or not at all, by
`fiveroute.whole_files`.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from pathlib import Path

from fiveroute.errors import InputError
from fiveroute.whole_files import written_whole

__all__ = [
    "MAX_BYTES",
    "ZIP",
    "decoded",
    "integer",
    "make_folder",
    "non_negative",
    "number",
    "numbered_lines",
    "positive",
    "read_bytes",
    "read_text",
    "require_writable",
    "title_of",
    "write_text_atomically",
]

MAX_BYTES = 32 * 2**20
"""Largest file that is read; 100,000 nodes take about 7 MB."""

ZIP = b"PK\x03\x04"
"""How a zip archive begins."""

_REMEDIES: tuple[tuple[type[OSError], str], ...] = (
    (FileNotFoundError, "does not exist; check the name"),
    (IsADirectoryError, "is a folder; name a file in it"),
    (PermissionError, "is out of bounds: permission denied; change its permissions"),
)


def read_text(path: Path) -> str:
    """Read a text file.

    Raises
    ------
    InputError
        If the file cannot be read, is larger than `MAX_BYTES`, empty or not UTF-8 text.
    """
    data = read_bytes(path)
    try:
        return decoded(data)
    except InputError as error:
        raise error.at(path) from None


def read_bytes(path: Path) -> bytes:
    """Read a file of at most `MAX_BYTES`.

    Raises
    ------
    InputError
        If the file cannot be read, or is larger.
    """
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        raise InputError(_reason(error), file=path) from None
    if len(data) > MAX_BYTES:
        raise InputError(f"is larger than {MAX_BYTES // 2**20} MB; split it", file=path)
    return data


def decoded(data: bytes) -> str:
    """The text in the bytes of a file.

    Raises
    ------
    InputError
        If they are empty or not UTF-8 text.
    """
    if data.startswith(ZIP):
        raise InputError("is a zip archive, as .xlsx is; save it as CSV UTF-8")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            "is no UTF-8 text; save the file as UTF-8 (a spreadsheet as CSV UTF-8)",
            value=data[error.start : error.start + 1],
            line=data.count(b"\n", 0, error.start) + 1,
        ) from None
    if "\0" in text:
        raise InputError("is a binary file; name a text file")
    if not text.strip():
        raise InputError("is empty; name a file that holds something")
    return text


def title_of(path: Path) -> str:
    """Name of a file without its ending; bytes of it that are no UTF-8 become question marks."""
    return path.stem.encode("utf-8", "replace").decode()


def numbered_lines(text: str) -> Iterator[tuple[int, str]]:
    """Lines that hold something, stripped, with their numbers counted from 1."""
    for line, content in enumerate(io.StringIO(text, newline=None), start=1):
        if stripped := content.strip():
            yield line, stripped


def number(token: str, field: str, line: int) -> float:
    """Turn one word of a text file into a finite number."""
    try:
        value = math.nan if "_" in token else float(token)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(
            "must be a finite number; correct the line", value=token, field=field, line=line
        )
    return value


def positive(token: str, field: str, line: int) -> float:
    """Turn one word of a text file into a number above 0."""
    value = number(token, field, line)
    if value <= 0.0:
        raise InputError(
            "must be greater than 0; correct the line", value=value, field=field, line=line
        )
    return value


def non_negative(token: str, field: str, line: int) -> float:
    """Turn one word of a text file into a number of at least 0."""
    value = number(token, field, line)
    if value < 0.0:
        raise InputError(
            "must not be negative; correct the line", value=value, field=field, line=line
        )
    return value


def integer(token: str, field: str, line: int, least: int = 1) -> int:
    """Turn one word of a text file into a whole number of at least `least`."""
    try:
        value = least - 1 if "_" in token else int(token)
    except ValueError:
        value = least - 1
    if value < least:
        raise InputError(
            f"must be a whole number, at least {least}; correct the line",
            value=token,
            field=field,
            line=line,
        )
    return value


def require_writable(path: Path, force: bool = False) -> None:
    """Refuse, before the work begins, an output that could not be written after it.

    Raises
    ------
    InputError
        If the folder is missing, the path is a folder, or the file exists and `force`
        does not allow to overwrite it.
    """
    try:
        if path.is_dir():
            raise InputError("is a folder; name a file in it", file=path)
        if not path.parent.is_dir():
            raise InputError(f"folder {str(path.parent)!r} does not exist; make it", file=path)
        if path.is_file() and not force:
            raise InputError("exists; pass --force, or force=True, to overwrite it", file=path)
    except (OSError, ValueError) as error:
        raise InputError(_reason(error), file=path) from None


def make_folder(folder: Path) -> None:
    """Make a folder and those above it, where they are missing.

    Raises
    ------
    InputError
        If the system does not let us.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        told = error.strerror if isinstance(error, OSError) else str(error)
        raise InputError(f"cannot be a folder ({told}); name another", file=folder) from None


def write_text_atomically(path: Path, text: str, force: bool = False) -> None:
    """Write a file whole or not at all.

    Parameters
    ----------
    path
        The file; a symbolic link is followed, and a device or pipe is written directly.
    text
        Its content, written in UTF-8 with plain line feeds.
    force
        Overwrite an existing file.

    Raises
    ------
    InputError
        If `require_writable` refuses, or the system does not let us write.
    """
    require_writable(path, force)
    try:
        with written_whole(path) as draft:
            draft.write_text(text, encoding="utf-8", newline="\n")
    except (OSError, ValueError) as error:
        raise InputError(_reason(error, "written"), file=path) from None


def _reason(error: Exception, done: str = "read") -> str:
    for kind, remedy in _REMEDIES:
        if isinstance(error, kind) and (done == "read" or kind is not FileNotFoundError):
            return remedy
    told = error.strerror if isinstance(error, OSError) else str(error)
    return f"cannot be {done} ({told}); check the name and the disk"
