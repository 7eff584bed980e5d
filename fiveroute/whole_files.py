"""Files written whole or not at all.

The content goes into a temporary file in the same folder, which then takes the place of the old one
in a single step. Whoever is interrupted leaves the old file or the new one, never half of one.
"""

from __future__ import annotations

import errno
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

__all__ = ["written_whole"]


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """A draft beside a file, with its suffix, that takes the file's place if all goes well.

    A symbolic link is followed. A device or a pipe is handed out itself: it has no place to take.
    """
    target = Path(os.path.realpath(path))
    if target.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    if target.exists() and not target.is_file():
        yield target
        return
    draft = target.with_name(f".{target.stem[:80]}.{secrets.token_hex(6)}{path.suffix[:20]}")
    try:
        yield draft
        with draft.open("rb") as stream:
            os.fsync(stream.fileno())  # the name must not be on the disk before the content is
        if target.exists():
            draft.chmod(target.stat().st_mode)
        draft.replace(target)
    finally:
        draft.unlink(missing_ok=True)
