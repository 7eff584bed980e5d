"""Leg tables on disk: the same ocean is not planned twice.

A table is kept under a key of everything that it depends on: the current's grid, the barriers,
the vehicle, the stops, the seed, and the source of the planners. The folder is the user's cache
folder, or the one that FIVEROUTE_CACHE names; nothing in it is needed, and a file that cannot be
read is planned anew. The least used tables go when there are too many.
"""

from __future__ import annotations

import hashlib
import os
import zipfile
from contextlib import suppress
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fiveroute.formats.files import written_whole
from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.legs import Waters

__all__ = ["cache_folder", "keep_table", "kept_table", "table_key"]

_MOST = 50
"""Tables that are kept."""

_SPOILT = (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile)
"""What reading a file that is none may end in."""


def cache_folder() -> Path:
    """Folder of the tables."""
    from platformdirs import user_cache_path

    named = os.environ.get("FIVEROUTE_CACHE")
    return (Path(named) if named else user_cache_path("fiveroute")) / "legs"


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
    file = cache_folder() / f"{key}.npz"
    with suppress(*_SPOILT), file.open("rb") as stream, np.load(stream) as kept:
        table = LegTable(kept["times"], kept["first"], kept["legs"], kept["tracks"])
        file.touch()
        return table
    return None


def keep_table(key: str, table: LegTable) -> None:
    """Keep a table; a folder that cannot be written keeps none."""
    folder = cache_folder()
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        with written_whole(folder / f"{key}.npz") as draft:
            np.savez_compressed(
                draft,
                times=table.times,
                first=table.first,
                legs=table.legs,
                tracks=table.tracks,
            )
        kept = sorted(folder.glob("*.npz"), key=lambda file: file.stat().st_mtime)
        for stale in kept[:-_MOST]:
            stale.unlink()
