import os
import stat
from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.formats import files
from fiveroute.formats.files import (
    integer,
    non_negative,
    number,
    numbered_lines,
    positive,
    read_text,
    require_writable,
    write_text_atomically,
)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "file.txt"


def test_text_comes_back(file: Path) -> None:
    write_text_atomically(file, "Ærø\n")
    assert file.read_bytes() == "Ærø\n".encode()
    assert read_text(file) == "Ærø\n"
    assert list(file.parent.iterdir()) == [file]


def test_byte_order_mark_is_no_text(file: Path) -> None:
    file.write_bytes(b"\xef\xbb\xbfn 3")
    assert read_text(file) == "n 3"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b" \r\n\t", "is empty"),
        (b"n 3\nm \xe4", r"line 2: b'\\xe4': is no UTF-8 text"),
        (b"n\x00 3", "is a binary file"),
        (b"\x89PNG\r\n\x1a\n\x00\x00", "line 1: .* is no UTF-8 text"),
    ],
)
def test_what_is_no_text_is_refused(file: Path, content: bytes, words: str) -> None:
    file.write_bytes(content)
    with pytest.raises(InputError, match=f"file.txt.*{words}"):
        read_text(file)


def test_large_files_are_refused_unread(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "MAX_BYTES", 2**20)
    with file.open("wb") as stream:
        stream.truncate(200 * 2**20)  # sparse: takes no room
    with pytest.raises(InputError, match="is larger than 1 MB"):
        read_text(file)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        (".", "is a folder"),
        ("missing.json", "does not exist"),
        ("missing/file.json", "does not exist"),
        ("a\0b", "embedded null"),
        ("x" * 300, "too long"),
    ],
)
def test_what_cannot_be_opened_is_refused(tmp_path: Path, name: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_text(tmp_path / name)


def test_permission_denied_is_said_plainly(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*arguments: object, **named: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(InputError, match="permission denied; change its permissions"):
        read_text(file)
    with pytest.raises(InputError, match="permission denied; change its permissions"):
        write_text_atomically(file, "new")


def test_existing_files_stay_without_force(file: Path) -> None:
    file.write_text("old")
    with pytest.raises(InputError, match="exists; pass --force"):
        write_text_atomically(file, "new")
    assert file.read_text() == "old"
    write_text_atomically(file, "new", force=True)
    assert file.read_text() == "new"


@pytest.mark.parametrize("name", [".", "missing/file.txt"])
def test_hopeless_outputs_are_refused_early(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError):
        require_writable(tmp_path / name, force=True)


@pytest.mark.parametrize("name", ["a\0b", "x" * 300])
def test_impossible_names_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError):
        write_text_atomically(tmp_path / name, "text")


def test_failed_write_leaves_everything_as_it_was(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    file.write_text("old")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(InputError, match=r"cannot be written \(No space left on device\)"):
        write_text_atomically(file, "new", force=True)
    assert file.read_text() == "old"
    assert list(file.parent.iterdir()) == [file]


def test_interrupted_write_leaves_no_trace(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(descriptor: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_text_atomically(file, "new")
    assert list(file.parent.iterdir()) == []


def test_links_are_followed_and_permissions_kept(file: Path) -> None:
    link = file.with_name("link.txt")
    file.write_text("old")
    file.chmod(0o640)
    link.symlink_to(file)
    write_text_atomically(link, "new", force=True)
    assert link.is_symlink()
    assert file.read_text() == "new"
    assert stat.S_IMODE(file.stat().st_mode) == 0o640


def test_devices_are_written_not_replaced() -> None:
    write_text_atomically(Path(os.devnull), "gone")
    assert Path(os.devnull).is_char_device()


def test_lines_are_counted_as_editors_count_them() -> None:
    assert list(numbered_lines("a\r\n\n  b \rc\x0bd\n")) == [(1, "a"), (3, "b"), (4, "c\x0bd")]


@pytest.mark.parametrize("token", ["nan", "inf", "-inf", "1e999", "1_0", "", "x", "0x10", "1,5"])
def test_only_finite_numbers_are_numbers(token: str) -> None:
    with pytest.raises(InputError, match="line 7, x: "):
        number(token, "x", 7)


def test_ranges_of_numbers() -> None:
    assert number("-1.5e3", "x", 1) == -1500.0
    assert non_negative("0", "x", 1) == 0.0
    assert positive("0.1", "x", 1) == 0.1
    assert integer("12", "x", 1) == 12
    with pytest.raises(InputError, match="not be negative"):
        non_negative("-0.1", "x", 1)
    with pytest.raises(InputError, match="greater than 0"):
        positive("0", "x", 1)
    for token in ("0", "1.0", "1_0", "x", "9" * 5000):
        with pytest.raises(InputError, match="whole number"):
            integer(token, "x", 1)
