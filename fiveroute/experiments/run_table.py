"""Simulated runs as tables, and logs of what happened in them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from fiveroute.formats.tables import write_rows
from fiveroute.instance import Instance
from fiveroute.sea.simulation import SimulationResult

__all__ = ["event_lines", "write_table"]


def event_lines(instance: Instance, result: SimulationResult) -> str:
    """A JSON document a line for every event: run, t in seconds, auv from 0, kind, node."""
    lines = []
    for run in result.runs:
        for event in run.events:
            line: dict[str, Any] = {
                "run": run.run,
                "t": float(event.t),
                "auv": int(event.auv),
                "kind": event.kind,
            }
            if event.node is not None:
                line["node"] = instance.nodes[event.node - 1].id
            lines.append(json.dumps(line, allow_nan=False) + "\n")
    return "".join(lines)


def write_table(result: SimulationResult, path: Path, force: bool = False) -> None:
    """Write a row a run, whole or not at all: planner, run, completion, what became of the AUVs."""
    rows = [
        {
            "planner": result.planner,
            "run": run.run,
            "completion": run.completion,
            "clairvoyant": run.clairvoyant,
            "late_returns": run.late_returns,
            "double_visits": run.double_visits,
            "false_takeovers": run.false_takeovers,
            "sent": run.sent,
            "delivered": run.delivered,
        }
        for run in result.runs
    ]
    write_rows(rows, path, force)
