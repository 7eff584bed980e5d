"""Many instances: folders, workers, rows that are kept, and a run that is killed."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.experiments.gap_campaign import Entry, measure_all, read_entries
from fiveroute.experiments.gap_row import GapRow, GapSettings
from fiveroute.experiments.kept_rows import KeptRows
from fiveroute.limits import Limits, Progress

ROOT = Path(__file__).parent.parent.parent
SMALL = ROOT / "instances" / "small"
QUICK = GapSettings(side="heuristic")


def timeless(rows: Sequence[GapRow]) -> list[GapRow]:
    """All figures that do not depend on the machine."""
    return [replace(row, seconds=0.0, exact_seconds=None) for row in rows]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Three instances, and what else lies about in folders."""
    here = tmp_path / "instances"
    here.mkdir()
    for file in sorted(SMALL.glob("small-0[67]-*.json")):
        shutil.copy(file, here)
    (here / "README.md").write_text("Some instances.")
    (here / "best.csv").write_text("instance,best_known\n")
    (here / "torn.json").write_text('{"format": "fivero')
    (here / "more").mkdir()
    return here


def entries(folder: Path) -> list[Entry]:
    return read_entries([folder])[0]


def test_a_folder_is_all_its_instances_in_order(folder: Path) -> None:
    found, notes = read_entries([folder, folder / "small-07-m2-ring.json"])
    names = [entry.instance.name for entry in found]
    assert names[:-1] == sorted(names[:-1])
    assert len(names) == 4
    assert names[-1] == names[-2] == "small-07-m2-ring"
    assert len(notes) == 3
    assert sum("torn.json" in note for note in notes) == 1


def test_what_is_named_must_be_instances(folder: Path) -> None:
    with pytest.raises(InputError, match=r"torn\.json"):
        read_entries([folder / "torn.json"])
    with pytest.raises(InputError, match=r"more.*is a folder without any instance"):
        read_entries([folder / "more"])


def test_the_numbers_do_not_depend_on_the_workers(folder: Path) -> None:
    alone = measure_all(entries(folder), QUICK)
    assert [row.instance for row in alone] == [e.instance.name for e in entries(folder)]
    assert timeless(measure_all(entries(folder), QUICK, workers=2)) == timeless(alone)


@pytest.mark.filterwarnings(
    "ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"
)
def test_the_numbers_do_not_depend_on_the_cluster(folder: Path) -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=":0", silence_logs=50
    ) as cluster:
        there = measure_all(entries(folder), QUICK, scheduler=cluster.scheduler_address)
    assert timeless(there) == timeless(measure_all(entries(folder), QUICK))


def test_kept_rows_are_not_measured_again(folder: Path, tmp_path: Path) -> None:
    kept = KeptRows(tmp_path / "kept")
    first = measure_all(entries(folder)[:2], QUICK, kept=kept)
    again = measure_all(entries(folder), QUICK, kept=kept)
    assert again[:2] == first  # to the hundredth of a second


def test_other_settings_or_data_have_other_keys(folder: Path) -> None:
    entry, other = entries(folder)[:2]
    keys = {
        entry.key(QUICK),
        other.key(QUICK),
        entry.key(replace(QUICK, seed=1)),
        entry.key(replace(QUICK, time_limit=1.0)),
        entry.key(replace(QUICK, method="flow")),
        Entry(replace(entry.instance, name="else"), entry.file).key(QUICK),
    }
    assert len(keys) == 6
    assert entry.key(QUICK) in keys


def test_references_are_not_kept_with_the_rows(folder: Path, tmp_path: Path) -> None:
    kept, one = KeptRows(tmp_path / "kept"), entries(folder)[:1]
    name = one[0].instance.name
    assert measure_all(one, QUICK, kept=kept, reference={name: 99.0})[0].best_known == 99.0
    assert measure_all(one, QUICK, kept=kept)[0].best_known != 99.0


def test_an_interrupt_ends_it_and_keeps_no_torn_row(folder: Path, tmp_path: Path) -> None:
    limits = Limits()

    def stop(progress: Progress) -> None:
        if progress.message.startswith("instance 1"):
            limits.interrupt.set()

    kept = KeptRows(tmp_path / "kept")
    rows = measure_all(entries(folder), QUICK, kept=kept, limits=limits, progress=stop)
    assert len(rows) == 1
    assert len(list(kept.folder.iterdir())) == 1
    measure_all(entries(folder), QUICK, kept=kept, limits=limits)  # stopped from the start
    assert len(list(kept.folder.iterdir())) == 1


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system has no kill -9")
def test_a_killed_run_goes_on_where_it_was(tmp_path: Path) -> None:
    kept, table = tmp_path / "kept", tmp_path / "table.csv"
    names = [str(file) for file in sorted(SMALL.glob("*.json"))]
    call = [sys.executable, "-m", "fiveroute", "gap", *names, "--only", "heuristic"]
    call += ["--keep", str(kept), "--output", str(table), "--json"]
    with subprocess.Popen(call, stdout=subprocess.DEVNULL, cwd=ROOT) as run:
        while not (kept.is_dir() and len(list(kept.glob("small*.json"))) >= 2):
            assert run.poll() is None
            time.sleep(0.005)
        os.kill(run.pid, signal.SIGKILL)
    assert not table.exists()
    finished = {file: file.read_bytes() for file in kept.glob("small*.json")}
    assert 2 <= len(finished) < len(names)
    done = subprocess.run(call, capture_output=True, text=True, check=True, cwd=ROOT)
    rows = json.loads(done.stdout)["rows"]
    assert len(rows) == len(names)
    assert all(file.read_bytes() == content for file, content in finished.items())
    before = [GapRow.of_document(json.loads(content)) for content in finished.values()]
    after = {row["instance"]: GapRow.of_document(row) for row in rows}
    assert all(row is not None and after[row.instance] == row for row in before)
    assert len(table.read_text().splitlines()) == len(names) + 1


def test_an_interrupt_while_legs_are_planned_leaves_no_row() -> None:
    (at_sea,), _ = read_entries([ROOT / "instances" / "paper" / "scenario-01.json"])
    limits = Limits()

    def stop(progress: Progress) -> None:
        assert "paths" in progress.message
        limits.interrupt.set()

    assert measure_all([at_sea], QUICK, limits=limits, progress=stop) == []
