"""Damage at which the HDF5 library never comes back, told before the library sees the file.

Texts and references of variable length lie in global heaps (HDF5 File Format Specification 3.0,
section III.E): a collection, eight bytes aligned, is a header and then objects one after the other

    "GCOL", version 1, 3 zeros, size of the collection (L bytes) | index (2), uses (2), 4 zeros,
    size s (L bytes), s bytes padded to eight | ... ,

where the object of index 0 is what is free, and its size counts its own header. Where that size is
0 the library, which walks from object to object, stays where it is for ever (HDFGroup/hdf5 1707),
and nothing but the end of the process stops it. A wrong size of an object before sends the walk
into the zeros of another: one damaged byte is enough.
"""

from __future__ import annotations

from pathlib import Path

__all__ = ["endless_heap"]

_SEARCHED = 2**26  # bytes from the start, where a file has its names; all of a large one takes long
_COLLECTION = b"GCOL\1\0\0\0"
_HEADER = 16  # bytes, of a collection and of an object, as L is at most 8


def endless_heap(path: Path | str) -> int | None:
    """Where an HDF5 file has a global heap with free space of no size, in its first 64 MB.

    Returns
    -------
    int | None
        Offset of the first one, in bytes; None if there is none.
    """
    with Path(path).open("rb") as file:
        content = file.read(_SEARCHED)
    width = int.from_bytes(content[14:15] if content[8:9] < b"\2" else content[10:11])
    at = content.find(_COLLECTION)
    while at >= 0 and _ends(content, at, width):
        at = content.find(_COLLECTION, at + 1)
    return at if at >= 0 else None


def _ends(content: bytes, at: int, width: int) -> bool:
    """Whether a walk through the objects of a collection comes to an end."""

    def size(header: int) -> int:
        return int.from_bytes(content[header + 8 : header + 8 + width], "little")

    end = min(at + size(at), len(content))
    at += _HEADER
    while at + _HEADER <= end:
        is_free = content[at : at + 2] == b"\0\0"
        if is_free and size(at) == 0:
            return False
        at += size(at) if is_free else _HEADER + -(-size(at) // 8) * 8
    return True
