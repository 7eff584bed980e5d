"""The journal: what was finished is there again, whatever happened in the middle of a line."""

from __future__ import annotations

import math
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fiveroute.errors import InputError
from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.campaign import Campaign, sail_campaign
from fiveroute.sea.journal import Journal
from fiveroute.sea.run_result import RunResult
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World

PROGRAM = """
import sys, time
from pathlib import Path
from fiveroute.sea.campaign import Campaign, sail_campaign
from fiveroute.sea.journal import Journal
from fiveroute.generate import generate
from fiveroute.routes import Plan
from fiveroute.sea.world import World

campaign = Campaign(World.of(generate(nodes=8, seed=1), 2), Plan(((1, 2, 3), (4, 5))), 12, {})
sail_campaign(campaign, journal=Journal(Path(sys.argv[1])), progress=lambda _: time.sleep(0.5))
"""


def campaign(runs: int = 12) -> Campaign:
    world = World.of(generate(nodes=8, seed=1), 2)
    return Campaign(world, Plan(((1, 2, 3), (4, 5))), runs, {})


def some_runs(count: int = 3) -> tuple[RunResult, ...]:
    whole = campaign()
    return simulate_fleet(whole.world, whole.plan, runs=count, failures=0.5, seed=3).runs


def test_runs_come_back_as_they_were(tmp_path: Path) -> None:
    journal, runs = Journal(tmp_path / "runs.jsonl"), some_runs()
    assert journal.runs() == []
    assert any(math.isinf(t) for run in runs for t in run.arrivals)
    journal.add(runs[1:])
    journal.add(runs[:2])
    assert journal.runs() == list(runs)
    journal.remove()
    assert journal.runs() == []


def test_half_a_line_is_no_run(tmp_path: Path) -> None:
    journal, runs = Journal(tmp_path / "runs.jsonl"), some_runs()
    journal.add(runs[:2])
    text = journal.path.read_text()
    for cut in (1, 5, len(text) // 3):
        journal.path.write_text(text[:-cut])
        kept = journal.runs()
        assert kept == list(runs[: len(kept)])
        journal.add(runs[2:])
        assert journal.runs() == [*kept, runs[2]]


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
def test_a_campaign_that_is_killed_loses_no_finished_run(tmp_path: Path) -> None:
    journal = Journal(tmp_path / "runs.jsonl")
    process = subprocess.Popen([sys.executable, "-c", PROGRAM, str(journal.path)])
    while len(journal.runs()) < 3:
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    finished = len(journal.runs())
    assert 3 <= finished < 12
    resumed = sail_campaign(campaign(), journal=journal)
    assert resumed.runs == sail_campaign(campaign()).runs
    lines = [line for line in journal.path.read_text().splitlines() if line]
    assert len(lines) == 12, "no finished run was sailed again"


def test_a_disk_that_takes_nothing_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"full: cannot be written \(No space left"):
        Journal(Path("/dev/full")).add(some_runs()[:1])
    with pytest.raises(InputError, match="cannot be written"):
        Journal(tmp_path).remove()
