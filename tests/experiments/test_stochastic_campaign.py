"""The stochastic experiment: cells that are kept, a campaign that is killed, and the report."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from fiveroute.experiments.stochastic import cells_of, sail_cells
from fiveroute.experiments.stochastic_cell import Cell, Departure, Outcome
from fiveroute.experiments.stochastic_report import FILES, report, summary, write_report
from fiveroute.limits import Limits, Progress
from fiveroute.routes import Plan
from fiveroute.vehicle.fit import Estimate, Fit

RUNS = 6
CELLS = [Cell(1, "rmmp", fleet, RUNS) for fleet in (1, 2)]

PROGRAM = f"""
import sys, time
from pathlib import Path
from fiveroute.experiments.stochastic import sail_cells
from fiveroute.experiments.stochastic_cell import Cell

def wait(progress):
    time.sleep(0.5 * progress.message.startswith("run"))

sail_cells({CELLS}, Path(sys.argv[1]), progress=wait)
"""


def made_up(scenarios: int = 3) -> list[Outcome]:
    """Outcomes with known figures: five-tier 0.9, the others 0.8, but 0.95 once for RMMP with 4."""
    outcomes = []
    for cell in cells_of(scenarios, runs=2):
        rate = 0.9 if cell.planner == "five-tier" else 0.8
        if cell.scenario == 1 and cell.planner == "rmmp" and cell.fleet_size == 4:
            rate = 0.95
        best = (1.0, 1.0) if cell.gap else ()
        fleet = cell.fleet_size or 3
        outcomes.append(Outcome(cell, fleet, 0.9, (rate, rate), best, cell.scenario == 2, 0))
    return outcomes


def test_six_cells_a_scenario() -> None:
    cells = cells_of(2, runs=5)
    assert len(cells) == 12
    assert len({cell.key for cell in cells}) == 12
    assert replace(cells[0], seed=1).key != cells[0].key
    assert replace(cells[0], runs=6).key == cells[0].key, "more runs begin with the same ones"


def test_a_vehicle_sails_the_same_ocean_for_all() -> None:
    cells = [Cell(1, planner, 2, runs=2, actuation="vehicle") for planner in ("rmmp", "ftcmp")]
    for outcome in sail_cells(cells):
        assert outcome.collisions == 0
        assert outcome.min_clearance is not None
        assert outcome.min_clearance > 0.0
        assert 0.3 < outcome.mean < 1.0
    assert not any(cell.gap for cell in cells_of(1, runs=2, actuation="vehicle"))


@pytest.mark.filterwarnings(
    "ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"
)
def test_a_cluster_that_loses_a_worker_sails_the_same_cells(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    cells = [Cell(1, "ftcmp", fleet, runs=2) for fleet in (1, 2, 3)]
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as cluster:
        seen: list[Progress] = []

        def kill_one(progress: Progress) -> None:
            if not seen:
                os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)
            seen.append(progress)

        there = sail_cells(cells, tmp_path, scheduler=cluster.scheduler_address, progress=kill_one)
    assert there == sail_cells(cells)
    assert len(seen) == len(cells) + sum(cell.runs for cell in cells)


def test_the_numbers_do_not_depend_on_the_workers() -> None:
    cells = [Cell(1, "rmmp", 1, runs=3), Cell(2, "rmmp", 1, runs=2)]
    assert sail_cells(cells, workers=2) == sail_cells(cells)


def test_what_a_cell_sets_out_with_comes_back_as_it_was() -> None:
    share = Estimate(0.1, 0.01)
    fit = Fit(share, share, share, Estimate(0.0, 0.02), share, share, legs=9, failed=1)
    for departure in (
        Departure(Plan(((1, 2), ())), 0.75),
        Departure(Plan(((3,),)), 0.5, fit),
    ):
        document = json.loads(json.dumps(departure.document))
        assert Departure.of_document(document) == departure
    for spoilt in ({"plan": None}, document | {"fit": {"drift": 1}}, document | {"plan": [1]}):
        assert Departure.of_document(spoilt) is None


def test_figures_of_known_outcomes() -> None:
    figures = summary(made_up())
    assert figures["completion"]["five-tier"] == pytest.approx(0.9)
    assert figures["mean_fleet_size"] == 3.0
    assert figures["wins_at_own_fleet"] == 2
    assert figures["wins_at_equal_fleet"] == 3
    assert figures["advantage_at_equal_fleet"] == pytest.approx(0.9 / 0.8 - 1.0)
    assert figures["advantage_interval"] == pytest.approx([0.125, 0.125])
    assert figures["online_gap"]["five-tier"] == pytest.approx(0.1)
    assert figures["late_share"]["five-tier"] == pytest.approx(1.0 / 18.0)


def test_the_report_tells_what_tracks_prove() -> None:
    sailed = [
        replace(outcome, clairvoyant=(), min_clearance=9.5, lost=outcome.cell.scenario == 3)
        for outcome in made_up()
    ]
    assert "9.5 m" in report(sailed)
    assert "0 collisions, 6 AUVs that did not arrive" in report(sailed)
    assert "No gap to a clairvoyant plan" in report(sailed)
    assert summary(sailed)["min_clearance"] == 9.5
    assert "sailed by a vehicle" not in report(made_up())


def test_the_report_is_written_whole(tmp_path: Path) -> None:
    write_report(made_up(), tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == set(FILES)
    text = (tmp_path / "report.md").read_text()
    assert text == report(made_up())
    assert "2 of 3" in text


def test_what_is_kept_is_taken_and_what_is_spoilt_is_not(tmp_path: Path) -> None:
    cell = Cell(1, "rmmp", 3, runs=3)
    (first,) = sail_cells([cell], tmp_path)
    (row,), (journal,) = tmp_path.glob("*.json"), tmp_path.glob("*.jsonl")
    row.write_text(row.read_text().replace('"planned": ', '"planned": 1'))
    (kept,) = sail_cells([cell], tmp_path)
    assert kept.planned != first.planned, "it must come from the file"
    row.write_text("cut sho")
    journal.write_text(journal.read_text()[:-9])
    (again,) = sail_cells([cell], tmp_path)
    assert again == first
    (longer,) = sail_cells([replace(cell, runs=4)], tmp_path)
    assert longer.completions[:3] == first.completions
    assert _sailed(journal) == [0, 1, 2, 3]


def test_an_end_that_is_asked_for_leaves_whole_cells(tmp_path: Path) -> None:
    cells = [Cell(1, "rmmp", fleet, runs=1) for fleet in (1, 2)]
    limits = Limits()

    def stop(progress: Progress) -> None:
        if progress.message.startswith("run"):
            limits.interrupt.set()

    some = sail_cells(cells, tmp_path, limits=limits, progress=stop)
    assert [outcome.cell for outcome in some] == cells[:1]
    assert sail_cells(cells, tmp_path)[:1] == some


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
def test_a_campaign_that_is_killed_in_mid_cell_loses_no_finished_run(tmp_path: Path) -> None:
    process = subprocess.Popen([sys.executable, "-c", PROGRAM, str(tmp_path)])
    while not any(len(_sailed(file)) >= 2 for file in tmp_path.glob("*.jsonl")):
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    (journal,) = tmp_path.glob("*.jsonl")
    finished = len(_sailed(journal))
    assert 2 <= finished < RUNS
    begun = {file: file.stat().st_mtime_ns for file in tmp_path.glob("*.json")}
    told: list[str] = []
    resumed = sail_cells(CELLS, tmp_path, progress=lambda it: told.append(it.message))
    assert told[-1] == f"run {2 * RUNS - finished} of {2 * RUNS - finished}", "and no plan"
    assert begun == {file: file.stat().st_mtime_ns for file in tmp_path.glob("*.json")}
    for file in tmp_path.glob("*.jsonl"):
        assert _sailed(file) == [*range(RUNS)], "no finished run was sailed again"
    assert resumed == sail_cells(CELLS)


def _sailed(journal: Path) -> list[int]:
    """Numbers of the runs that a journal has, as often as they were sailed."""
    return sorted(run for line in journal.read_text().splitlines() if (run := _number(line)) >= 0)


def _number(line: str) -> int:
    try:
        return int(json.loads(line)["run"])
    except ValueError:
        return -1
