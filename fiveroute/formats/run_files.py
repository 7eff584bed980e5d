"""Simulated runs as tables, and logs of what happened in them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fiveroute.formats.tables import write_rows
from fiveroute.instance import Instance
from fiveroute.sea.events import Event, arrivals_of
from fiveroute.sea.run_result import SimulationResult

__all__ = ["event_lines", "write_table"]


def event_lines(instance: Instance, result: SimulationResult) -> str:
    """A JSON document a line for every event: run, t in seconds, auv from 0, kind, node, message.

    A message that is sent tells who heard it, and when.
    """
    lines = []
    for run in result.runs:
        arrivals = arrivals_of(run.events)
        for event in run.events:
            line: dict[str, Any] = {
                "run": run.run,
                "t": float(event.t),
                "auv": int(event.auv),
                "kind": event.kind,
            }
            if event.node is not None:
                line["node"] = instance.nodes[event.node - 1].id
            if event.frame is not None:
                line["message"] = _message(event, arrivals.get(event.frame.number, {}))
            lines.append(json.dumps(line, allow_nan=False) + "\n")
    return "".join(lines)


def _message(event: Event, arrivals: Mapping[int, float]) -> dict[str, Any]:
    assert event.frame is not None
    number, sender, receiver, says, bits = event.frame
    told = {"number": number, "kind": says, "sender": sender, "receiver": receiver, "bits": bits}
    if event.kind != "send":
        return told
    return told | {"heard": [{"auv": auv, "t": float(t)} for auv, t in arrivals.items()]}


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
