"""Leg tables on disk: the same ocean is not planned twice.

A table is kept under a key of everything that it depends on: the current's grid, the barriers,
the vehicle, the stops, the seed, and the source of the planners. The folder is the user's cache
folder, or the one that FIVEROUTE_CACHE names; nothing in it is needed. A file that cannot be
read, says another key or holds what is no table is not believed, and planned anew. The least used
tables go when there are too many.
"""

from __future__ import annotations

import hashlib
import os
import zipfile
import zlib
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.waters import Waters
from fiveroute.whole_files import written_whole

__all__ = ["cache_folder", "keep_table", "kept_table", "table_key"]

_MOST = 50
"""Tables that are kept."""

_SPOILT = (
    *(OSError, EOFError, ValueError, KeyError, TypeError, SyntaxError),
    *(zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, MemoryError),
)
"""What reading a file that is none may end in."""

_LARGEST = 2**30
"""Bytes of a part of a table at most: 10,000 stops have 800 MB of times."""


def cache_folder() -> Path:
    """Folder of the tables.

    Raises
    ------
    OSError
        If nobody knows the home of this user, as in some containers.
    """
    from platformdirs import user_cache_path

    named = os.environ.get("FIVEROUTE_CACHE")
    try:
        return (Path(named) if named else user_cache_path("fiveroute")) / "legs"
    except RuntimeError as error:
        raise OSError(str(error)) from None


def table_key(waters: Waters, points: NDArray[np.float64], source: str, seed: int) -> str:
    """Key of a table in hexadecimal.

    Parameters
    ----------
    waters
        The ocean.
    points
        Stops in metres, shape (n + 2, 2).
    source
        Digest of the planners' source.
    seed
        Seed of the random numbers.
    """
    digest = hashlib.sha256(f"{source} {seed} {waters.speed} {waters.turning_radius}".encode())
    for part in (*waters.grid, *waters.barriers, points):
        values = np.ascontiguousarray(part)
        digest.update(f"{values.dtype} {values.shape}".encode() + values.tobytes())
    return digest.hexdigest()


def kept_table(key: str) -> LegTable | None:
    """The table of a key, if it is kept."""
    table = None
    with suppress(*_SPOILT):
        file = cache_folder() / f"{key}.npz"
        with file.open("rb") as stream, zipfile.ZipFile(stream) as archive:
            if max(part.file_size for part in archive.infolist()) <= _LARGEST:
                table = _read(stream, key)
        if table is not None:
            file.touch()
    return table


def _read(stream: BinaryIO, key: str) -> LegTable | None:
    """The table in a file, if it is the one of that key, and is one at all."""
    stream.seek(0)
    with np.load(stream, allow_pickle=False) as kept:
        table = LegTable(kept["times"], kept["first"], kept["legs"], kept["tracks"])
        return table if str(kept["key"]) == key and _is_sound(table) else None


def _is_sound(table: LegTable) -> bool:
    """Whether shapes, types and numbers are those of a table."""
    times, first, legs, tracks = table.times, table.first, table.legs, table.tracks
    size, count = len(times), len(legs)
    kinds = [str(part.dtype) for part in (times, first, legs, tracks)]
    if kinds != ["float64", "int64", "int64", "float64"]:
        return False
    if (times.shape, first.shape, legs.shape) != ((size, size), (count + 1,), (count, 2)):
        return False
    return bool(
        tracks.shape == (len(tracks), 2)
        and np.isfinite(tracks).all()
        and (times >= 0.0).all()
        and ((legs >= 0) & (legs < size)).all()
        and (first[0], first[-1]) == (0, len(tracks))
        and (np.diff(first) >= 1).all()
    )


def keep_table(key: str, table: LegTable) -> None:
    """Keep a table; a folder that cannot be written keeps none."""
    with suppress(OSError):
        folder = cache_folder()
        folder.mkdir(parents=True, exist_ok=True)
        with written_whole(folder / f"{key}.npz") as draft:
            np.savez_compressed(
                draft,
                key=np.array(key),
                times=table.times,
                first=table.first,
                legs=table.legs,
                tracks=table.tracks,
            )
        kept = sorted(folder.glob("*.npz"), key=lambda file: file.stat().st_mtime)
        for stale in kept[:-_MOST]:
            stale.unlink()
