"""KML in a zip archive, as Google Earth saves it by default.

The document is the first member at the root of the archive that ends in ``.kml``, by custom
``doc.kml``; pictures and whatever else lies beside it are left alone. It is unpacked in memory, and
nothing ever reaches the disk.

What no map program writes is refused: encryption, links, names that lead out of the archive,
archives in it, compression other than deflation. No size that the archive states is believed:
its members are counted by their signatures before it is opened, and unpacking ends at the size that
a text file may have.

References
----------
Open Geospatial Consortium, "OGC KML 2.3", OGC 12-007r2 (2015), annex C.
PKWARE, ".ZIP File Format Specification", version 6.3.10 (2022).
"""

from __future__ import annotations

import io
import itertools
import stat
import struct
import zipfile
import zlib
from pathlib import Path, PureWindowsPath

from fiveroute.errors import InputError
from fiveroute.formats.files import MAX_BYTES, ZIP, decoded, read_bytes

__all__ = ["MAX_MEMBERS", "chart_text", "document_in"]

MAX_MEMBERS = 10_000
"""Most members of an archive that is read; each may be a picture."""

_ENTRY = b"PK\x01\x02"  # begins the entry of every member in the directory of an archive
_ARCHIVES = (".kmz", ".zip")
_PACKING = "is packed in a way that is not read here; save it as KML"
_FAULTS = (zipfile.BadZipFile, zlib.error, struct.error, EOFError, OSError, ValueError)


def chart_text(path: Path) -> str:
    """The text of a chart, be it in an archive or not.

    Raises
    ------
    InputError
        If the file cannot be read, or `document_in` refuses it.
    """
    data = read_bytes(path)
    try:
        return decoded(document_in(data) if data.startswith(ZIP) else data)
    except InputError as error:
        raise error.at(path) from None


def document_in(data: bytes) -> bytes:
    """The KML document in an archive.

    Raises
    ------
    InputError
        If the archive is damaged, holds no document, or breaks a rule above.
    """
    if data.count(_ENTRY) > MAX_MEMBERS:
        raise InputError(f"is an archive of more than {MAX_MEMBERS} members; save it as KML")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            member = _document_of(archive.infolist())
            with archive.open(member) as stream:
                document = stream.read(MAX_BYTES + 1)
    except NotImplementedError:
        raise InputError(_PACKING) from None
    except _FAULTS as error:
        raise InputError(f"is a damaged zip archive ({error}); copy it again") from None
    if len(document) > MAX_BYTES:
        raise InputError(
            f"is larger than {MAX_BYTES // 2**20} MB when unpacked; split it", field=member.filename
        )
    return document


def _document_of(members: list[zipfile.ZipInfo]) -> zipfile.ZipInfo:
    """The member that is the document, in an archive of harmless ones."""
    for member in members:
        _require_harmless(member)
    names = [PureWindowsPath(member.filename) for member in members]  # knows both slashes
    at_root = [len(name.parts) == 1 and name.suffix.lower() == ".kml" for name in names]
    document = next(itertools.compress(members, at_root), None)
    if document is None:
        raise InputError(
            "is a zip archive without a .kml at its root; save a map as KML or KMZ, and a "
            "spreadsheet (.xlsx) as CSV UTF-8"
        )
    if document.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise InputError(_PACKING, field=document.filename)
    return document


def _require_harmless(member: zipfile.ZipInfo) -> None:
    """Refuse what no map program packs, whether or not it would be read."""
    name = PureWindowsPath(member.filename)
    rule = None
    if member.flag_bits & 0x1:
        rule = "is encrypted; save the map without a password"
    elif stat.S_ISLNK(member.external_attr >> 16):
        rule = "is a symbolic link; pack the file itself"
    elif name.anchor or ".." in name.parts:
        rule = "is a name that leads out of the archive; pack names below its root"
    elif name.suffix.lower() in _ARCHIVES:
        rule = "is an archive in an archive; unpack it first"
    if rule is not None:
        raise InputError(rule, field=member.filename)
