import os
from pathlib import Path

import pytest

from fiveroute.whole_files import written_whole


def test_the_draft_takes_the_place_of_the_file(tmp_path: Path) -> None:
    file = tmp_path / "legs.npz"
    file.write_bytes(b"old")
    with written_whole(file) as draft:
        assert draft.suffix == ".npz"  # writers that go by the suffix write the right format
        draft.write_bytes(b"new")
        assert file.read_bytes() == b"old"
    assert file.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [file]


def test_a_draft_that_fails_is_thrown_away(tmp_path: Path) -> None:
    file = tmp_path / "legs.npz"
    file.write_bytes(b"old")

    def fail() -> None:
        with written_whole(file) as draft:
            draft.write_bytes(b"ne")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert file.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [file]


def test_a_link_is_followed_and_stays(tmp_path: Path) -> None:
    file, link = tmp_path / "chart.old", tmp_path / "chart.png"
    file.write_bytes(b"old")
    link.symlink_to(file)
    with written_whole(link) as draft:
        assert draft.suffix == ".png"
        draft.write_bytes(b"new")
    assert link.is_symlink()
    assert file.read_bytes() == b"new"


def test_a_link_to_itself_is_an_error_of_the_system(tmp_path: Path) -> None:
    link = tmp_path / "loop.png"
    link.symlink_to(link)
    with pytest.raises(OSError, match="symbolic links"), written_whole(link):
        pass
    assert link.is_symlink()


def test_a_pipe_stays_a_pipe(tmp_path: Path) -> None:
    pipe = tmp_path / "rows.parquet"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    with written_whole(pipe) as draft:
        draft.write_bytes(b"new")
    assert os.read(reader, 9) == b"new"
    os.close(reader)
    assert pipe.is_fifo()
