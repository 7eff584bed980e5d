"""Nothing in a cache is believed: what is spoilt or hostile is computed anew."""

import io
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fiveroute.experiments.gap_row import GapRow
from fiveroute.experiments.kept_rows import KeptRows
from fiveroute.paths import leg_cache
from fiveroute.paths.leg_cache import cache_folder, keep_table, kept_table
from fiveroute.paths.leg_table import LegTable
from fiveroute.sea.journal import Journal

TABLE = LegTable.of(3, {(0, 1): (5.0, np.array([[0.0, 0.0], [3.0, 4.0]]))})
PARTS = {
    "key": np.array("key"),
    "times": TABLE.times,
    "first": TABLE.first,
    "legs": TABLE.legs,
    "tracks": TABLE.tracks,
}


class Trap:
    """What unpickling would run."""

    def __reduce__(self) -> tuple[Callable[[str], None], tuple[str]]:
        return os.mkdir, ("trapped",)


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the table "key" is kept."""
    monkeypatch.setenv("FIVEROUTE_CACHE", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    keep_table("key", TABLE)
    assert kept_table("key") is not None
    return cache_folder() / "key.npz"


@pytest.mark.parametrize(
    "parts",
    [
        {"times": np.full((3, 3), np.nan)},
        {"times": -TABLE.times},
        {"times": np.zeros((2, 3))},
        {"times": np.zeros((3, 3), dtype=np.float32)},
        {"times": np.array([Trap()], dtype=object)},
        {"first": np.array([0, 9])},
        {"first": np.array([2, 0])},
        {"first": np.array([0.0, 2.0])},
        {"legs": np.array([[0, 7]])},
        {"legs": np.array([[-1, 1]])},
        {"tracks": np.full((2, 2), np.inf)},
        {"tracks": np.zeros((2, 3))},
        {"key": np.array("another")},
        {"key": np.zeros(3)},
    ],
)
def test_a_table_that_is_none_is_planned_anew(file: Path, parts: dict[str, object]) -> None:
    np.savez(file, **(PARTS | parts))  # type: ignore[arg-type]
    assert kept_table("key") is None
    assert not Path("trapped").exists()


def test_a_table_under_another_name_is_planned_anew(file: Path) -> None:
    file.rename(file.with_name("other.npz"))
    assert kept_table("other") is None


def test_a_spoilt_bit_never_shows(file: Path) -> None:
    """Whatever bit of the file is another one, the table is the same or none."""
    content = file.read_bytes()
    rng = np.random.default_rng(0)
    for place in rng.integers(0, len(content), 300).tolist():
        spoilt = bytearray(content)
        spoilt[place] ^= 1 << int(rng.integers(8))
        file.write_bytes(bytes(spoilt))
        table = kept_table("key")
        assert table is None or np.array_equal(table.times, TABLE.times)
        assert table is None or np.array_equal(table.tracks, TABLE.tracks)


def test_an_archive_that_unpacks_without_end_is_left_alone(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(leg_cache, "_LARGEST", 2**20)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("times.npy", bytes(2**21))
    file.write_bytes(packed.getvalue())
    assert kept_table("key") is None


def test_an_array_that_claims_more_than_there_is(file: Path) -> None:
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000, 1000000), }"
    text = b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("times.npy", text)
    assert kept_table("key") is None


@pytest.mark.parametrize(
    "text",
    ["", "[]", "[" * 100_000, '{"peers": 1}', '{"peers": {"a": {}}}', '{"nodes": "\\ud800"}'],
)
def test_a_row_that_is_none_is_measured_anew(text: str, tmp_path: Path) -> None:
    kept = KeptRows(tmp_path)
    kept.put("label", "key", {"a": 1})
    (file,) = tmp_path.iterdir()
    file.write_text(text)
    document = kept.get("label", "key")
    assert document is None or GapRow.of_document(document) is None


@pytest.mark.parametrize("label", ["../../x", "/etc/passwd", "a\0b", "..", "", "CON", "\udcff"])
def test_a_row_stays_in_its_folder(label: str, tmp_path: Path) -> None:
    folder = tmp_path / "rows"
    kept = KeptRows(folder)
    kept.put(label, "key", {"a": 1})
    assert kept.get(label, "key") == {"a": 1}
    assert [path.name for path in tmp_path.iterdir()] == ["rows"]


KERNELS = """
import sys
from pathlib import Path
sys.path.insert(0, {root!r})
from fiveroute import kernels
kernels._PACKAGE = Path(sys.argv[1])
@kernels.kernel
def thrice(x):
    return 3.0 * x
@kernels.kernel
def half(x):
    return 0.5 * x
print(thrice(2.0), half(2.0), *(len(kept.stats.cache_hits) for kept in (thrice, half)))
"""


def _results(folder: Path) -> list[str]:
    """Results of two kernels that are kept in a folder, and how many came from there."""
    script = folder / "script.py"
    script.write_text(KERNELS.format(root=str(Path(__file__).parents[2])))
    done = subprocess.run(
        [sys.executable, str(script), str(folder)], capture_output=True, text=True, check=True
    )
    assert done.stderr == ""
    return done.stdout.split()


def test_spoilt_kernels_are_compiled_anew(tmp_path: Path) -> None:
    """A bit of the one kernel is another one, the index of the other is empty."""
    assert _results(tmp_path) == ["6.0", "1.0", "0", "0"]
    (data,) = tmp_path.rglob("*thrice*.nbc")
    (index,) = tmp_path.rglob("*half*.nbi")
    spoilt = bytearray(data.read_bytes())
    spoilt[len(spoilt) // 2] ^= 1
    data.write_bytes(bytes(spoilt))
    index.write_bytes(b"")
    assert _results(tmp_path) == ["6.0", "1.0", "0", "0"]
    assert _results(tmp_path) == ["6.0", "1.0", "1", "1"]


@pytest.mark.parametrize(
    "line", [b"[]", b"1", b"{}", b"[" * 100_000, b"\xff", b'{"arrivals": ["x"]}', b'{"run": {}}']
)
def test_a_line_of_a_journal_that_is_none_is_sailed_anew(line: bytes, tmp_path: Path) -> None:
    (tmp_path / "x.run.jsonl").write_bytes(line + b"\n")
    assert Journal(tmp_path / "x.run.jsonl").runs() == []
