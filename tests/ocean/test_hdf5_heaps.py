"""Heaps of HDF5 files: well-formed ones end, damaged ones are told before HDF5 never comes back."""

from pathlib import Path

import numpy as np
import pytest

from fiveroute.errors import InputError
from fiveroute.ocean.hdf5_heaps import endless_heap
from fiveroute.ocean.model_file import open_model_file

HEAP = b"GCOL\1\0\0\0"


@pytest.fixture(params=["earliest", "latest"])
def words(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A file with 500 words of variable length, with an old superblock or a new one."""
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "words.nc"
    with h5py.File(path, "w", libver=request.param) as file:
        file["words"] = [f"word {'x' * k}" for k in range(500)]
    return path


def test_whole_heaps_end(words: Path) -> None:
    assert HEAP in words.read_bytes()
    assert endless_heap(words) is None


def test_free_space_of_no_size_has_no_end(words: Path) -> None:
    content = bytearray(words.read_bytes())
    at = content.rindex(HEAP)
    content[at + 16 : at + 32] = bytes(16)
    words.write_bytes(content)
    assert endless_heap(words) == at


def test_one_damaged_byte_is_told(tmp_path: Path) -> None:
    """What is longer than it was ends in the middle of zeros, where HDF5 would stay."""
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "sea.nc"
    with h5py.File(path, "w") as file:
        file.create_dataset("rows", 2, h5py.vlen_dtype("u1"))[:] = [[1, 2], [0] * 300]
    content = bytearray(path.read_bytes())
    first = content.index(HEAP) + 16
    assert content[first : first + 2] == b"\1\0"
    content[first + 8] = 100
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"the heap at byte \d+ is damaged"), open_model_file(path):
        pass


@pytest.mark.parametrize("content", [b"", b"\x89HDF", HEAP, HEAP * 40, b"\x89HDF" + HEAP[:7]])
def test_any_bytes_have_an_answer(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "file.nc"
    path.write_bytes(content)
    assert endless_heap(path) in (None, 0)


def test_cut_heaps_end_where_the_file_ends(words: Path) -> None:
    content = words.read_bytes()
    for end in np.linspace(content.index(HEAP), len(content) - 1, 20, dtype=int):
        words.write_bytes(content[:end])
        assert endless_heap(words) is None
