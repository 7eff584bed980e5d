"""Files and folders that appear whole or not at all."""

from __future__ import annotations

import ctypes
import io
import os
import secrets
import shutil
import sys
import zipfile
from collections.abc import Collection
from pathlib import Path

from fiveroute.errors import InputError
from fiveroute.formats.files import require_writable
from fiveroute.whole_files import written_whole

__all__ = ["write_archive", "write_folder"]

_HERE, _EXCHANGE = -100, 2  # AT_FDCWD and RENAME_EXCHANGE of Linux
_EPOCH = (1980, 1, 1, 0, 0, 0)  # the same archive for the same plan


def write_archive(path: Path, files: dict[str, str], force: bool) -> None:
    """Write several files into one zip archive."""
    require_writable(path, force)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(zipfile.ZipInfo(name, _EPOCH), text)
    try:
        with written_whole(path) as draft:
            draft.write_bytes(packed.getvalue())
    except OSError as error:
        raise _unwritable(path, error) from None


def write_folder(
    folder: Path, files: dict[str, str], suffixes: Collection[str], force: bool
) -> None:
    """Write a folder of files.

    Parameters
    ----------
    folder
        The folder; it must be missing or empty.
    files
        What is to be in it, by names that may have one folder in front.
    suffixes
        Endings of the files of this format.
    force
        Replace a folder that holds nothing but files with such endings.
    """
    if folder.name in ("", ".."):
        raise InputError("cannot take the place of this folder; name a new one", file=folder)
    draft = folder.with_name(f".{folder.name[:80]}.{secrets.token_hex(6)}")
    try:
        _require_replaceable(folder, suffixes, force)
        for name, text in files.items():
            path = draft / name
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("x", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
                stream.flush()
                os.fsync(stream.fileno())
        _take_place(draft, folder)
    except OSError as error:
        raise _unwritable(folder, error) from None
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def _require_replaceable(folder: Path, suffixes: Collection[str], force: bool) -> None:
    if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
        raise InputError("exists and is no folder; name another one", file=folder)
    if not folder.parent.is_dir():
        raise InputError(f"folder {str(folder.parent)!r} does not exist; make it", file=folder)
    if not folder.is_dir():
        return
    held = [path for path in folder.rglob("*") if path.is_symlink() or not path.is_dir()]
    if held and not force:
        told = "is a folder with files in it; pass --force, or force=True, to replace it"
        raise InputError(told, file=folder)
    foreign = [path for path in held if path.is_symlink() or path.suffix not in suffixes]
    if foreign:
        raise InputError(
            f"holds other things than {', '.join(sorted(suffixes))} files, and replacing it would "
            "delete them; name another folder",
            value=str(foreign[0].relative_to(folder)),
            file=folder,
        )


def _take_place(draft: Path, folder: Path) -> None:
    """Put a folder in another one's place, in one step where the system knows such a step."""
    if not folder.exists():
        draft.rename(folder)
        return
    old = draft
    if not _exchanged(draft, folder):
        old = draft.with_name(f"{draft.name}.old")
        folder.rename(old)
        draft.rename(folder)
    shutil.rmtree(old, ignore_errors=True)


def _exchanged(one: Path, other: Path) -> bool:
    """Exchange two names at once, which Linux has known since 3.15, but Python does not."""
    rename = getattr(ctypes.CDLL(None), "renameat2", None) if sys.platform == "linux" else None
    if rename is None:
        return False
    return bool(rename(_HERE, os.fsencode(one), _HERE, os.fsencode(other), _EXCHANGE) == 0)


def _unwritable(path: Path, error: OSError) -> InputError:
    return InputError(
        f"cannot be written ({error.strerror}); check the name and the disk", file=path
    )
