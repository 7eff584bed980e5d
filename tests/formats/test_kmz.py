"""KMZ: the document at the root of an archive is read in memory, and trickery is refused."""

from __future__ import annotations

import io
import stat
import struct
import tracemalloc
import zipfile
from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import kml_nodes, kmz, read_instance, read_survey, survey_format

KML = (
    b'<kml xmlns="http://www.opengis.net/kml/2.2"><Placemark><name>a</name>'
    b"<Point><coordinates>10,63,-5</coordinates></Point></Placemark></kml>"
)
EMPTY = b"<kml/>"
Member = tuple[str | zipfile.ZipInfo, bytes]


def packed(*members: Member, how: int = zipfile.ZIP_DEFLATED) -> bytes:
    into = io.BytesIO()
    with zipfile.ZipFile(into, "w", how) as archive:
        for name, content in members:
            archive.writestr(name, content)
    return into.getvalue()


def link(name: str) -> zipfile.ZipInfo:
    member = zipfile.ZipInfo(name)
    member.create_system = 3
    member.external_attr = (stat.S_IFLNK | 0o777) << 16
    return member


def claiming(size: int, data: bytes) -> bytes:
    """An archive of one member whose directory claims another size of the unpacked member."""
    at = data.rindex(b"PK\x01\x02") + 24
    return data[:at] + struct.pack("<L", size) + data[at + 4 :]


def encrypted(data: bytes) -> bytes:
    for signature, flags in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = data.rindex(signature) + flags
        data = data[:at] + bytes([data[at] | 1]) + data[at + 1 :]
    return data


@pytest.mark.parametrize("how", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
@pytest.mark.parametrize("name", ["doc.kml", "My Places.KML"])
def test_the_document_says_what_it_says_alone(tmp_path: Path, how: int, name: str) -> None:
    path = tmp_path / "places.kmz"
    beside = [("files/icon.png", b"\x89PNG"), ("files/more.kml", EMPTY), ("files\\old.kml", EMPTY)]
    path.write_bytes(packed(*beside, (name, KML), ("second.kml", EMPTY), how=how))
    assert read_survey(path) == read_survey(path, "kml") == kml_nodes.read(KML.decode())
    assert survey_format(path, kmz.chart_text(path)) == "kml"
    assert [file.name for file in tmp_path.iterdir()] == ["places.kmz"]  # nothing is unpacked


def test_other_commands_name_the_way(tmp_path: Path) -> None:
    path = tmp_path / "places.kmz"
    path.write_bytes(packed(("doc.kml", KML)))
    with pytest.raises(InputError, match=r"places.kmz: is a chart of nodes \(kml\).*convert"):
        read_instance(path)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (packed(("xl/workbook.xml", b"<x/>")), r"^file: is a zip .* without a \.kml.*\.xlsx"),
        (packed(("places/doc.kml", KML)), r"without a \.kml at its root"),
        (
            packed(("doc.kml", KML), ("b/../../x.png", b"")),
            r"\.\./x\.png: is a name that leads out",
        ),
        (packed(("doc.kml", KML), ("b\\..\\..\\x.png", b"")), "is a name that leads out"),
        (packed(("/doc.kml", KML)), "leads out of the archive"),
        (packed(("C:doc.kml", KML)), "leads out of the archive"),
        (packed((link("doc.kml"), b"/etc/passwd")), r"doc\.kml: is a symbolic link"),
        (packed(("doc.kml", KML), (link("icon.png"), b"/etc")), "icon.png: is a symbolic link"),
        (packed(("doc.kml", KML), ("more.kmz", b"")), "more.kmz: is an archive in an archive"),
        (packed(("doc.kml", packed(("doc.kml", KML)))), "is a zip archive"),
        (encrypted(packed(("doc.kml", KML))), r"doc\.kml: is encrypted"),
        (packed(("doc.kml", KML), how=zipfile.ZIP_BZIP2), r"doc\.kml: is packed in a way"),
        (packed(("doc.kml", KML), how=zipfile.ZIP_LZMA), r"doc\.kml: is packed in a way"),
        (packed(("doc.kml", KML))[:-5], "is a damaged zip archive .*copy it again"),
        (packed(("doc.kml", KML)).replace(b"doc", b"dog", 1), "is a damaged zip archive"),
        (packed(("doc.kml", b"\xff"), how=zipfile.ZIP_STORED), "is no UTF-8 text"),
        (packed(("doc.kml", b"")), "is empty"),
        (claiming(9, packed(("doc.kml", KML))), r"is a damaged zip archive \(Bad CRC"),
        (packed(("doc.kml", KML), ("a", kmz._ENTRY * 10_000), how=0), "more than 10000 members"),
    ],
)
def test_trickery_is_refused_in_one_line(tmp_path: Path, data: bytes, words: str) -> None:
    path = tmp_path / "places.kmz"
    path.write_bytes(data)
    with pytest.raises(InputError) as told:
        read_survey(path)
    assert told.value.file == path
    with pytest.raises(InputError, match=words):
        raise told.value.at("file")


@pytest.mark.parametrize("claim", [9, 2**32 - 2])
def test_a_bomb_is_stopped_while_it_is_unpacked(
    claim: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever size its directory claims, no more is ever held than a text file may have."""
    monkeypatch.setattr(kmz, "MAX_BYTES", 2**20)
    bomb = claiming(claim, packed(("doc.kml", bytes(50 * 2**20))))
    tracemalloc.start()
    with pytest.raises(
        InputError, match=r"Bad CRC" if claim == 9 else r"doc\.kml: is larger than 1"
    ):
        kmz.document_in(bomb)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 3 * 2**20
