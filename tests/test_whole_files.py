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
