"""Campaigns: the same numbers on one process, on two, and on a Dask cluster that loses a worker."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fiveroute.formats.run_files import event_lines, write_table
from fiveroute.instance import Fleet, Instance, Node, Point
from fiveroute.limits import Limits, Progress
from fiveroute.routes import Plan
from fiveroute.sea.campaign import Campaign, sail_campaign
from fiveroute.sea.run_result import SimulationResult
from fiveroute.sea.simulation import simulate_fleet
from fiveroute.sea.world import World


def mission() -> Instance:
    """Eight nodes on a ring of 2 km, enough time for most of them."""
    angle = 2.0 * np.pi * np.arange(8) / 8
    nodes = (
        Node(f"n{k}", 1000.0 * float(np.cos(a)), 1000.0 * float(np.sin(a)), 1.0 + k)
        for k, a in enumerate(angle)
    )
    return Instance("ring", tuple(nodes), Point(0.0, 0.0), Point(0.0, 0.0), Fleet(2, 1.0, 5000.0))


def campaign(runs: int = 12, **options: Any) -> Campaign:
    plan = Plan.of([[1, 2, 3, 4], [8, 7, 6]])
    return Campaign(World.of(mission()), plan, runs, {"seed": 3, **options})


def same(one: SimulationResult, other: SimulationResult) -> bool:
    return one.runs == other.runs and one.planner == other.planner


def test_the_numbers_do_not_depend_on_the_workers() -> None:
    whole = simulate_fleet(campaign().world, campaign().plan, runs=12, seed=3)
    assert same(sail_campaign(campaign()), whole)
    assert same(sail_campaign(campaign(), workers=2), whole)


@pytest.mark.filterwarnings(
    "ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"
)
def test_a_cluster_that_loses_a_worker_gives_the_same_numbers() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50
    ) as cluster:
        seen: list[Progress] = []

        def kill_one(progress: Progress) -> None:
            if not seen:
                os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)
            seen.append(progress)

        result = sail_campaign(campaign(16), scheduler=cluster.scheduler_address, progress=kill_one)
    assert same(result, sail_campaign(campaign(16)))
    assert len(seen) > 1


def test_an_expired_clock_leaves_whole_runs() -> None:
    result = sail_campaign(campaign(), limits=Limits(time=0.0))
    assert 1 <= len(result.runs) < 12
    assert same(result, sail_campaign(campaign(len(result.runs))))


def test_events_are_told_line_by_line() -> None:
    result = sail_campaign(campaign(2, log=True))
    events = [json.loads(line) for line in event_lines(mission(), result).splitlines()]
    assert {event["run"] for event in events} == {0, 1}
    assert {event["auv"] for event in events} == {0, 1}
    assert [event["kind"] for event in events].count("depart") == 4
    assert {event["node"] for event in events if event["kind"] == "collect"} <= {
        node.id for node in mission().nodes
    }


def test_messages_are_told_with_those_who_heard_them() -> None:
    result = sail_campaign(campaign(2, log=True, loss=0.5))
    events = [json.loads(line) for line in event_lines(mission(), result).splitlines()]
    sent = [event for event in events if event["kind"] == "send"]
    assert len(sent) == result.messages[0]
    assert sum(len(event["message"]["heard"]) for event in sent) == result.messages[1]
    report = next(event for event in sent if event["message"]["heard"])
    (heard,) = report["message"].pop("heard")
    assert report["message"]["kind"] == "report"
    assert report["message"]["sender"] == report["auv"]
    assert report["message"]["receiver"] is None
    assert report | {"t": heard["t"], "auv": heard["auv"], "kind": "receive"} in events


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_a_row_a_run(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"runs.{suffix}"
    result = sail_campaign(campaign(3))
    write_table(result, path)
    if suffix == "csv":
        lines = path.read_text().splitlines()
        assert lines[0].startswith("planner,run,completion")
        assert len(lines) == 4
    else:
        table = pytest.importorskip("pyarrow.parquet").read_table(path)
        assert table["completion"].to_pylist() == result.completions.tolist()
    assert [file.name for file in tmp_path.iterdir()] == [path.name]
