"""The stochastic experiment: cells that are kept, a campaign that is killed, and the report."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fiveroute.experiments.stochastic import Cell, Outcome, cells_of, sail_cell, sail_cells
from fiveroute.experiments.stochastic_report import FILES, report, summary, write_report


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
    assert replace(cells[0], runs=6).key != cells[0].key


def test_a_vehicle_sails_the_same_ocean_for_all() -> None:
    cells = [Cell(1, planner, 2, runs=2, actuation="vehicle") for planner in ("rmmp", "ftcmp")]
    outcomes = [sail_cell(cell) for cell in cells]
    for outcome in outcomes:
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
        outcomes: list[Outcome] = []
        for outcome in sail_cells(cells, tmp_path, scheduler=cluster.scheduler_address):
            if not outcomes:
                next(iter(cluster.workers.values())).process.process.kill()
            outcomes.append(outcome)
    assert sorted(outcomes, key=lambda outcome: outcome.fleet_size) == list(sail_cells(cells))
    assert len(list(tmp_path.iterdir())) == len(cells)


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


def test_a_cell_is_repeatable_and_kept(tmp_path: Path) -> None:
    cell = Cell(1, "rmmp", 3, runs=3)
    (first,) = sail_cells([cell], tmp_path)
    assert first == sail_cell(cell)
    (file,) = tmp_path.iterdir()
    file.write_text(file.read_text().replace('"planned": ', '"planned": 1'))
    (kept,) = sail_cells([cell], tmp_path)
    assert kept.planned != first.planned, "it must come from the file"
    file.write_text("cut sho")
    (again,) = sail_cells([cell], tmp_path)
    assert again == first


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
def test_a_campaign_that_is_killed_goes_on(tmp_path: Path) -> None:
    """Killed after its first cell; what was done is taken over, and the figures are the same."""
    cells = [Cell(1, "rmmp", fleet, runs=2) for fleet in (2, 3, 4)]
    program = (
        "import sys, time; from pathlib import Path\n"
        "from fiveroute.experiments.stochastic import Cell, sail_cells\n"
        "cells = [Cell(1, 'rmmp', fleet, runs=2) for fleet in (2, 3, 4)]\n"
        "for _ in sail_cells(cells, Path(sys.argv[1])): time.sleep(60)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", program, str(tmp_path)])
    while not list(tmp_path.glob("*.json")):
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    (kept,) = tmp_path.glob("*.json")
    before = kept.stat().st_mtime_ns
    resumed = list(sail_cells(cells, tmp_path))
    assert kept.stat().st_mtime_ns == before
    assert resumed == [sail_cell(cell) for cell in cells]
    assert np.isfinite([outcome.mean for outcome in resumed]).all()
