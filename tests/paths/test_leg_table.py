"""Leg tables: what goes in comes out, in part and after a detour over the disk."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fiveroute.ocean.barriers import no_barriers
from fiveroute.ocean.current_grid import Region, grid_current
from fiveroute.ocean.currents import UniformCurrent
from fiveroute.paths.leg_cache import cache_folder, keep_table, kept_table, table_key
from fiveroute.paths.leg_table import LegTable
from fiveroute.paths.waters import Waters


def table() -> LegTable:
    """Start 0, nodes 1 and 2, destination 3; nobody gets to node 2, and there is no leg 1 to 0."""
    return LegTable.of(
        4,
        {
            (0, 1): (10.0, np.array([[0.0, 0.0], [3.0, 4.0], [6.0, 8.0]])),
            (1, 3): (7.0, np.array([[6.0, 8.0], [9.0, 9.0]])),
            (0, 3): (12.5, np.array([[0.0, 0.0], [9.0, 9.0]])),
        },
    )


def test_times_of_legs() -> None:
    times = table().times
    assert times[0, 1] == 10.0
    assert times[0, 3] == 12.5
    assert np.isinf(times[1, 0])
    assert (np.diag(times) == 0.0).all()


def test_tracks_of_legs() -> None:
    assert table().track(1, 3).tolist() == [[6.0, 8.0], [9.0, 9.0]]
    with pytest.raises(KeyError):
        table().track(3, 1)


def test_a_node_that_nobody_gets_to_is_named() -> None:
    assert table().unreachable() == (2,)


def test_some_of_the_stops() -> None:
    part = table().take([0, 1, 3])
    assert part.times.tolist() == [[0.0, 10.0, 12.5], [np.inf, 0.0, 7.0], [np.inf, np.inf, 0.0]]
    assert part.track(1, 2).tolist() == [[6.0, 8.0], [9.0, 9.0]]
    assert part.unreachable() == ()


def test_a_table_without_legs() -> None:
    empty = LegTable.of(2, {})
    assert empty.tracks.shape == (0, 2)
    assert list(empty.planned()) == []


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("FIVEROUTE_CACHE", str(tmp_path))
    return cache_folder()


def test_a_table_is_kept(folder: Path) -> None:
    assert kept_table("key") is None
    keep_table("key", table())
    kept = kept_table("key")
    assert kept is not None
    assert kept.times.tolist() == table().times.tolist()
    assert kept.track(0, 1).tolist() == table().track(0, 1).tolist()
    assert [file.name for file in folder.iterdir()] == ["key.npz"]


@pytest.mark.parametrize("content", [b"", b"junk", b"PK\x03\x04 cut short"])
def test_a_spoilt_file_counts_as_none(folder: Path, content: bytes) -> None:
    folder.mkdir(parents=True)
    (folder / "key.npz").write_bytes(content)
    assert kept_table("key") is None


def test_a_folder_that_cannot_be_written_keeps_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("FIVEROUTE_CACHE", str(tmp_path / "file"))
    keep_table("key", table())
    assert kept_table("key") is None


def test_the_oldest_tables_go(folder: Path) -> None:
    for k in range(52):
        keep_table(f"key{k}", table())
    assert len(list(folder.glob("*.npz"))) == 50


def test_a_key_knows_all_that_matters() -> None:
    grid = grid_current(UniformCurrent(0.1, 0.0), Region(0.0, 0.0, 100.0, 100.0))
    waters, points = Waters(grid, no_barriers(), 1.0), np.zeros((2, 2))
    stronger = grid_current(UniformCurrent(0.2, 0.0), Region(0.0, 0.0, 100.0, 100.0))
    keys = {
        table_key(waters, points, "source", 0),
        table_key(waters, points, "source", 1),
        table_key(waters, points, "other", 0),
        table_key(waters, points + 1.0, "source", 0),
        table_key(Waters(stronger, no_barriers(), 1.0), points, "source", 0),
        table_key(Waters(grid, no_barriers(), 2.0), points, "source", 0),
        table_key(Waters(grid, no_barriers(), 1.0, 5.0), points, "source", 0),
        table_key(
            Waters(grid, no_barriers()._replace(circles=np.ones((1, 3))), 1.0), points, "source", 0
        ),
    }
    assert len(keys) == 8
    assert table_key(waters, points, "source", 0) in keys
